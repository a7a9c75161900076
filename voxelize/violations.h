// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/axes.h"
#include "core/progress.h"
#include "voxelize/adjacency.h"

namespace exemplar {

/// Two labels in a result that no example shows so.
struct AdjacencyViolation {
  Vec3i cell;  ///< the first of the two
  int frame = 0;
  CellOffset offset;  ///< from it to the second
  Label first = 0, second = 0;
};

struct AdjacencyViolations {
  std::int64_t pairs = 0;                  ///< looked at
  std::int64_t count = 0;                  ///< of these, not in any example
  std::vector<AdjacencyViolation> listed;  ///< the first hundred
};

struct ViolationOptions {
  AdjacencyOptions adjacency;                   ///< how the examples were read
  Axes periodic;                                ///< the result tiles along these
  bool loop = false;                            ///< its last frame is followed by the first
  const Array3D<std::uint8_t>* mask = nullptr;  ///< cells that are 0 count for nothing
};

/// Checks a result (its frames) against its examples, pair by pair: an independent witness that
/// model synthesis kept its promise (thesis, equation 3.1). It goes back to the examples' cells and
/// shares no code with the solver or with `findAdjacency`. O(cells).
AdjacencyViolations findViolations(std::span<const LabelGrid> result,
                                   std::span<const LabelGrid> examples,
                                   const ViolationOptions& options = {},
                                   const Progress& progress = {});
AdjacencyViolations findViolations(const LabelGrid& result, const LabelGrid& example,
                                   const ViolationOptions& options = {},
                                   const Progress& progress = {});

}  // namespace exemplar
