// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/offsets.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace exemplar {
namespace {

/// The solid cells of 64 with an empty one at a face, inside the box.
std::uint64_t surfaceBits(const Occupancy& o, int x, int y, int z) {
  const Vec3i n = o.size();
  const std::uint64_t here = o.bits(x, y, z);
  std::uint64_t inside = here;  // with solid at all faces that are in the box
  // What lies beyond the box counts as solid.
  inside &= o.bits(x - 1, y, z) | (x == 0 ? 1 : 0);
  const int last = n.x - 1 - x;
  inside &= o.bits(x + 1, y, z) | (last < 64 ? std::uint64_t{1} << last : 0);
  if (y > 0) inside &= o.bits(x, y - 1, z);
  if (y < n.y - 1) inside &= o.bits(x, y + 1, z);
  if (z > 0) inside &= o.bits(x, y, z - 1);
  if (z < n.z - 1) inside &= o.bits(x, y, z + 1);
  return here & ~inside;
}

using Counts = std::map<OriginMotion, std::int64_t>;

/// The shares of the commonest motions, each with what is near it, until they make `enough` of all.
std::vector<std::int64_t> grouped(const Counts& counts, const std::optional<Vec3i>& around,
                                  std::int64_t enough) {
  std::vector<std::pair<std::int64_t, OriginMotion>> order;
  for (const auto& [motion, count] : counts) order.emplace_back(count, motion);
  std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
  Counts left = counts;
  std::vector<std::int64_t> groups;
  std::int64_t sum = 0;
  for (const auto& [count, motion] : order) {
    if (!left.contains(motion)) continue;
    std::int64_t group = 0;
    OriginMotion near = motion;
    constexpr int kReach = kOffsetReach;
    for (int k = -kReach; k <= kReach; ++k)
      for (int j = -kReach; j <= kReach; ++j)
        for (int i = -kReach; i <= kReach; ++i) {
          near.shift = motion.shift + Vec3i{i, j, k};
          for (int axis = 0; around && axis < 3; ++axis) {
            const int n = (*around)[axis];
            near.shift[axis] = (near.shift[axis] % n + n) % n;
          }
          const auto found = left.find(near);
          if (found == left.end()) continue;
          group += found->second;
          left.erase(found);
        }
    groups.push_back(group);
    sum += group;
    if (sum >= enough) break;
  }
  std::ranges::sort(groups, std::greater());
  return groups;
}

/// Calls `body` for each cell that `offsetUse` counts, in the order of the grid.
template <class Body>
void forEachSurfaceCell(const Occupancy& result, const Body& body) {
  const Vec3i n = result.size();
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; x += 64)
        for (std::uint64_t bits = surfaceBits(result, x, y, z); bits != 0; bits &= bits - 1)
          body(Vec3i{x + std::countr_zero(bits), y, z});
}

}  // namespace

OffsetUse offsetUse(const Occupancy& result, const Origins& origins, const Vec3i& exampleSize,
                    const Progress& progress) {
  const int layers = result.size().z;
  int layer = -1;
  Counts counts, rolled;
  std::int64_t surface = 0;
  OriginMotion last;
  std::int64_t run = 0;
  const auto flush = [&] {
    if (run == 0) return;
    counts[last] += run;
    OriginMotion around = last;
    for (int axis = 0; axis < 3; ++axis) {
      const int size = exampleSize[axis];
      around.shift[axis] = (around.shift[axis] % size + size) % size;
    }
    rolled[around] += run;
    run = 0;
  };
  forEachSurfaceCell(result, [&](const Vec3i& cell) {
    if (cell.z != layer) {
      layer = cell.z;
      progress.report("counting offsets", static_cast<double>(layer) / layers);
    }
    const OriginMotion motion = motionAt(origins, cell);
    if (run > 0 && !(motion == last)) flush();
    last = motion;
    ++run;
    ++surface;
  });
  flush();
  OffsetUse use;
  if (surface == 0) return use;
  const auto all = static_cast<double>(surface);
  const auto enough = (surface * 95 + 99) / 100;
  const std::vector<std::int64_t> groups = grouped(counts, std::nullopt, enough);
  use.top = static_cast<double>(groups.front()) / all;
  std::int64_t sum = 0;
  for (const std::int64_t group : groups) {
    ++use.offsets95;
    if ((sum += group) >= enough) break;
  }
  use.topRolled = static_cast<double>(grouped(rolled, exampleSize, enough).front()) / all;
  return use;
}

std::vector<double> surfaceShares(const Occupancy& result, const Origins& origins,
                                  std::size_t examples) {
  std::vector<double> shares(examples);
  double all = 0;
  forEachSurfaceCell(result, [&](const Vec3i& cell) {
    shares[origins[cell].example] += 1;
    all += 1;
  });
  for (double& share : shares) share /= std::max(1.0, all);
  return shares;
}

}  // namespace exemplar
