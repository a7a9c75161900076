// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/adjacency.h"

#include <algorithm>
#include <set>
#include <string>

#include "core/error.h"

namespace exemplar {
namespace {

std::string words(const CellOffset& o) {
  std::string text =
      "(" + std::to_string(o.x) + ", " + std::to_string(o.y) + ", " + std::to_string(o.z);
  if (o.t != 0) text += ", " + std::to_string(o.t);
  return text + ")";
}

CellOffset opposite(const CellOffset& o) { return {-o.x, -o.y, -o.z, -o.t}; }

std::vector<CellOffset> offsetsToCount(const AdjacencyOptions& options) {
  std::vector<CellOffset> offsets{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  if (options.frames) offsets.push_back({0, 0, 0, 1});
  std::set<CellOffset> known(offsets.begin(), offsets.end());
  for (const CellOffset& o : options.offsets) {
    if (o == CellOffset{}) throw InputError("the offset (0, 0, 0) is no neighbor; leave it out");
    if (known.contains(o) || known.contains(opposite(o))) {
      throw InputError("the offset " + words(o) + " is there already (or its opposite is)");
    }
    if (o.t != 0 && !options.frames) {
      throw InputError("the offset " + words(o) + " steps through time, and there are no frames");
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

/// Appends each pair (as first << 16 | second) at `offset` from cells of `a` to cells of `b`.
void collect(const LabelGrid& a, const LabelGrid& b, const CellOffset& offset,
             const AdjacencyOptions& options, std::vector<std::uint32_t>& pairs) {
  const Vec3i n = a.size();
  for (int k = 0; k < n.z; ++k) {
    const int k2 = wrapped(k + offset.z, n.z, options.periodic[2]);
    if (k2 < 0) continue;
    for (int j = 0; j < n.y; ++j) {
      const int j2 = wrapped(j + offset.y, n.y, options.periodic[1]);
      if (j2 < 0) continue;
      for (int i = 0; i < n.x; ++i) {
        const int i2 = wrapped(i + offset.x, n.x, options.periodic[0]);
        if (i2 < 0) continue;
        pairs.push_back(std::uint32_t{a.cells(i, j, k)} << 16 | b.cells(i2, j2, k2));
      }
    }
  }
}

PairRule countPairs(std::span<const LabelGrid> examples, const CellOffset& offset,
                    const AdjacencyOptions& options) {
  std::vector<std::uint32_t> found;
  const int count = static_cast<int>(examples.size());
  for (int f = 0; f < count; ++f) {
    const int other = options.frames ? f + offset.t : f;
    if (other >= 0 && other < count) collect(examples[f], examples[other], offset, options, found);
  }
  std::sort(found.begin(), found.end());
  PairRule rule{offset, {}};
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
  if (examples.empty()) throw InputError("model synthesis needs an example; there is none");
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

Adjacency findAdjacency(std::span<const LabelGrid> examples, const AdjacencyOptions& options) {
  checkExamples(examples, options);
  Adjacency found;
  found.labelCount = examples[0].labelCount();
  for (const CellOffset& offset : offsetsToCount(options)) {
    found.rules.push_back(countPairs(examples, offset, options));
  }

  found.frequency.assign(found.labelCount, 0);
  std::array<std::set<Label>, 6> sides;
  for (const LabelGrid& e : examples) {
    for (std::size_t i = 0; i < e.cells.count(); ++i) {
      const Label label = e.cells.data()[i];
      ++found.frequency[label];
      const Vec3i p = e.cells.ijk(i);
      for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] == 0) sides[2 * axis].insert(label);
        if (p[axis] == e.size()[axis] - 1) sides[2 * axis + 1].insert(label);
      }
    }
  }
  for (int s = 0; s < 6; ++s) found.sides[s].assign(sides[s].begin(), sides[s].end());
  return found;
}

Adjacency findAdjacency(const LabelGrid& example, const AdjacencyOptions& options) {
  return findAdjacency(std::span(&example, 1), options);
}

}  // namespace exemplar
