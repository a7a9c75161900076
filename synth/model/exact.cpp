// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/exact.h"

#include <algorithm>
#include <cadical.hpp>
#include <map>

namespace exemplar {
namespace {

class Cancel : public CaDiCaL::Terminator {
 public:
  explicit Cancel(const Progress& progress) : progress_(&progress) {}
  bool terminate() override { return progress_->cancelled(); }

 private:
  const Progress* progress_;
};

}  // namespace

struct ExactSolver::Parts {
  const LabelNetwork& network;
  LabelSets domains;
  CaDiCaL::Solver solver;
  std::vector<int> firstVariable;  // of a cell; 0 where it has one label only
  std::vector<int> demands;        // variables
  std::vector<int> labels;         // of the last solution
  int variables = 0;

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
  void clause(std::initializer_list<int> literals) {
    for (const int l : literals) solver.add(l);
    solver.add(0);
  }
  void exactlyOne(int first, int count);
  void link(int cell, int neighbor, const LabelSets& table);
};

void ExactSolver::Parts::exactlyOne(int first, int count) {
  for (int i = 0; i < count; ++i) solver.add(first + i);
  solver.add(0);
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

void ExactSolver::Parts::link(int cell, int neighbor, const LabelSets& table) {
  const auto here = domains[cell];
  const auto there = domains[neighbor];
  std::map<std::vector<LabelWord>, std::vector<int>> groups;  // what labels allow there → variables
  std::vector<LabelWord> allowed(here.size());
  int rank = 0;
  forEachLabel(here, [&](int b) {
    bool all = true;
    for (std::size_t w = 0; w < allowed.size(); ++w) {
      allowed[w] = table[b][w] & there[w];
      all = all && allowed[w] == there[w];
    }
    if (!all) groups[allowed].push_back(firstVariable[cell] + rank);
    ++rank;
  });
  for (const auto& group : groups) {
    const std::vector<LabelWord>& set = group.first;
    const std::vector<int>& near = group.second;
    const int size = labelsIn(set), lost = labelsIn(there) - size;
    int condition = near[0];
    if (near.size() > 1 && size + lost > 2) {
      condition = ++variables;
      for (const int v : near) clause({-v, condition});
    }
    const auto state = [&](int v) {
      if (lost <= 2) {
        std::vector<LabelWord> gone(set.size());
        for (std::size_t w = 0; w < set.size(); ++w) gone[w] = there[w] & ~set[w];
        forEachLabel(gone, [&](int a) { clause({-v, -variable(neighbor, a)}); });
        return;
      }
      solver.add(-v);
      forEachLabel(set, [&](int a) { solver.add(variable(neighbor, a)); });
      solver.add(0);
    };
    if (near.size() > 1 && condition == near[0]) {
      for (const int v : near) state(v);
    } else {
      state(condition);
    }
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
  for (int c = 0; c < network.cells; ++c) {
    if (c % 256 == 0) progress.check();
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
      if (p.firstVariable[n] != 0) p.link(c, n, table);
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
                           const Progress& progress) {
  Parts& p = *parts_;
  Cancel cancel(progress);
  p.solver.connect_terminator(&cancel);
  for (const int d : demands) p.solver.assume(p.demands[d]);
  p.solver.limit("conflicts", static_cast<int>(std::min<std::int64_t>(conflicts, 1 << 30)));
  const int status = p.solver.solve();
  p.solver.disconnect_terminator();
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

int ExactSolver::label(int cell) const { return parts_->labels[cell]; }

bool ExactSolver::used(int demand) const { return parts_->solver.failed(parts_->demands[demand]); }

}  // namespace exemplar
