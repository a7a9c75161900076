// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/example_nature.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace exemplar {
namespace {

/// Layers at a side are as full as the rest where their share is this much of the mean, at least.
constexpr double kAsFull = 0.5;
/// Quarters are alike where their shares are this far apart at most. Of the example kinds of the
/// tests, packings and porous blocks of 64³ have .05 to .3, terrain .2 to .5, objects 1 or more.
constexpr double kAlike = 0.5;

/// The solid cells of each layer along each axis.
std::array<std::vector<std::int64_t>, 3> layersOf(const Occupancy& o) {
  const Vec3i n = o.size();
  std::array<std::vector<std::int64_t>, 3> layers;
  for (int axis = 0; axis < 3; ++axis) layers[axis].resize(static_cast<std::size_t>(n[axis]));
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y)
      for (int x = 0; x < n.x; x += 64) {
        std::uint64_t bits = o.bits(x, y, z);
        layers[1][static_cast<std::size_t>(y)] += std::popcount(bits);
        layers[2][static_cast<std::size_t>(z)] += std::popcount(bits);
        for (; bits != 0; bits &= bits - 1)
          ++layers[0][static_cast<std::size_t>(x + std::countr_zero(bits))];
      }
  return layers;
}

}  // namespace

bool ExampleNature::freeStanding() const {
  for (int side = 0; side < 6; ++side)
    if (side != 4 && sides[static_cast<std::size_t>(side)] != BoxSide::Air) return false;
  return solidShare > 0;
}

ExampleNature natureOf(const Occupancy& example) {
  ExampleNature nature;
  nature.size = example.size();
  nature.solidShare = solidFraction(example);
  const double least = std::min(nature.solidShare, 1 - nature.solidShare);
  const auto layers = layersOf(example);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::int64_t>& along = layers[axis];
    const int n = nature.size[axis];
    const double layer = static_cast<double>(example.cells()) / std::max(1, n);
    const auto occupied = [](std::int64_t cells) { return cells > 0; };
    const auto first = std::ranges::find_if(along, occupied);
    if (first == along.end()) continue;  // no solid at all
    nature.solid.begin[axis] = static_cast<int>(first - along.begin());
    nature.solid.end[axis] = static_cast<int>(
        std::find_if(along.rbegin(), along.rend(), occupied).base() - along.begin());

    bool full = true;
    for (const int end : {0, 1}) {
      const auto side = static_cast<std::size_t>(2 * axis + end);
      const double share = static_cast<double>(end ? along.back() : along.front()) / layer;
      nature.atSides[side] = share;
      nature.sides[side] = share == 0 ? BoxSide::Air : share > 0.98 ? BoxSide::Solid : BoxSide::Cut;
      full = full && std::min(share, 1 - share) >= kAsFull * least &&
             nature.sides[side] == BoxSide::Cut;
    }
    std::array<double, 4> count{};
    for (int l = 0; l < n; ++l) {
      const auto quarter = static_cast<std::size_t>(l * 4 / n);
      nature.quarters[axis][quarter] += static_cast<double>(along[static_cast<std::size_t>(l)]);
      count[quarter] += layer;
    }
    double low = 1, high = 0;
    for (std::size_t q = 0; q < 4; ++q) {
      if (count[q] == 0) continue;
      nature.quarters[axis][q] /= count[q];
      low = std::min(low, nature.quarters[axis][q]);
      high = std::max(high, nature.quarters[axis][q]);
    }
    nature.spread[axis] = least > 0 ? (high - low) / least : 0;
    nature.fillsEvenly[axis] = full && nature.spread[axis] <= kAlike;
  }
  return nature;
}

}  // namespace exemplar
