// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"

namespace exemplar {

/// Steps to the six neighbors of a node or sample, in the order in which the steps of a seam visit
/// them: that of `LatticeCut`'s directions. Sums over neighbors are made in this order, so it is
/// part of the results' bytes.
inline constexpr std::array<Vec3i, 6> kLatticeSteps{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

/// A minimum cut of a graph whose nodes lie on a lattice, with six neighbors at most: which side
/// each node is on where the capacities cut are least.
///
/// The maximum flow is found by two search trees that meet (Boykov, Kolmogorov: "An experimental
/// comparison of min-cut/max-flow algorithms for energy minimization in vision", IEEE TPAMI 26(9),
/// 2004, doi:10.1109/TPAMI.2004.60, section 3). Capacities are integers, so the answer is exact and
/// the same everywhere. Nearly linear in practice on the graphs of seams.
class LatticeCut {
 public:
  /// A neighbor's direction: +x, -x, +y, -y, +z, -z.
  static constexpr int opposite(int direction) { return direction ^ 1; }

  explicit LatticeCut(int nodes) : nodes_(nodes) {}

  /// What it costs to have `node` on the second side less what it costs on the first; adds up.
  void addTerminal(int node, std::int64_t secondLessFirst) {
    nodes_[node].terminal += secondLessFirst;
  }
  /// Makes `b` the neighbor of `a` in `direction`: `cost` >= 0 where `a` is on the first side and
  /// `b` on the second, `reverse` >= 0 the other way round. Once a pair.
  void connect(int a, int b, int direction, std::int64_t cost, std::int64_t reverse);

  /// Finds the cut. Once. Throws `Cancelled`.
  void solve(const Progress& progress = {});

  /// After `solve`: whether the node is on the second side. Of several least cuts it is the one
  /// with the fewest nodes there.
  bool onSecondSide(int node) const { return nodes_[node].tree == kSecond; }

 private:
  static constexpr std::uint8_t kFree = 0, kFirst = 1, kSecond = 2;
  static constexpr std::int8_t kNoParent = -1, kTerminal = 6;

  struct Node {
    std::array<std::int32_t, 6> neighbor{-1, -1, -1, -1, -1, -1};
    std::array<std::int64_t, 6> residual{};  ///< towards each neighbor
    std::int64_t terminal = 0;               ///< > 0: from the first terminal, < 0: to the second
    std::int32_t distance = 0, stamp = 0;    ///< to the terminal, when that was known
    std::int8_t parent = kNoParent;          ///< direction, or the terminal
    std::uint8_t tree = kFree;
    bool active = false;
  };

  void activate(int node);
  /// What may still flow from a tree's node `from` in `direction`, in the tree's sense.
  std::int64_t growable(int from, int direction) const;
  void augment(int first, int direction);
  void orphan(int node);
  void adopt(int node);
  /// The number of steps to the terminal, or -1 where the chain of parents is broken.
  int distanceToTerminal(int node);

  std::vector<Node> nodes_;
  std::deque<int> active_, orphans_;
  std::int32_t time_ = 0;
};

}  // namespace exemplar
