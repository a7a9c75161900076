// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/kept_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cells.h"

namespace exemplar {
namespace {

/// Ranges that are nearer than this, of the axis, are one.
constexpr double kGap = 1.0 / 8;

/// How what is kept moves along one axis: what lies before `split` by one offset, the rest by
/// another.
struct Move {
  int split = 0;
  std::array<int, 2> offset{};

  int side(int slice) const { return slice >= split; }
};

Move moveAlong(const std::vector<SliceRange>& kept, const SliceRange& solid, int example,
               int size) {
  Move move;
  if (kept.empty() || size == example) return move;
  const int before = std::max(0, kept.front().begin - solid.begin);
  const int after = std::max(0, solid.end - kept.back().end);
  if (before == 0 && after == 0) {
    if (kept.size() == 1) return move;
    // The widest gap parts the ends.
    std::size_t widest = 1;
    for (std::size_t r = 2; r < kept.size(); ++r) {
      if (kept[r].begin - kept[r - 1].end > kept[widest].begin - kept[widest - 1].end) widest = r;
    }
    move.split = kept[widest].begin;
    move.offset = {0, size - example};
    return move;
  }
  const int offset = static_cast<int>(
      std::lround(static_cast<double>(size - example) * before / (before + after)));
  move.offset = {offset, offset};
  return move;
}

}  // namespace

std::vector<SliceRange> keptRanges(const Array3D<std::uint8_t>& kept, int axis) {
  const int n = kept.size()[axis];
  std::vector<std::uint8_t> any(static_cast<std::size_t>(n));
  forEachCell(kept.size(), [&](const Vec3i& p) {
    if (kept[p]) any[static_cast<std::size_t>(p[axis])] = 1;
  });
  std::vector<SliceRange> ranges;
  for (int s = 0; s < n; ++s) {
    if (!any[static_cast<std::size_t>(s)]) continue;
    if (!ranges.empty() && s - ranges.back().end < n * kGap) {
      ranges.back().end = s + 1;
    } else {
      ranges.push_back({s, s + 1});
    }
  }
  return ranges;
}

KeptPlaces placeKept(const DistanceField& example, const Array3D<std::uint8_t>& kept,
                     const Vec3i& size, const Axes& periodic) {
  const Vec3i n = example.size();
  CellBox solid{n, {0, 0, 0}};
  forEachCell(n, [&](const Vec3i& p) {
    if (!(example.values[p] < 0)) return;
    solid.begin = min(solid.begin, p);
    solid.end = max(solid.end, p + Vec3i{1, 1, 1});
  });
  std::array<Move, 3> moves;
  bool moved = false;
  KeptPlaces places;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (periodic[axis]) continue;
    moves[a] = moveAlong(keptRanges(kept, axis), {solid.begin[axis], solid.end[axis]}, n[axis],
                         size[axis]);
    places.offset[axis] = moves[a].offset[0];
    moved = moved || moves[a].offset != std::array{0, 0};
  }
  for (int side = 0; moved && side < 8; ++side) {
    places.offsets.push_back({moves[0].offset[side & 1U], moves[1].offset[side >> 1 & 1U],
                              moves[2].offset[side >> 2 & 1U]});
  }
  places.kept = Array3D<std::uint8_t>(size);
  forEachCell(n, [&](const Vec3i& p) {
    if (!kept[p]) return;
    const int side = moves[0].side(p.x) + 2 * moves[1].side(p.y) + 4 * moves[2].side(p.z);
    const Vec3i to = moved ? p + places.offsets[static_cast<std::size_t>(side)] : p;
    if (places.kept.contains(to)) places.kept[to] = static_cast<std::uint8_t>(moved ? side + 1 : 1);
  });
  return places;
}

}  // namespace exemplar
