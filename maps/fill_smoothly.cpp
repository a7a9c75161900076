// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/fill_smoothly.h"

#include "maps/halved.h"

namespace exemplar {

void fillSmoothly(std::vector<Array3D<float>>& planes, const Shape& hole) {
  Array3D<float> known(hole.size());
  for (std::size_t p = 0; p < hole.count(); ++p) known.data()[p] = hole.data()[p] ? 0.0f : 1.0f;
  for (Array3D<float>& plane : planes) {
    // Sums and weights at every resolution, down to one cell.
    std::vector<Array3D<float>> sums{plane}, weights{known};
    for (std::size_t p = 0; p < plane.count(); ++p) sums[0].data()[p] *= known.data()[p];
    while (volume(sums.back().size()) > 1) {
      sums.push_back(halved(sums.back(), true));
      weights.push_back(halved(weights.back(), true));
    }
    for (std::size_t p = 0; p < plane.count(); ++p) {
      if (known.data()[p] > 0) continue;
      Vec3i at = plane.ijk(p);
      std::size_t level = 0;
      while (level + 1 < sums.size() && !(weights[level][at] > 0)) {
        at = {at.x / 2, at.y / 2, at.z / 2};
        ++level;
      }
      const float weight = weights[level][at];
      plane.data()[p] = weight > 0 ? sums[level][at] / weight : 0;
    }
  }
}

}  // namespace exemplar
