// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/window_lattice.h"

namespace exemplar {

PlaneBox WindowLattice::free(int phase, const PlanePoint& window) const {
  PlaneBox box = whole(phase, window);
  for (int axis = 0; axis < 2; ++axis) {
    box.begin[axis] += separator;
    box.end[axis] -= separator;
  }
  return box;
}

PlaneBox WindowLattice::whole(int phase, const PlanePoint& window) const {
  PlaneBox box;
  for (int axis = 0; axis < 2; ++axis) {
    box.begin[axis] = shift(phase) + window[axis] * pitch;
    box.end[axis] = box.begin[axis] + pitch + separator;
  }
  return box;
}

std::vector<PlanePoint> WindowLattice::touching(int phase, const PlaneBox& box) const {
  std::vector<PlanePoint> windows;
  if (box.empty()) return windows;
  PlanePoint first, last;
  for (int axis = 0; axis < 2; ++axis) {
    first[axis] = floorDivide(box.begin[axis] - shift(phase), pitch);
    last[axis] = floorDivide(box.end[axis] - 1 - shift(phase), pitch);
  }
  for (std::int64_t x = first.x; x <= last.x; ++x)
    for (std::int64_t y = first.y; y <= last.y; ++y) windows.push_back({x, y});
  return windows;
}

}  // namespace exemplar
