// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/exact_search.h"

#include <algorithm>
#include <cadical.hpp>
#include <vector>

namespace exemplar::continuous {
namespace {

class Cancel : public CaDiCaL::Terminator {
 public:
  explicit Cancel(const Progress& progress) : progress_(&progress) {}
  bool terminate() override { return progress_->cancelled(); }

 private:
  const Progress* progress_;
};

constexpr std::uint32_t kOutside = 0xFFFFFFFF;

}  // namespace

struct ExactSearch::Parts {
  const Puzzle& puzzle;
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> place;              // of a vertex in `vertices`
  std::vector<std::vector<std::size_t>> labels;  // of each of them
  std::vector<int> first;                        // its first variable; 0 where it has one label
  std::vector<int> demands;
  std::vector<std::size_t> solution;
  CaDiCaL::Solver solver;
  int variables = 0;
  bool hopeless = false;  // a vertex has no label

  explicit Parts(const Puzzle& p) : puzzle(p) {}

  void clause(std::initializer_list<int> literals) {
    for (const int l : literals) solver.add(l);
    solver.add(0);
  }
  void atMostOne(const std::vector<int>& v) {
    const int count = static_cast<int>(v.size());
    if (count <= 5) {
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j) clause({-v[i], -v[j]});
      return;
    }
    // Sinz, "Towards an optimal CNF encoding of Boolean cardinality constraints", CP 2005.
    const int s = variables + 1;
    variables += count - 1;
    for (int i = 0; i < count; ++i) {
      if (i < count - 1) clause({-v[i], s + i});
      if (i > 0) {
        clause({-v[i], -(s + i - 1)});
        if (i < count - 1) clause({-(s + i - 1), s + i});
      }
    }
  }
  void link(std::uint32_t v, std::uint32_t ray, const EdgeEnd& end);
};

void ExactSearch::Parts::link(std::uint32_t v, std::uint32_t ray, const EdgeEnd& end) {
  const std::uint32_t a = place[v], b = place[end.vertex];
  if (first[a] == 0 && first[b] == 0) return;
  const VertexClass::Along& here = puzzle.classOf(v).rays[ray];
  const VertexClass::Along& there = puzzle.classOf(end.vertex).rays[end.ray];
  std::vector<std::vector<int>> withHere(static_cast<std::size_t>(here.edges)),
      withThere(static_cast<std::size_t>(here.edges));
  for (std::size_t l = 0; l < labels[a].size(); ++l)
    withHere[here.edgeOf[labels[a][l]]].push_back(first[a] + static_cast<int>(l));
  for (std::size_t l = 0; l < labels[b].size(); ++l)
    withThere[there.edgeOf[labels[b][l]]].push_back(first[b] + static_cast<int>(l));
  std::vector<int> edges;
  for (std::size_t e = 0; e < withHere.size(); ++e) {
    if (withHere[e].empty() || withThere[e].empty()) continue;  // arc consistent: both or neither
    const int edge = ++variables;
    edges.push_back(edge);
    if (first[a] != 0) {
      solver.add(-edge);
      for (const int l : withHere[e]) solver.add(l);
      solver.add(0);
      for (const int l : withHere[e]) clause({-l, edge});
    }
    if (first[b] != 0) {
      solver.add(-edge);
      for (const int l : withThere[e]) solver.add(l);
      solver.add(0);
      for (const int l : withThere[e]) clause({-l, edge});
    }
  }
  for (std::size_t e = 0; e < withHere.size(); ++e) {
    if (withThere[e].empty() && first[a] != 0)
      for (const int l : withHere[e]) clause({-l});
    if (withHere[e].empty() && first[b] != 0)
      for (const int l : withThere[e]) clause({-l});
  }
  atMostOne(edges);
}

