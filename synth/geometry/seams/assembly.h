// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/progress.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

/// The last steps, from where the samples of the finest level come from to a field: seams are cut
/// once more between the examples themselves, as finely as they are; broken pieces are cleared
/// away; steps across seams are evened out. What is left is copied from the examples, to the bit.
///
/// `size` is the result's, `target` what it should be near to, of the finest level's size as
/// `sources` are. Where `kept` is not 0 (of the result's size, or none) samples stay. The origins
/// name the examples as they were read, not turned. `clearKept`: what has broken off is cleared
/// away where it is kept, too. About O(samples near seams); the same bytes at any number of
/// threads. Throws `Cancelled`.
SynthesisResult assemble(const std::vector<SourcePart>& parts, const PyramidLevel& level,
                         const PyramidSources& sources, const Array3D<float>& target,
                         const Vec3i& size, const Array3D<std::uint8_t>* kept,
                         const Progress& progress = {}, bool clearKept = false);

}  // namespace exemplar
