// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/violations.h"

#include <unordered_set>

#include "core/cells.h"

namespace exemplar {
namespace {

/// Calls `visit(frame, cell, other frame, other cell)` for every pair of cells of a sequence of
/// grids that are `offset` from each other.
template <class Visit>
void forEachPair(std::span<const LabelGrid> grids, const CellOffset& offset, const Axes& periodic,
                 bool sequence, bool loop, const Progress& progress, const Visit& visit) {
  const int count = static_cast<int>(grids.size());
  for (int f = 0; f < count; ++f) {
    int g = sequence ? f + offset.t : f;
    if (loop && g >= count) g -= count;
    if (loop && g < 0) g += count;
    if (g < 0 || g >= count) continue;
    const Vec3i n = grids[f].size();
    forEachCell(n, [&](const Vec3i& p) {
      if (p.x == 0 && p.y == 0) progress.check();
      Vec3i q = p + Vec3i{offset.x, offset.y, offset.z};
      for (int axis = 0; axis < 3; ++axis) {
        while (periodic[axis] && q[axis] < 0) q[axis] += n[axis];
        while (periodic[axis] && q[axis] >= n[axis]) q[axis] -= n[axis];
      }
      if (grids[g].cells.contains(q)) visit(f, p, g, q);
    });
  }
}

}  // namespace

AdjacencyViolations findViolations(std::span<const LabelGrid> result,
                                   std::span<const LabelGrid> examples,
                                   const ViolationOptions& options, const Progress& progress) {
  std::vector<CellOffset> offsets{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  if (options.adjacency.frames) offsets.push_back({0, 0, 0, 1});
  offsets.insert(offsets.end(), options.adjacency.offsets.begin(), options.adjacency.offsets.end());

  AdjacencyViolations found;
  for (std::size_t o = 0; o < offsets.size(); ++o) {
    const CellOffset& offset = offsets[o];
    progress.report("checking pairs of labels",
                    static_cast<double>(o) / static_cast<double>(offsets.size()));
    std::unordered_set<std::uint64_t> shown;
    forEachPair(examples, offset, options.adjacency.periodic, options.adjacency.frames, false,
                progress, [&](int f, const Vec3i& p, int g, const Vec3i& q) {
                  shown.insert(std::uint64_t{examples[f].cells[p]} * 65536 + examples[g].cells[q]);
                });
    forEachPair(result, offset, options.periodic, options.adjacency.frames, options.loop, progress,
                [&](int f, const Vec3i& p, int g, const Vec3i& q) {
                  if (options.mask && ((*options.mask)[p] == 0 || (*options.mask)[q] == 0)) return;
                  ++found.pairs;
                  const Label a = result[f].cells[p], b = result[g].cells[q];
                  if (shown.contains(std::uint64_t{a} * 65536 + b)) return;
                  ++found.count;
                  if (found.listed.size() < 100) found.listed.push_back({p, f, offset, a, b});
                });
  }
  return found;
}

AdjacencyViolations findViolations(const LabelGrid& result, const LabelGrid& example,
                                   const ViolationOptions& options, const Progress& progress) {
  return findViolations(std::span(&result, 1), std::span(&example, 1), options, progress);
}

}  // namespace exemplar
