// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct BrokenPiecesOptions {
  /// Samples of the example that may be copied, where not 0: of its size, or none for all.
  const Array3D<std::uint8_t>* usable = nullptr;
  /// Samples of the result that stay as they are, where not 0: of its size, or none.
  const Array3D<std::uint8_t>* fixed = nullptr;
  /// The result's distances, of its size, where they are no longer what origins copy; or none.
  const Array3D<float>* values = nullptr;
};

/// Clears away what has broken off: pieces of solid (samples below 0 that share faces) inside the
/// box with fewer than half the samples of the example's smallest whole piece; where the example
/// has no whole piece, of its largest. Then fills bubbles, pieces of air, by the same rule.
///
/// Bodies that rest on each other (balls in a heap) are one piece. Where whole pieces are less than
/// a quarter of the example's solid, and more than that of what lies half a voxel below its
/// surface, the latter are the measure; and given `values`, what is a broken piece half a voxel
/// below the surface goes too, with the skin around it.
///
/// Each sample that changes takes the offset (example 0, no turns) of a neighbor that shows air
/// there (solid in a bubble), the nearest to its surroundings in value; only where none does, an
/// origin just at the other side of the example's surface.
///
/// Returns how many samples changed. O(samples). The same bytes at any number of threads. Throws
/// `Cancelled`, with origins still sound.
std::int64_t dropBrokenPieces(const DistanceField& example, Origins& origins,
                              const BrokenPiecesOptions& options = {},
                              const Progress& progress = {});

}  // namespace exemplar
