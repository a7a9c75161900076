// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/axes.h"
#include "core/origin.h"
#include "core/progress.h"
#include "measure/occupancy.h"
#include "measure/offsets.h"
#include "measure/rolled_distance.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// *Div*: the mean over all pairs of results (one a seed, all of the same size) of 1 - IoU of their
/// solid; 0 all the same .. 1 nothing in common. It rises with garbage: read it beside likeness.
/// 0 for fewer than two results. Throws `InputError` where sizes differ.
double diversity(std::span<const Occupancy> results);

struct CopyDistanceOptions {
  /// How far beyond the aligned faces the example may be moved; voxels, 0..64.
  int reach = 8;
  /// The most placements that are tried one by one; where there are more, a lattice of them is,
  /// and then the neighborhoods of the best.
  std::int64_t placements = 100000;
};

/// The least 1 - IoU between the result and the example laid over it anywhere: a copy scores 0
/// wherever it was put, where the aligned distance is fooled by a shift of some voxels. Along each
/// axis the smaller box is moved through the larger one and up to `reach` voxels (at most an eighth
/// of the smaller side) beyond; IoU is over the overlap. 1 where they never have solid in common.
/// Throws `Cancelled`.
double copyDistance(const Occupancy& example, const Occupancy& result,
                    const CopyDistanceOptions& options = {}, const Progress& progress = {});

/// How far the result goes beyond its example.
struct Novelty {
  /// 1 - IoU of the solid, cell by cell; only where both boxes have the same size.
  std::optional<double> distance;
  /// The same at the placement where it is least (`copyDistance`).
  double copyDistance = 0;
  /// The same where it is rolled over all shifts, what leaves its box coming in at the other side.
  RolledDistance rolled;
  /// The same over all quarter turns about z and mirror images, too. Shifts of examples of more
  /// than 64³ cells are found on a coarser grid.
  RolledDistance turned;
  /// Axes along which rolling is fair, for the example fills its box evenly, as a material does: a
  /// rolled example is then another sample of it, but for the plane where the sides meet.
  Axes rollingIsFair;

  // Measured on origins; absent without them.

  /// The volume-weighted mean size of connected regions with one source offset, over the example's
  /// volume: 1 for a copy of the example, and for a tiling with it; (block / size)³ for blocks.
  /// Neighbors (sharing a face) are of one region where their origins differ as they do
  /// themselves, turns taken into account. Empty regions count like solid ones.
  std::optional<double> verbatimRun;
  /// The entropy of how often each surface cell of the example (solid, with an empty cell at one of
  /// its faces) was used as an origin, over the most it could be, the logarithm of the number of
  /// surface cells (or of uses, where those are fewer); 0..1. 0 where none was used, 1 where the
  /// example has one surface cell or none.
  std::optional<double> use;
  /// The same as a share of the surface: the number of cells that, used evenly, would have that
  /// entropy, over the number of surface cells (or of uses); 0..1. Entropy is kind to repetition:
  /// where one of 64 blocks is repeated everywhere, `use` is still about 0.6, this is 1/64.
  std::optional<double> usedShare;
  /// By how many motions the surface was taken from the example.
  std::optional<OffsetUse> offsets;
};

/// How evenly the example's surface was used: `Novelty::use` and `usedShare`. O(cells), quick.
/// Origins are within `example` (`requireOriginsFit`). Throws `Cancelled`.
struct SurfaceUse {
  double use = 0, usedShare = 0;
};
SurfaceUse surfaceUse(const Occupancy& example, const Origins& origins, int exampleIndex = 0,
                      const Progress& progress = {});

/// Novelty from the solid and, where there are any, the origins (same size as the result; `nullptr`
/// if none). Origins in examples other than number `exampleIndex` count for the regions, not for
/// the use. About half a second at 128³, most of it for the rolled distances. Throws `InputError`
/// for voxel sizes or numbers of origins that do not fit, and for origins outside the example, and
/// `Cancelled`.
Novelty measureNovelty(const DistanceField& example, const DistanceField& result,
                       const Origins* origins = nullptr, int exampleIndex = 0,
                       const Progress& progress = {});

/// Throws `InputError` unless there is one origin for each sample of the result and each that is in
/// example number `exampleIndex` is inside `example`.
void requireOriginsFit(const Origins& origins, const DistanceField& example,
                       const DistanceField& result, int exampleIndex);

}  // namespace exemplar
