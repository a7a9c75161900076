// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "maps/grid.h"

namespace exemplar {

/// The distance, in pixels, from each pixel's center to the nearest center of a pixel that is not 0
/// in `shape`; infinite everywhere where there is none. `wraps`: on the torus. Exact, by two passes
/// of lower envelopes of parabolas (Felzenszwalb, Huttenlocher 2012). O(pixels).
Grid<float> distanceTo(const Grid<std::uint8_t>& shape, bool wraps);

}  // namespace exemplar
