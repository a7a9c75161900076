// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>

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

}  // namespace exemplar
