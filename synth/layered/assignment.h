// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "core/random.h"
#include "maps/boundary_patches.h"

namespace exemplar {

/// How patches of the example are dealt out.
enum class AssignmentKind {
  Greedy,  ///< cheapest pairs first; within a few hundredths of the optimum
  /// The optimum: of up to `kMostByPaths` patches by `assignByPaths`, of more by
  /// `assignByAuction`. Keeps 2 bytes for each pair of a patch and one of the example; greedy where
  /// there are more than `kMostExactPairs` pairs.
  Exact,
};
inline constexpr std::size_t kMostByPaths = 2000, kMostExactPairs = std::size_t{1} << 27;

/// For each row of `costs` the column that serves it, where each column serves `uses` times, at the
/// least sum: shortest augmenting paths with potentials (Jonker, Volgenant 1987), one row after
/// another. The sum of `uses` is the number of rows. O(rows³). Throws `Cancelled`.
std::vector<std::uint32_t> assignByPaths(const Grid<std::uint16_t>& costs,
                                         const std::vector<std::uint32_t>& uses,
                                         const Progress& progress = {});

/// How often each of `examples` patches serves, so that all serve equally and `wanted` times
/// together: wanted / examples times each, and some, drawn at random, once more (section 3.2).
std::vector<std::uint32_t> fairUses(std::size_t wanted, std::size_t examples, const Random& random);

/// What every patch was given, and how: greedily, too, where there were too many pairs for the
/// optimum that was asked.
struct Assignment {
  std::vector<BoundaryMatch> matches;
  AssignmentKind kind = AssignmentKind::Greedy;
};
/// Gives every patch of `set` one of `examples`, each of which serves exactly `uses` times: the
/// transportation problem that stands behind equation 3 (section 3.2, boundary patch matching).
/// The sum of `uses` is the size of `set`. The same at any number of threads. Throws `Cancelled`.
Assignment assignPatches(const BoundaryPatches& set, const BoundaryPatches& examples,
                         std::vector<std::uint32_t> uses, AssignmentKind kind, const Random& random,
                         const Progress& progress = {},
                         std::size_t mostExactPairs = kMostExactPairs);

}  // namespace exemplar
