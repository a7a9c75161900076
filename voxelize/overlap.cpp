// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

// The samples that a block shares with its neighbor on one side, and their mean.
struct Shared {
  std::vector<float> samples;
  double mean = 0;
};

Shared shared(const Array3D<float>& values, const Vec3i& start, const Vec3i& size) {
  Shared result;
  result.samples.reserve(static_cast<std::size_t>(volume(size)));
  double sum = 0;
  forEachCell(size, [&](const Vec3i& p) {
    result.samples.push_back(values[start + p]);
    sum += result.samples.back();
  });
  result.mean = sum / static_cast<double>(result.samples.size());
  return result;
}

bool agree(const Shared& a, const Shared& b, float tolerance) {
  for (std::size_t s = 0; s < a.samples.size(); ++s)
    if (std::abs(a.samples[s] - b.samples[s]) > tolerance) return false;
  return true;
}

// How often labels are a stride apart in the example, by `first` times 65536 plus `second`.
std::vector<std::uint64_t> shownPairs(const FieldBlocks& blocks, int axis) {
  std::vector<std::uint64_t> pairs;
  Vec3i step{};
  step[axis] = blocks.stride[axis] / blocks.step[axis];
  for (std::size_t c = 0; c < blocks.grid.cells.count(); ++c) {
    const Vec3i other = blocks.grid.cells.ijk(c) + step;
    if (!blocks.grid.cells.contains(other)) continue;
    pairs.push_back(std::uint64_t{blocks.grid.cells.data()[c]} * 65536 + blocks.grid.cells[other]);
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace

Adjacency overlapAdjacency(const Array3D<float>& values, const FieldBlocks& blocks,
                           const Progress& progress) {
  // Frequencies, and the labels at the sides, are those of the grid.
  Adjacency adjacency = findAdjacency(blocks.grid);
  const std::size_t labels = blocks.members.size();
  for (int axis = 0; axis < 3; ++axis) {
    progress.report("comparing overlapping blocks", axis / 3.0);
    std::vector<LabelPair>& rule = adjacency.rules[axis].pairs;
    const int overlap = blocks.block[axis] - blocks.stride[axis];
    if (overlap == 0) continue;  // one block, and so no pairs
    Vec3i size = blocks.block;
    size[axis] = overlap;
    Vec3i ahead{};
    ahead[axis] = blocks.stride[axis];
    std::vector<Shared> high(labels), low(labels);
    parallelFor(0, labels, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t l = begin; l < end; ++l) {
        progress.check();
        const Vec3i& cell = blocks.members[l][0];
        Vec3i start;
        for (int a = 0; a < 3; ++a) start[a] = blocks.phase[a] + cell[a] * blocks.step[a];
        high[l] = shared(values, start + ahead, size);
        low[l] = shared(values, start, size);
      }
    });
    // Samples that all differ by at most the tolerance have means that do.
    std::vector<std::size_t> byMean(labels);
    for (std::size_t l = 0; l < labels; ++l) byMean[l] = l;
    std::ranges::sort(byMean, [&](std::size_t a, std::size_t b) {
      return std::pair(low[a].mean, a) < std::pair(low[b].mean, b);
    });
    // Two neighbors of the example each differ from their label's first block by the tolerance. A
    // little more, so that rounding excludes none of them.
    const float tolerance = static_cast<float>(2 * blocks.tolerance) + 1e-5f;
    const std::vector<std::uint64_t> shown = shownPairs(blocks, axis);
    std::vector<std::vector<LabelPair>> found(labels);
    parallelFor(0, labels, 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t l = begin; l < end; ++l) {
        progress.check();
        const auto mean = [&](std::size_t b) { return low[b].mean; };
        const double slack = tolerance + 1e-4;
        const auto from = std::ranges::lower_bound(byMean, high[l].mean - slack, {}, mean);
        const auto to = std::ranges::upper_bound(byMean, high[l].mean + slack, {}, mean);
        for (auto b = from; b < to; ++b) {
          if (!agree(high[l], low[*b], tolerance)) continue;
          const auto [first, last] = std::equal_range(shown.begin(), shown.end(), l * 65536 + *b);
          found[l].push_back({static_cast<Label>(l), static_cast<Label>(*b),
                              std::max<std::int64_t>(1, last - first)});
        }
        std::ranges::sort(found[l], {}, &LabelPair::second);
      }
    });
    rule.clear();
    for (const std::vector<LabelPair>& pairs : found)
      rule.insert(rule.end(), pairs.begin(), pairs.end());
  }
  return adjacency;
}

}  // namespace exemplar
