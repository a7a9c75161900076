// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "maps/shape.h"

namespace exemplar {

/// The distance, in cells, from each cell's center to the nearest center of a cell that is not 0 in
/// `shape`; infinite everywhere where there is none. `wraps`: on the torus. Exact, by a pass of
/// lower envelopes of parabolas along each axis (Felzenszwalb, Huttenlocher 2012). O(cells).
Array3D<float> distanceTo(const Shape& shape, bool wraps);
/// The same of a picture.
inline Grid<float> distanceTo(const Grid<std::uint8_t>& shape, bool wraps) {
  return gridOf(distanceTo(boxOf(shape), wraps));
}

}  // namespace exemplar
