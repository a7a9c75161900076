// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/origin.h"
#include "core/progress.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

/// Re-makes a result at `factor` times its resolution: each of its samples becomes factor³ samples,
/// pulled through its origin from finer fields of the same examples, so the result gets detail that
/// the synthesis never saw. Seams then move to where the finer fields agree best and are evened
/// out, as at the end of a synthesis.
///
/// `fine` holds one field for each example, of exactly `factor` times its samples along each axis,
/// cut from the same box. `factor` is 1..16. O(samples of the finer result). The same bytes at any
/// number of threads. Throws `InputError` for fields that do not fit the origins, `Cancelled` when
/// cancelled.
SynthesisResult addDetail(std::span<const DistanceField* const> fine, const Origins& origins,
                          int factor, const Progress& progress = {});

/// A field sampled again: `factor` times the samples of `like` along each axis, in the same box, by
/// trilinear interpolation of `field`. Distances stay in world units.
DistanceField sampledFinely(const DistanceField& field, const DistanceField& like, int factor);

}  // namespace exemplar
