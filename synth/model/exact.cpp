// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/exact.h"

#include <algorithm>
#include <bit>
#include <cadical.hpp>
#include <unordered_map>

namespace exemplar {
namespace {

/// Asked by the solver once in several rounds of deciding and propagating, whatever the machine: it
/// counts them, so that an end after so many is the same everywhere.
class Limit : public CaDiCaL::Terminator {
 public:
  Limit(const Progress& progress, std::int64_t steps) : progress_(&progress), left_(steps) {}
  bool terminate() override {
    ++steps_;
    return --left_ < 0 || progress_->cancelled();
  }
  std::int64_t steps() const { return steps_; }

 private:
  const Progress* progress_;
  std::int64_t left_, steps_ = 0;
};

/// Labels of one cell, by rank in its domain, that allow the same at a neighbor.
struct Group {
  std::vector<int> near;  ///< these labels
  std::vector<int> far;   ///< the neighbor's labels that they allow; or that they exclude
  bool excludes = false;
  bool together = false;  ///< whether one more variable stands for them
};

/// Domains by number: in a region many cells have the same one.
struct LinkKey {
  int relation, here, there;
  bool operator==(const LinkKey&) const = default;
};
struct LinkKeyHash {
  std::size_t operator()(const LinkKey& k) const {
    std::uint64_t h = static_cast<std::uint64_t>(k.relation);
    h = (h ^ static_cast<std::uint64_t>(k.here)) * 0x9E3779B97F4A7C15u;
    h = ((h ^ h >> 32) ^ static_cast<std::uint64_t>(k.there)) * 0x9E3779B97F4A7C15u;
    return h ^ h >> 29;
  }
};

std::size_t hashOf(std::span<const LabelWord> set) {
  LabelWord hash = 0;
  for (const LabelWord w : set) {
    hash = (hash ^ w) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

struct ExactSolver::Parts {
  const LabelNetwork& network;
  LabelSets domains;
  CaDiCaL::Solver solver;
  std::vector<int> firstVariable;  // of a cell; 0 where it has one label only
  std::vector<int> demands;        // variables
  std::vector<int> labels;         // of the last solution
  int variables = 0;
  std::int64_t literals = 0, steps = 0;

  std::vector<int> domainOf;  // of a cell: the number of its domain
  std::unordered_map<LinkKey, std::vector<Group>, LinkKeyHash> groups;

  Parts(const LabelNetwork& n, const LabelSets& d) : network(n), domains(d) {}

  /// The variable of a label that is in the cell's domain; 0 where the cell is decided.
  int variable(int cell, int label) const {
    if (firstVariable[cell] == 0) return 0;
    int rank = 0;
    const auto set = domains[cell];
    for (int w = 0; w < label / 64; ++w) rank += std::popcount(set[w]);
    rank += std::popcount(set[label / 64] & ((LabelWord{1} << (label % 64)) - 1));
    return firstVariable[cell] + rank;
  }
  void clause(std::initializer_list<int> list) {
    for (const int l : list) add(l);
    add(0);
  }
  void add(int literal) {
    solver.add(literal);
    ++literals;
  }
  void exactlyOne(int first, int count);
  void nameDomains();
  const std::vector<Group>& groupsOf(int cell, int neighbor, int relation);
  void link(int cell, int neighbor, int relation);
};

void ExactSolver::Parts::exactlyOne(int first, int count) {
  for (int i = 0; i < count; ++i) add(first + i);
  add(0);
  if (count <= 5) {
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < i; ++j) clause({-(first + i), -(first + j)});
    }
    return;
  }
  // Sinz, "Towards an optimal CNF encoding of Boolean cardinality constraints", CP 2005: s_i says
  // that one of the first i + 1 is true.
  const int s = variables + 1;
  variables += count - 1;
  for (int i = 0; i < count; ++i) {
    if (i < count - 1) clause({-(first + i), s + i});
    if (i > 0) {
      clause({-(first + i), -(s + i - 1)});
      if (i < count - 1) clause({-(s + i - 1), s + i});
    }
  }
}

void ExactSolver::Parts::nameDomains() {
  std::unordered_multimap<std::size_t, int> known;  // by hash: a cell that has the domain
  domainOf.resize(static_cast<std::size_t>(network.cells));
  for (int c = 0; c < network.cells; ++c) {
    const auto set = domains[c];
    const std::size_t hash = hashOf(set);
    domainOf[c] = c;
    const auto [first, last] = known.equal_range(hash);
    for (auto it = first; it != last; ++it) {
      if (std::equal(set.begin(), set.end(), domains[it->second].begin())) domainOf[c] = it->second;
    }
    if (domainOf[c] == c) known.emplace(hash, c);
  }
}

/// The labels of a cell, those together that allow the same at the neighbor; without those that
/// allow all that the neighbor has.
const std::vector<Group>& ExactSolver::Parts::groupsOf(int cell, int neighbor, int relation) {
  const auto [entry, fresh] =
      groups.try_emplace({relation, domainOf[cell], domainOf[neighbor]}, std::vector<Group>{});
  std::vector<Group>& list = entry->second;
  if (!fresh) return list;
  const LabelSets& table = network.support[relation];
  const auto here = domains[cell];
  const auto there = domains[neighbor];
  const std::size_t words = here.size();
  LabelSets allowed(network.labels, 1);  // scratch
  LabelSets sets(network.labels, static_cast<std::size_t>(labelsIn(here)));
  std::unordered_multimap<std::size_t, int> known;
  int rank = 0;
  forEachLabel(here, [&](int b) {
    const int mine = rank++;
    bool all = true;
    for (std::size_t w = 0; w < words; ++w) {
      allowed[0][w] = table[b][w] & there[w];
      all = all && allowed[0][w] == there[w];
    }
    if (all) return;
    const std::size_t hash = hashOf(allowed[0]);
    const auto [first, last] = known.equal_range(hash);
    for (auto it = first; it != last; ++it) {
      if (!std::equal(allowed[0].begin(), allowed[0].end(), sets[it->second].begin())) continue;
      list[it->second].near.push_back(mine);
      return;
    }
    known.emplace(hash, static_cast<int>(list.size()));
    std::copy(allowed[0].begin(), allowed[0].end(), sets[list.size()].begin());
    list.emplace_back().near.push_back(mine);
  });
  const int all = labelsIn(there);
  for (std::size_t g = 0; g < list.size(); ++g) {
    const int size = labelsIn(sets[g]), lost = all - size;
    list[g].excludes = lost <= 2;
    list[g].together = list[g].near.size() > 1 && all > 2;
    int at = 0;
    forEachLabel(there, [&](int a) {
      if (containsLabel(sets[g], a) != list[g].excludes) list[g].far.push_back(at);
      ++at;
    });
  }
  return list;
}

void ExactSolver::Parts::link(int cell, int neighbor, int relation) {
  const int here = firstVariable[cell], there = firstVariable[neighbor];
  for (const Group& group : groupsOf(cell, neighbor, relation)) {
    const auto state = [&](int v) {
      if (group.excludes) {
        for (const int a : group.far) clause({-v, -(there + a)});
        return;
      }
      add(-v);
      for (const int a : group.far) add(there + a);
      add(0);
    };
    if (!group.together) {
      for (const int b : group.near) state(here + b);
      continue;
    }
    const int any = ++variables;
    for (const int b : group.near) clause({-(here + b), any});
    state(any);
  }
}

ExactSolver::ExactSolver(const LabelNetwork& network, const LabelSets& domains,
                         const Progress& progress)
    : parts_(std::make_unique<Parts>(network, domains)) {
  Parts& p = *parts_;
  p.solver.set("quiet", 1);
  p.solver.set("phase", 0);
  p.firstVariable.assign(network.cells, 0);
  for (int c = 0; c < network.cells; ++c) {
    const int count = labelsIn(p.domains[c]);
    if (count < 2) continue;
    p.firstVariable[c] = p.variables + 1;
    p.variables += count;
  }
  for (int c = 0; c < network.cells; ++c) {
    if (p.firstVariable[c] == 0) continue;
    p.exactlyOne(p.firstVariable[c], labelsIn(p.domains[c]));
  }
  p.nameDomains();
  for (int c = 0; c < network.cells; ++c) {
    if (c % 64 == 0) progress.check();
    network.forEachNeighbor(c, [&](int n, int relation) {
      const LabelSets& table = network.support[relation];
      if (p.firstVariable[c] == 0) {
        // The neighbor keeps what the one label here supports.
        int only = 0;
        forEachLabel(p.domains[c], [&](int b) { only = b; });
        forEachLabel(p.domains[n], [&](int a) {
          if (containsLabel(table[only], a)) return;
          const int v = p.variable(n, a);
          if (v != 0) p.solver.add(-v);
          p.solver.add(0);
        });
        return;
      }
      if (n == c) {
        forEachLabel(p.domains[c], [&](int b) {
          if (!containsLabel(table[b], b)) p.clause({-p.variable(c, b)});
        });
        return;
      }
      if (p.firstVariable[n] != 0) p.link(c, n, relation);
    });
  }
}

ExactSolver::~ExactSolver() = default;

void ExactSolver::prefer(int cell, int label) {
  if (!containsLabel(parts_->domains[cell], label)) return;
  const int v = parts_->variable(cell, label);
  if (v != 0) parts_->solver.phase(v);
}

int ExactSolver::newDemand() {
  parts_->demands.push_back(++parts_->variables);
  return static_cast<int>(parts_->demands.size()) - 1;
}

void ExactSolver::addToDemand(int demand, int cell, std::span<const LabelWord> labels) {
  const int on = parts_->demands[demand];
  forEachLabel(parts_->domains[cell], [&](int b) {
    if (containsLabel(labels, b)) return;
    const int v = parts_->variable(cell, b);
    parts_->solver.add(-on);
    if (v != 0) parts_->solver.add(-v);
    parts_->solver.add(0);
  });
}

void ExactSolver::demandOne(std::span<const std::pair<int, int>> some,
                            std::span<const std::pair<int, int>> orNot) {
  // A decided cell's label is true, any other label false.
  std::vector<int> literals;
  for (const auto& [cell, label] : some) {
    if (!containsLabel(parts_->domains[cell], label)) continue;
    const int v = parts_->variable(cell, label);
    if (v == 0) return;
    literals.push_back(v);
  }
  for (const auto& [cell, label] : orNot) {
    if (!containsLabel(parts_->domains[cell], label)) return;
    const int v = parts_->variable(cell, label);
    if (v != 0) literals.push_back(-v);
  }
  for (const int l : literals) parts_->solver.add(l);
  parts_->solver.add(0);
}

Outcome ExactSolver::solve(std::span<const int> demands, std::int64_t conflicts,
                           const Progress& progress, std::int64_t steps) {
  Parts& p = *parts_;
  Limit limit(progress, steps);
  p.solver.connect_terminator(&limit);
  for (const int d : demands) p.solver.assume(p.demands[d]);
  p.solver.limit("conflicts", static_cast<int>(std::min<std::int64_t>(conflicts, 1 << 30)));
  const int status = p.solver.solve();
  p.solver.disconnect_terminator();
  p.steps += limit.steps();
  progress.check();
  if (status == 20) return Outcome::Impossible;
  if (status != 10) return Outcome::Unfinished;

  p.labels.assign(p.network.cells, -1);
  for (int c = 0; c < p.network.cells; ++c) {
    int v = p.firstVariable[c];
    forEachLabel(p.domains[c], [&](int b) {
      if (p.firstVariable[c] == 0 || p.solver.val(v) > 0) p.labels[c] = b;
      ++v;
    });
  }
  return Outcome::Complete;
}

std::int64_t ExactSolver::literals() const { return parts_->literals; }

std::int64_t ExactSolver::steps() const { return parts_->steps; }

int ExactSolver::label(int cell) const { return parts_->labels[cell]; }

bool ExactSolver::used(int demand) const { return parts_->solver.failed(parts_->demands[demand]); }

}  // namespace exemplar
