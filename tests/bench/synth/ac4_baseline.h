// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "voxelize/adjacency.h"

namespace exemplar::bench {

/// The honest baseline of model synthesis: the whole grid in one pass (thesis, Algorithm 3.1), kept
/// arc consistent by AC-4 (Mohr, Henderson: "Arc and path consistency revisited", Artificial
/// Intelligence 28, 1986): a counter of supports for each cell, direction and label, and a list of
/// removals, as the reference implementation of model synthesis does it. The bottom and top layers
/// show what the example's do. Labels are drawn uniformly; a contradiction ends it.
struct Ac4Result {
  bool complete = false;
  std::uint64_t bytes = 0;  ///< of its counters, sets and lists at most
};
Ac4Result synthesizeByAc4(const Adjacency& adjacency, const Vec3i& size, std::uint64_t seed);

}  // namespace exemplar::bench
