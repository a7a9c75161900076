// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>

#include "core/vec.h"
#include "search/minimum_cut.h"

namespace exemplar {

/// Steps to the six neighbors of a node or sample, in the order in which the steps of a seam visit
/// them: that of `LatticeCut`'s directions. Sums over neighbors are made in this order, so it is
/// part of the results' bytes.
inline constexpr std::array<Vec3i, 6> kLatticeSteps{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

struct LatticeLinks {
  std::array<std::int32_t, 6> neighbor{-1, -1, -1, -1, -1, -1};
  std::array<std::int64_t, 6> residual{};  ///< towards each neighbor
};

/// A minimum cut of a graph whose nodes lie on a lattice, with six neighbors at most.
class LatticeCut : public MinimumCut<LatticeCut, LatticeLinks, std::int8_t> {
 public:
  /// A neighbor's direction: +x, -x, +y, -y, +z, -z.
  static constexpr int opposite(int direction) { return direction ^ 1; }

  explicit LatticeCut(int nodes) : MinimumCut(nodes) {}

  /// Makes `b` the neighbor of `a` in `direction`: `cost` >= 0 where `a` is on the first side and
  /// `b` on the second, `reverse` >= 0 the other way round. Once a pair.
  void connect(int a, int b, int direction, std::int64_t cost, std::int64_t reverse);

 private:
  friend MinimumCut;
  static constexpr int degree(int) { return 6; }
  int neighbor(int node, int direction) const { return nodes_[node].neighbor[direction]; }
  std::int64_t& residual(int node, int direction) { return nodes_[node].residual[direction]; }
  static constexpr std::int8_t opposite(int, int direction) {
    return static_cast<std::int8_t>(direction ^ 1);
  }
};

extern template class MinimumCut<LatticeCut, LatticeLinks, std::int8_t>;

}  // namespace exemplar
