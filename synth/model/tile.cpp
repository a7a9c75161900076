// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/tile.h"

#include <algorithm>
#include <compare>

namespace exemplar {
namespace {

/// How far apart, along x or y, neighbors mostly are at most.
constexpr int kNear = 3;

AxisClasses classesAlong(int n, int rim, int period, bool periodic) {
  AxisClasses classes;
  if (periodic) rim = 0;
  const bool all = n <= 2 * rim + period;
  classes.count = all ? n : 2 * rim + period;
  std::vector<std::vector<int>> known;
  for (int i = 0; i < n; ++i) {
    const int middle = rim + (i - rim) % period;
    classes.of.push_back(all || i < rim ? i : i >= n - rim ? classes.count - (n - i) : middle);
  }
  for (int i = 0; i < n; ++i) {
    std::vector<int> around;
    for (int d = -kNear; d <= kNear; ++d) {
      const int j = periodic ? ((i + d) % n + n) % n : i + d;
      around.push_back(j < 0 || j >= n ? -1 : classes.of[j]);
    }
    if (std::find(known.begin(), known.end(), around) != known.end()) continue;
    known.push_back(std::move(around));
    classes.some.push_back(i);
  }
  return classes;
}

}  // namespace

Tile::Tile(const ModelProblem& problem, const Pattern& pattern)
    : problem_(problem),
      x_(classesAlong(problem.options().size.x, pattern.rim, pattern.period.x,
                      problem.options().periodic.x)),
      y_(classesAlong(problem.options().size.y, pattern.rim, pattern.period.y,
                      problem.options().periodic.y)) {
  const ModelOptions& o = problem.options();
  number_.assign(static_cast<std::size_t>(x_.count) * y_.count * o.size.z * o.frames, -1);
}

int Tile::keyOf(int cell) const {
  const ModelOptions& o = problem_.options();
  const std::int64_t at = problem_.positionOf(cell);
  const Vec3i p = problem_.cellAt(at);
  return ((x_.of[p.x] * y_.count + y_.of[p.y]) * o.size.z + p.z) * o.frames + problem_.frameAt(at);
}

bool Tile::findCells(const LabelSets& base, std::int64_t mostLabels, const Progress& progress) {
  progress.check();
  const std::size_t words = static_cast<std::size_t>(base.words());
  std::vector<LabelWord> sets(number_.size() * words, ~LabelWord{0});
  forEach([&](int c, int key) {
    if (number_[key] < 0) {
      number_[key] = static_cast<int>(members_.size());
      members_.push_back(c);
    }
    const LabelWord* from = base[c].data();
    LabelWord* to = sets.data() + static_cast<std::size_t>(key) * words;
    for (std::size_t w = 0; w < words; ++w) to[w] &= from[w];
  });
  domains_ = LabelSets(problem_.network().labels, members_.size());
  std::int64_t labels = 0;
  for (std::size_t key = 0; key < number_.size(); ++key) {
    if (number_[key] < 0) continue;
    const auto set = domains_[number_[key]];
    std::copy_n(sets.begin() + static_cast<std::ptrdiff_t>(key * words), words, set.begin());
    const int count = labelsIn(set);
    if (count == 0) return false;
    labels += count;
  }
  return labels <= mostLabels;
}

void Tile::findNeighbors() {
  const ModelOptions& o = problem_.options();
  const LabelNetwork& whole = problem_.network();
  network_.labels = whole.labels;
  network_.slots = whole.slots;
  network_.support = whole.support;
  network_.cells = static_cast<int>(members_.size());
  network_.neighbor.assign(static_cast<std::size_t>(network_.cells) * whole.slots, network_.cells);

  struct Pair {
    std::int32_t relation, near, far;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  const auto look = [&](int c) {
    const int t = cellOf(keyOf(c));
    whole.forEachNeighbor(c, [&](int n, int relation) {
      pairs.push_back({relation, t, cellOf(keyOf(n))});
    });
  };
  if (o.mask.empty() && !o.symmetry.any()) {
    // Cells whose surroundings are of the same classes have the same neighbors.
    for (const int i : x_.some) {
      for (const int j : y_.some) {
        const std::int64_t first = problem_.position({i, j, 0});
        for (int k = 0; k < o.size.z * o.frames; ++k) look(problem_.cell(first + k));
      }
    }
  } else {
    for (int c = 0; c < whole.cells; ++c) look(c);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

  // A slot holds one neighbor, and is seen from there as the slot opposite. Where a class meets
  // several, each is a link; links have relations of their own, the same tables once more.
  std::vector<int> count(static_cast<std::size_t>(network_.cells) * whole.slots, 0);
  const auto slot = [&](int cell, int relation) {
    return static_cast<std::size_t>(cell) * whole.slots + relation;
  };
  for (const Pair& p : pairs) {
    if (p.relation < whole.slots) ++count[slot(p.near, p.relation)];
  }
  const int copies = static_cast<int>(network_.support.size());
  for (int r = 0; r < whole.slots; ++r) network_.support.push_back(whole.support[r]);
  std::vector<std::vector<LabelNetwork::Link>> links(network_.cells);
  for (const Pair& p : pairs) {
    if (p.relation >= whole.slots) {
      links[p.near].push_back({p.far, p.relation});
    } else if (count[slot(p.near, p.relation)] == 1 && count[slot(p.far, p.relation ^ 1)] == 1) {
      network_.neighbor[slot(p.near, p.relation)] = p.far;
    } else {
      links[p.near].push_back({p.far, copies + p.relation});
    }
  }
  network_.linkBegin.push_back(0);
  for (const auto& list : links) {
    network_.links.insert(network_.links.end(), list.begin(), list.end());
    network_.linkBegin.push_back(static_cast<std::int32_t>(network_.links.size()));
  }
}

}  // namespace exemplar
