// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "sdf/distance_field.h"
#include "synth/geometry/pyramid.h"
#include "synth/geometry/repetition.h"
#include "synth/geometry/stationary.h"

/// How a result of `synthesizeOptimized` begins: on how many levels, from what, and how far parts
/// may be from their place.
namespace exemplar {

/// Levels of a start from small random blocks: the coarsest has about 16 samples along the longest
/// side, so that whatever is large is seen at once.
int randomStartLevels(const DistanceField& example);
/// Levels of a start from a quilt: the coarsest has at most 40 samples along the longest side.
int quiltLevels(const DistanceField& example);

/// Whether an example is ground, solid all over its lowest layer and air all over its highest, and
/// is higher at one side than at the opposite one by more than a voxel, along x or y. O(samples).
bool isSlopingGround(const DistanceField& example);

/// The coarsest level's start: blocks of random content, of a random part, kept to their place
/// along axes that are not stationary.
PyramidSources startFromRandomBlocks(const PyramidLevel& level, const StationaryAxes& stationary,
                                     std::uint64_t seed);

/// The steps after which a level's example, which is its only part, nearly repeats. Where the
/// result shall go on at its other side it must hold a whole number of them: else there are none.
Repetition repetitionOf(const PyramidLevel& level);

/// Brings pieces back in step with what repeats: half a coarse sample that they were off is a whole
/// one on the next level. Does nothing where nothing repeats.
void keepInStep(const PyramidLevel& level, const Repetition& repetition, PyramidSources& sources);

/// A start from large blocks (`quilt`), their joints cut, in step with what repeats. `air` is what
/// the level is framed by, voxels.
PyramidSources startFromQuilt(const PyramidLevel& level, const StationaryAxes& stationary,
                              const Repetition& repetition, std::uint64_t seed, float air,
                              const Progress& progress = {});

/// A start of the example's own size: its halves exchanged (`rearrange`), the joint cut. `l` is the
/// level's number. Empty where there are no such halves.
PyramidSources startFromHalves(const PyramidLevel& level, int l, const StationaryAxes& stationary,
                               std::uint64_t seed, float air, const Progress& progress = {});

/// How far from its proportional place along an axis that is not stationary a patch may come from,
/// samples. Where the result is not as long as the example, copied parts cannot all be in place:
/// more for them to hold together.
int placeWindow(const PyramidLevel& level, int axis);

/// How far from its proportional place along an axis a block may come from, samples; negative: any
/// distance. An object that is to be as long as it was keeps its ends, so its parts cannot go far,
/// and where it is thin they stay; so they do along an axis along which it stands on a side of its
/// box, as ground does.
Vec3i blockWindow(const PyramidLevel& level, const StationaryAxes& stationary);
/// The same for patches: as far as a block's may be whose middle is within its window.
Vec3i patchWindow(const PyramidLevel& level, const StationaryAxes& stationary);

}  // namespace exemplar