ExactSearch::ExactSearch(const Puzzle& puzzle, const Domains& domains,
                         std::span<const std::uint32_t> vertices, const Progress& progress)
    : parts_(std::make_unique<Parts>(puzzle)) {
  Parts& p = *parts_;
  p.solver.set("quiet", 1);
  p.solver.set("phase", 0);
  p.vertices.assign(vertices.begin(), vertices.end());
  p.place.assign(puzzle.arrangement.vertices(), kOutside);
  for (std::uint32_t n = 0; n < vertices.size(); ++n) {
    p.place[vertices[n]] = n;
    std::vector<std::size_t>& labels = p.labels.emplace_back();
    forEach(domains[vertices[n]], [&](std::size_t l) { labels.push_back(l); });
    p.hopeless = p.hopeless || labels.empty();
    p.first.push_back(labels.size() > 1 ? p.variables + 1 : 0);
    if (labels.size() < 2) continue;
    p.variables += static_cast<int>(labels.size());
    for (std::size_t l = 0; l < labels.size(); ++l)
      p.solver.add(p.first.back() + static_cast<int>(l));
    p.solver.add(0);
  }
  if (p.hopeless) return;
  for (const std::uint32_t v : vertices) {
    if (p.place[v] % 256 == 0) progress.check();
    const std::span<const EdgeEnd> ends = puzzle.arrangement.ends(v);
    for (std::uint32_t r = 0; r < ends.size(); ++r) {
      const std::uint32_t w = ends[r].vertex;
      if (w == EdgeEnd::kNone || w < v || p.place[w] == kOutside) continue;
      p.link(v, r, ends[r]);
    }
  }
}

ExactSearch::~ExactSearch() = default;

void ExactSearch::prefer(std::uint32_t vertex, std::size_t label) {
  const std::uint32_t n = parts_->place[vertex];
  const auto found = std::ranges::find(parts_->labels[n], label);
  if (parts_->first[n] == 0 || found == parts_->labels[n].end()) return;
  parts_->solver.phase(parts_->first[n] + static_cast<int>(found - parts_->labels[n].begin()));
}

int ExactSearch::newDemand() {
  parts_->demands.push_back(++parts_->variables);
  return static_cast<int>(parts_->demands.size()) - 1;
}

void ExactSearch::addToDemand(int demand, std::uint32_t vertex, std::span<const Word> labels) {
  const std::uint32_t n = parts_->place[vertex];
  for (std::size_t l = 0; l < parts_->labels[n].size(); ++l) {
    if (contains(labels, parts_->labels[n][l])) continue;
    parts_->solver.add(-parts_->demands[demand]);
    if (parts_->first[n] != 0) parts_->solver.add(-(parts_->first[n] + static_cast<int>(l)));
    parts_->solver.add(0);
  }
}

Outcome ExactSearch::solve(std::span<const int> demands, std::int64_t conflicts,
                           const Progress& progress) {
  Parts& p = *parts_;
  if (p.hopeless) return Outcome::Impossible;
  Cancel cancel(progress);
  p.solver.connect_terminator(&cancel);
  for (const int d : demands) p.solver.assume(p.demands[d]);
  p.solver.limit("conflicts", static_cast<int>(std::min<std::int64_t>(conflicts, 1 << 30)));
  const int status = p.solver.solve();
  p.solver.disconnect_terminator();
  progress.check();
  if (status == 20) return Outcome::Impossible;
  if (status != 10) return Outcome::Unfinished;
  p.solution.assign(p.vertices.size(), 0);
  for (std::size_t n = 0; n < p.vertices.size(); ++n) {
    for (std::size_t l = 0; l < p.labels[n].size(); ++l) {
      if (p.first[n] == 0 || p.solver.val(p.first[n] + static_cast<int>(l)) > 0)
        p.solution[n] = p.labels[n][l];
    }
  }
  return Outcome::Complete;
}

void ExactSearch::take(Domains& domains) const {
  for (std::size_t n = 0; n < parts_->vertices.size(); ++n) {
    const std::span<Word> domain = domains[parts_->vertices[n]];
    std::ranges::fill(domain, 0);
    insert(domain, parts_->solution[n]);
  }
}

bool ExactSearch::used(int demand) const {
  return parts_->hopeless || parts_->solver.failed(parts_->demands[demand]);
}

}  // namespace exemplar::continuous
