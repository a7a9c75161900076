// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/array3d.h"
#include "core/progress.h"
#include "sdf/distance_field.h"
#include "synth/surface/coordinates.h"
#include "synth/surface/direction_field.h"
#include "synth/surface/sheet.h"

namespace exemplar::surface {

struct UnrollOptions {
  int patches = 40;   ///< at most so many, around random nodes
  int side = 27;      ///< of a patch, samples, odd
  int perSample = 4;  ///< places for each sample, along x and y: where the grid is, is not known
  int layers = 16;    ///< of a patch along z
  double sample = 1;  ///< length of one on the surface
  double zero = 0;    ///< where the surface is along z, samples
  double height = 1;  ///< of the example, of its own
  std::uint64_t seed = 0;
};

struct Unrolled {
  /// Distances, in samples, of flat patches: x along the field's directions, z the height;
  /// perSample x (side - 1) + 1 places along x and y.
  std::vector<Array3D<float>> patches;
  int perSample = 1;
  /// The share of the nodes tried whose patch would have held a singularity, a dislocation or a
  /// border.
  double skipped = 0;
};

/// Pieces of a field around a sheet, laid flat again: to compare them with the example. Uses
/// nothing of how the field was made but the directions.
Unrolled unroll(const Sheet& sheet, const DirectionField& directions,
                const std::vector<std::uint32_t>& dislocations, const DistanceField& field,
                const UnrollOptions& options, const Progress& progress = {});

}  // namespace exemplar::surface
