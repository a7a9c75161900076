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
  Exact,   ///< the optimum, where there are at most `kMostExact` patches; O(patches³)
};
inline constexpr std::size_t kMostExact = 2000;

/// How often each of `examples` patches serves, so that all serve equally and `wanted` times
/// together: wanted / examples times each, and some, drawn at random, once more (section 3.2).
std::vector<std::uint32_t> fairUses(std::size_t wanted, std::size_t examples, const Random& random);

/// Gives every patch of `set` one of `examples`, each of which serves exactly `uses` times: the
/// transportation problem that stands behind equation 3 (section 3.2, boundary patch matching).
/// The sum of `uses` is the size of `set`. The same at any number of threads. Throws `Cancelled`.
std::vector<BoundaryMatch> assignPatches(const BoundaryPatches& set,
                                         const BoundaryPatches& examples,
                                         std::vector<std::uint32_t> uses, AssignmentKind kind,
                                         const Random& random, const Progress& progress = {});

}  // namespace exemplar
