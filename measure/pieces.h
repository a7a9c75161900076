// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "measure/occupancy.h"

namespace exemplar {

/// A connected component of solid cells: cells that share a face are connected.
struct Component {
  std::int64_t cells = 0;
  bool touchesFace = false;  ///< of the box: what lies beyond may belong to it

  bool operator==(const Component&) const = default;
};

/// The components of a volume in the order of their first cells. O(cells).
std::vector<Component> connectedComponents(const Occupancy& occupancy);

/// What the solid of an example falls into, and what that of a result does. A *piece* is a
/// component that touches no face of the box, and is therefore whole.
struct Pieces {
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

/// Where the example has no whole piece, everything in it is part of something that leaves the box
/// (ground, fibres, a lattice); a piece of the result then counts as broken unless it is at least
/// half as large as the largest of these.
Pieces comparePieces(const Occupancy& example, const Occupancy& result);

}  // namespace exemplar
