// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/axes.h"
#include "synth/geometry/pyramid/pyramid.h"

/// How far parts may be from their proportional place: where along an axis a part of a result is,
/// as a share of its length, and where in the example it comes from.
namespace exemplar {

/// How far from its proportional place along an axis that is not stationary a patch may come from,
/// samples. Where the result is not as long as the example, copied parts cannot all be in place, so
/// they may come from farther off, to hold together.
int placeWindow(const PyramidLevel& level, int axis);

/// How far from its proportional place along each axis a block may come from, samples; negative:
/// any distance. An object that is to be as long as it was keeps its ends, so its parts cannot go
/// far, and where it is thin they stay. So do they along an axis along which the solid rests on one
/// side of its box, as ground does, and along axes that are `inPlace`.
Vec3i blockWindow(const PyramidLevel& level, const Axes& stationary, const Axes& inPlace = {});
/// The same for patches: as far as those of a block may be whose middle is within its window.
Vec3i patchWindow(const PyramidLevel& level, const Axes& stationary, const Axes& inPlace = {});

}  // namespace exemplar
