// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "core/cells.h"
#include "core/progress.h"

namespace exemplar {

/// Several quantities sampled on the same grid (a distance and its gradient, say): arrays of one
/// size. Differences are summed over channels, so scale each by the weight that it should have (by
/// its square root).
using Channels = std::vector<Array3D<float>>;

/// For each patch of a target its nearest patch of a source.
struct NearestNeighborField {
  Vec3i stride{1, 1, 1};    ///< target patch (i, j, k) starts at target sample stride * (i, j, k)
  Array3D<Vec3i> position;  ///< first sample of the nearest patch in the source
  /// Mean over samples (sum over channels) of the squared differences: equation 1. Without
  /// `sourceWeight`.
  Array3D<float> distance;
};

enum class NeighborMethod {
  Exact,       ///< every target patch gets a nearest source patch; ties by lowest source index
  PatchMatch,  ///< Barnes et al. 2009: coherence and random search; nearly as near, much faster on
               ///< large inputs
};

struct NearestNeighborFieldOptions {
  Vec3i patch{7, 7, 7};   ///< samples; >= 1 each, at most the source's and target's size
  Vec3i stride{1, 1, 1};  ///< between target patches, >= 1
  NeighborMethod method = NeighborMethod::Exact;

  /// Which source positions may be used (a patch's first sample): empty, or of the source's size,
  /// allowed where not 0. At least one must be.
  const Array3D<std::uint8_t>* allowed = nullptr;
  /// A factor > 0 on the distance to each source position while choosing: of the source's size, or
  /// none. With 1 / (α + the distance of that source patch to its nearest target patch) this is the
  /// completeness term of Granot et al. 2022 (GPNN).
  const Array3D<float>* sourceWeight = nullptr;
  /// Largest difference allowed, along each axis, between a target patch's position and its match,
  /// after the target's position is scaled by (source - patch) / (target - patch); negative: no
  /// limit. For examples that are not stationary along an axis (terrain's height).
  Vec3i window{-1, -1, -1};
  /// Boxes of source positions, for target patches that are each matched in one of them only, as
  /// `placeOf` says: of the field's shape, an index into `places`. A `window` is then one of that
  /// box. Both or none.
  std::span<const CellBox> places;
  const Array3D<std::uint16_t>* placeOf = nullptr;
  /// A field to start from, of the same shape (the previous round's): PatchMatch begins with it,
  /// and Exact takes first upper bounds from it. Positions outside the source or not allowed are
  /// ignored.
  const NearestNeighborField* start = nullptr;
  /// Which target patches are searched for, where not 0: of the field's shape, or none for all. The
  /// others keep the match of `start`, which must be given.
  const Array3D<std::uint8_t>* wanted = nullptr;

  int iterations = 5;      ///< PatchMatch: rounds of propagation and random search; >= 1
  std::uint64_t seed = 0;  ///< PatchMatch
};

/// The nearest-neighbor field of `target` in `source`. The same bytes at any number of threads.
/// Exact costs O(target patches × source patches × patch) at the very worst, usually a small part
/// of it. Throws `InputError` for options out of range, channels of different sizes or numbers, and
/// where no position is allowed, and `Cancelled`.
NearestNeighborField nearestNeighborField(const Channels& source, const Channels& target,
                                          const NearestNeighborFieldOptions& options = {},
                                          const Progress& progress = {});

}  // namespace exemplar
