// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/axes.h"
#include "core/origin.h"
#include "core/progress.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/seams/seams.h"

namespace exemplar {

/// Moves the seams of a result to where both sides agree best, as `refineSeams` does. Where it is
/// periodic, again with its faces in the middle; each time what is beside the outer faces stays, so
/// that what was cut there before does not change. Arguments, cost and cancelling as there.
void refineSeamsAround(const Array3D<float>& source, const Array3D<float>& target,
                       const Axes& periodic, SeamOptions options, Origins& origins,
                       const Progress& progress = {});

/// Moves a level's seams to where both sides agree best, and then whole pieces and the seams once
/// more: what a level starts with was found on a grid twice as coarse, and half of the offsets lie
/// between. `target` is what the level should be near to. Pieces grow into large ones.
void cutSeams(const PyramidLevel& level, const Array3D<float>& target, PyramidSources& sources,
              const Progress& progress = {});

/// Moves the joints of large blocks by up to `reach` samples to where both sides agree best, once.
/// Where `fixed` is not 0 (of the target's size with its margins, or none) samples stay.
void cutJoints(const PyramidLevel& level, const Array3D<float>& target, int reach,
               PyramidSources& sources, const Progress& progress = {},
               const Array3D<std::uint8_t>* fixed = nullptr);

}  // namespace exemplar
