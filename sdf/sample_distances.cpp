// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/sample_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/cells.h"

namespace exemplar {

void sampleDistances(const TriangleTree& surface, double limit, const Vec3i& low,
                     Array3D<float>& distances, const Progress& progress) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto sample = [&](const Vec3i& first, const Vec3i& end) {
    const Vec3d middle =
        cast<double>(low) + (cast<double>(first) + cast<double>(end) - Vec3d{1, 1, 1}) * 0.5;
    const double reach = limit + length(middle - cast<double>(low + first));
    if (reach < kInfinity && surface.distance(middle, reach) >= reach) {
      forEachCell(CellBox{first, end},
                  [&](const Vec3i& ijk) { distances[ijk] = static_cast<float>(limit); });
      return;
    }
    // The triangle nearest to the sample before is near: a bound to search within.
    std::uint32_t near = TriangleTree::kNone;
    serpentine(first, end, [&](const Vec3i& ijk) {
      distances[ijk] = static_cast<float>(surface.distance(cast<double>(low + ijk), limit, near));
    });
  };
  forBlocks(distances.size(), 8, progress, "measuring distances", sample);
}

}  // namespace exemplar
