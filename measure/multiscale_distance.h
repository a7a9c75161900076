// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "sdf/distance_field.h"

/// Whether a result is made of the same shapes as its example at several scales, copied or not.
namespace exemplar {

struct MultiscaleOptions {
  int patches = 4096;    ///< drawn from each field at each scale; >= 64
  int projections = 48;  ///< on which the patches' distributions are compared; >= 1
  std::uint64_t seed = 0;
};

/// The distance at one scale.
struct ScaleDistance {
  int scale = 1;        ///< the side of a sample, voxels: 1, 2, 4 or 8
  double distance = 0;  ///< between result and example, voxels, >= 0
  /// Between halves of the example, taken for what a fresh sample of as much would have; voxels, >
  /// 0.
  double floor = 0;
  double ratio() const { return distance / floor; }
};

/// How far the patches of a result's surface are from those of its example, as distributions.
struct MultiscaleDistance {
  std::vector<ScaleDistance> scales;  ///< those that the fields are large enough for
  double ratio = 0;  ///< the mean of the scales' ratios: about 1 for a fresh sample of the process
};

/// *Multi-scale distance*: at 1, 2, 4 and 8 times the voxel, the sliced Wasserstein distance
/// (Rabin, Peyré, Delon, Bernot: "Wasserstein barycenter and its application to texture mixing",
/// SSVM 2011, doi:10.1007/978-3-642-24785-9_37) between patches of the two fields.
///
/// A patch is 7³ samples around one within half a voxel of the surface; a sample at scale s is the
/// mean of s³ distances, in voxels, clamped to ±3 beforehand. So what is far from the surface
/// counts as inside or outside alone, and coarse samples are about shares of solid: distances that
/// synthesis put together need not be right far away. What lies beyond the box is as at its face;
/// where the box cuts the example, patches lie inside along that axis, and a scale that leaves less
/// than a tenth of either surface is left out.
///
/// Patches are projected on random directions, the same for all; along each, the distance is the
/// mean difference of the values in ascending order, and the figure its mean over the directions.
/// It asks for the same shapes in the same proportions, not for verbatim copies: a fresh sample
/// of the same process is at the floor, where likeness by windows (`patchLikeness`) is met best by
/// copying. Blind to what is farther apart than 28 samples at the largest scale.
///
/// Nothing where a field has no surface. About 0.5 s of CPU; the same bytes at any number of
/// threads. Throws `InputError` where voxel sizes differ, and `Cancelled`.
std::optional<MultiscaleDistance> multiscaleDistance(const DistanceField& example,
                                                     const DistanceField& result,
                                                     const MultiscaleOptions& options = {},
                                                     const Progress& progress = {});

}  // namespace exemplar
