// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct PatchDistanceOptions {
  /// Patches drawn from each field in each round; >= 64.
  int patches = 4000;
  /// Principal components of the example's patches that are kept; 1..343.
  int components = 32;
  /// How often both fields are sampled; the figure and its floor are means over the rounds. >= 1.
  int rounds = 4;
  std::uint64_t seed = 0;
};

/// The Fréchet patch distance of a result, and what the example scores against itself.
struct PatchDistance {
  double distance = 0;  ///< voxels², >= 0; less is more alike
  double floor = 0;     ///< the same between two samplings of the example
  std::int64_t examplePatches = 0, resultPatches = 0;  ///< how many there are to draw from
};

/// *FPD*: how far the result's patches of surface are from the example's, as distributions.
///
/// A patch is 7³ samples of the distance in voxels, truncated at ±3 (or less, where a field's own
/// truncation is less), centered on a sample within half a voxel of the surface and wholly inside
/// the field. 4,000 are drawn from each field, with repetition, so that a field of few patches has
/// a floor too. They are projected on the 32 principal components of the example's patches, and the
/// distance is that of the Gaussians with their means and covariances (Dowson, Landau: "The Fréchet
/// distance between multivariate normal distributions", Journal of Multivariate Analysis 12(3),
/// 1982, doi:10.1016/0047-259X(82)90077-X):
///
///     |m1 - m2|² + trace(S1 + S2 - 2 (S1 S2)^(1/2)),
///
/// squared, as the Fréchet inception distance is. It is blind to how the patches are arranged, and
/// its floor shrinks as one over the number of patches: compare figures of equal `patches` only.
///
/// Nothing where a field has no patch at all: one that is empty, solid, or thinner than 7 samples.
/// About 0.5 s; the same bytes at any number of threads. Throws `InputError` where the fields'
/// voxel sizes differ, and `Cancelled`.
std::optional<PatchDistance> patchDistance(const DistanceField& example,
                                           const DistanceField& result,
                                           const PatchDistanceOptions& options = {},
                                           const Progress& progress = {});

}  // namespace exemplar
