// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "measure/occupancy.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// A connected component of solid cells: cells that share a face are connected.
struct Component {
  std::int64_t cells = 0;
  bool touchesFace = false;  ///< of the box: what lies beyond may belong to it

  bool operator==(const Component&) const = default;
};

/// The components of a volume in the order of their first cells. O(cells). Throws
/// `Cancelled`.
std::vector<Component> connectedComponents(const Occupancy& occupancy,
                                           const Progress& progress = {});

/// What the solid of an example falls into, and what that of a result does. A *piece* is a
/// component that touches no face of the box, and is therefore whole.
struct Pieces {
  /// How far below the surface the solid begins, in voxels: 0, or 1/2 (`comparePieces`).
  double depth = 0;
  std::int64_t example = 0, result = 0;  ///< how many pieces there are
  /// Pieces for each million cells of the box. Large pieces are whole more rarely in a small box,
  /// so a larger result of the same material has more: compare with what a fresh sample has.
  double examplePerMillion = 0, resultPerMillion = 0;
  /// Cells of the example's smallest piece; of its largest component where it has no whole piece.
  std::int64_t smallest = 0;
  /// The share of the result's solid in pieces of fewer than half of `smallest` cells: what has
  /// broken. 0..1; 0 for an empty result, and where the example is empty.
  double brokenShare = 0;
};

/// Bodies that rest on each other (balls in a heap, rings of a mail) are one component to cells,
/// and nothing could be said about them. So where whole pieces are less than a quarter of the
/// example's solid, and they are more than that of what lies half a voxel below its surface, the
/// latter is what falls into pieces, in the example and in the result: contacts that fine do not
/// join.
///
/// Where the example has no whole piece at all, everything in it is part of something that leaves
/// the box (ground, fibers, a lattice); a piece of the result then counts as broken unless it is at
/// least half as large as the largest of these. O(cells). Throws `Cancelled`.
Pieces comparePieces(const DistanceField& example, const DistanceField& result,
                     const Progress& progress = {});

}  // namespace exemplar
