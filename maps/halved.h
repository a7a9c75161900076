// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>

#include "core/array3d.h"
#include "core/cells.h"
#include "maps/grid.h"

namespace exemplar {

/// At half the resolution: the mean of each 2 x 2 pixels. A last odd row or column is left out, or,
/// with `keepsOdd`, is a pixel of its own. At least one pixel.
inline Grid<float> halved(const Grid<float>& values, bool keepsOdd) {
  const int more = keepsOdd ? 1 : 0;
  Grid<float> half(std::max(1, (values.width() + more) / 2),
                   std::max(1, (values.height() + more) / 2));
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      const int x1 = std::min(2 * x + 1, values.width() - 1);
      const int y1 = std::min(2 * y + 1, values.height() - 1);
      half(x, y) =
          (values(2 * x, 2 * y) + values(x1, 2 * y) + values(2 * x, y1) + values(x1, y1)) / 4;
    }
  }
  return half;
}

/// The same of a box: the mean of 2 x 2 x 2 cells; along an axis of one cell it stays as it is.
inline Array3D<float> halved(const Array3D<float>& values, bool keepsOdd) {
  const int more = keepsOdd ? 1 : 0;
  const Vec3i& size = values.size();
  Vec3i halfSize;
  for (int axis = 0; axis < 3; ++axis) halfSize[axis] = std::max(1, (size[axis] + more) / 2);
  Array3D<float> half(halfSize);
  parallelForEachCell(halfSize, [&](const Vec3i& p) {
    const Vec3i low = p * 2, high = min(low + Vec3i{1, 1, 1}, size - Vec3i{1, 1, 1});
    const auto row = [&](int y, int z) { return values(low.x, y, z) + values(high.x, y, z); };
    const float near = row(low.y, low.z) + row(high.y, low.z);
    half[p] = low.z == high.z ? near / 4 : (near + row(low.y, high.z) + row(high.y, high.z)) / 8;
  });
  return half;
}

}  // namespace exemplar
