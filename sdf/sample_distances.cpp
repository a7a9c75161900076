// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/sample_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace exemplar {

void sampleDistances(const TriangleTree& surface, double limit, Array3D<float>& distances) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  forBlocks(distances.size(), [&](const Vec3i& low, const Vec3i& high) {
    const Vec3d middle = (cast<double>(low) + cast<double>(high) - Vec3d{1, 1, 1}) * 0.5;
    const double reach = limit + length(middle - cast<double>(low));
    if (reach < kInfinity && surface.distance(middle, reach) >= reach) {
      for (int k = low.z; k < high.z; ++k)
        for (int j = low.y; j < high.y; ++j)
          for (int i = low.x; i < high.x; ++i) distances(i, j, k) = static_cast<float>(limit);
      return;
    }
    // A step of one voxel changes the distance by at most one: a tight bound to search within.
    double bound = kInfinity;
    serpentine(low, high, [&](const Vec3i& ijk) {
      const double d = surface.distance(cast<double>(ijk), std::min(limit, bound));
      distances[ijk] = static_cast<float>(d);
      bound = d < limit ? d + 1.0001 : kInfinity;
    });
  });
}

}  // namespace exemplar
