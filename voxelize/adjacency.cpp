// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/adjacency.h"

#include <algorithm>
#include <set>
#include <string>

#include "core/cells.h"
#include "core/error.h"

namespace exemplar {
namespace {

std::string words(const CellOffset& o) {
  std::string text =
      "(" + std::to_string(o.x) + ", " + std::to_string(o.y) + ", " + std::to_string(o.z);
  if (o.t != 0) text += ", " + std::to_string(o.t);
  return text + ")";
}

/// Pairs of no more labels than this are counted in a table, which then takes 8 MB at most.
constexpr std::size_t kLabelsInTable = 1024;

CellOffset opposite(const CellOffset& o) { return {-o.x, -o.y, -o.z, -o.t}; }

std::vector<CellOffset> offsetsToCount(const AdjacencyOptions& options) {
  std::vector<CellOffset> offsets{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  if (options.frames) offsets.push_back({0, 0, 0, 1});
  std::set<CellOffset> known(offsets.begin(), offsets.end());
  for (const CellOffset& o : options.offsets) {
    if (o == CellOffset{})
      throw InputError("`offset` (0, 0, 0): a cell is no neighbor of itself; leave it out");
    if (known.contains(o) || known.contains(opposite(o))) {
      throw InputError("`offset` " + words(o) +
                       ": it, or its opposite, is counted already; leave it out");
    }
    if (o.t != 0 && !options.frames) {
      throw InputError("`offset` " + words(o) +
                       ": it steps through time, and the example has no frames");
    }
    known.insert(o);
    offsets.push_back(o);
  }
  return offsets;
}

/// `i` brought back into 0..n-1 where that is allowed; -1 where it is outside.
int wrapped(int i, int n, bool periodic) {
  if (i >= 0 && i < n) return i;
  return periodic ? ((i % n) + n) % n : -1;
}

/// Calls `visit(first, second)` for each pair of labels at `offset` from cells of `a` to cells of
/// `b`.
template <class Visit>
void forEachPair(const LabelGrid& a, const LabelGrid& b, const CellOffset& offset,
                 const AdjacencyOptions& options, const Progress& progress, const Visit& visit) {
  const Vec3i n = a.size();
  for (int k = 0; k < n.z; ++k) {
    progress.check();
    const int k2 = wrapped(k + offset.z, n.z, options.periodic[2]);
    if (k2 < 0) continue;
    for (int j = 0; j < n.y; ++j) {
      const int j2 = wrapped(j + offset.y, n.y, options.periodic[1]);
      if (j2 < 0) continue;
      for (int i = 0; i < n.x; ++i) {
        const int i2 = wrapped(i + offset.x, n.x, options.periodic[0]);
        if (i2 < 0) continue;
        visit(a.cells(i, j, k), b.cells(i2, j2, k2));
      }
    }
  }
}

PairRule countPairs(std::span<const LabelGrid> examples, const CellOffset& offset,
                    const AdjacencyOptions& options, const Progress& progress) {
  const int count = static_cast<int>(examples.size());
  const auto visitAll = [&](const auto& visit) {
    for (int f = 0; f < count; ++f) {
      const int other = options.frames ? f + offset.t : f;
      if (other < 0 || other >= count) continue;
      forEachPair(examples[f], examples[other], offset, options, progress, visit);
    }
  };
  PairRule rule{offset, {}};
  const std::size_t labels = examples[0].labels.size();
  if (labels <= kLabelsInTable) {
    std::vector<std::int64_t> table(labels * labels, 0);
    visitAll([&](Label a, Label b) { ++table[a * labels + b]; });
    for (std::size_t pair = 0; pair < table.size(); ++pair) {
      if (table[pair] == 0) continue;
      rule.pairs.push_back(
          {static_cast<Label>(pair / labels), static_cast<Label>(pair % labels), table[pair]});
    }
    return rule;
  }
  std::vector<std::uint32_t> found;
  visitAll([&](Label a, Label b) { found.push_back(std::uint32_t{a} << 16 | b); });
  progress.check();
  std::sort(found.begin(), found.end());
  for (std::size_t i = 0; i < found.size();) {
    std::size_t end = i;
    while (end < found.size() && found[end] == found[i]) ++end;
    rule.pairs.push_back({static_cast<Label>(found[i] >> 16), static_cast<Label>(found[i] & 0xFFFF),
                          static_cast<std::int64_t>(end - i)});
    i = end;
  }
  return rule;
}

void checkExamples(std::span<const LabelGrid> examples, const AdjacencyOptions& options) {
  if (examples.empty()) throw InputError("model synthesis needs an example, and none was given");
  for (const LabelGrid& e : examples) {
    if (e.cells.empty()) throw InputError("an example of labels has no cells");
    if (e.labelCount() != examples[0].labelCount()) {
      throw InputError("the examples have " + std::to_string(examples[0].labelCount()) + " and " +
                       std::to_string(e.labelCount()) + " labels; they must share one numbering");
    }
    if (options.frames && e.size() != examples[0].size()) {
      throw InputError("the frames of an example must have the same size");
    }
    for (const Label b : e.cells.values()) {
      if (b >= e.labelCount()) {
        throw InputError("a cell has label " + std::to_string(b) + " and there are " +
                         std::to_string(e.labelCount()) + " labels");
      }
    }
  }
}

}  // namespace

std::int64_t PairRule::count(Label first, Label second) const {
  const auto at = std::lower_bound(pairs.begin(), pairs.end(), std::pair(first, second),
                                   [](const LabelPair& p, const std::pair<Label, Label>& key) {
                                     return std::pair(p.first, p.second) < key;
                                   });
  return at != pairs.end() && at->first == first && at->second == second ? at->count : 0;
}

Adjacency findAdjacency(std::span<const LabelGrid> examples, const AdjacencyOptions& options,
                        const Progress& progress) {
  checkExamples(examples, options);
  Adjacency found;
  found.labelCount = examples[0].labelCount();
  const std::vector<CellOffset> offsets = offsetsToCount(options);
  const double steps = static_cast<double>(offsets.size()) + 1;
  for (const CellOffset& offset : offsets) {
    progress.report("counting pairs of labels", static_cast<double>(found.rules.size()) / steps);
    found.rules.push_back(countPairs(examples, offset, options, progress));
  }
  progress.report("counting labels", static_cast<double>(offsets.size()) / steps);

  found.frequency.assign(found.labelCount, 0);
  std::array<std::set<Label>, 6> sides;
  for (const LabelGrid& e : examples) {
    for (const Label label : e.cells.values()) ++found.frequency[label];
    for (int s = 0; s < 6; ++s) {
      const int axis = s / 2;
      CellBox layer = CellBox::of(e.size());
      if (s % 2) {
        layer.begin[axis] = layer.end[axis] - 1;
      } else {
        layer.end[axis] = 1;
      }
      forEachCell(layer, [&](const Vec3i& p) { sides[s].insert(e.cells[p]); });
    }
  }
  for (int s = 0; s < 6; ++s) found.sides[s].assign(sides[s].begin(), sides[s].end());
  return found;
}

Adjacency findAdjacency(const LabelGrid& example, const AdjacencyOptions& options,
                        const Progress& progress) {
  return findAdjacency(std::span(&example, 1), options, progress);
}

}  // namespace exemplar
