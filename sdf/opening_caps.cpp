// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/opening_caps.h"

#include <algorithm>

#include "core/parallel.h"

namespace exemplar {
namespace {

class Caps {
 public:
  Caps(const SolidTest& solid, const Vec3i& low, const Array3D<std::uint8_t>& inside,
       const Array3D<float>& distances)
      : solid_(solid), low_(cast<double>(low)), inside_(inside), distances_(distances) {}

  // Whether the surface crosses an edge where no triangle can: one that did would be as near to
  // both ends together as the edge is long.
  bool isCap(const Vec3i& a, const Vec3i& b) const {
    return inside_[a] != inside_[b] && distances_[a] + distances_[b] > 1.0001f;
  }

  // Where the surface crosses an edge whose ends differ.
  Vec3d crossing(const Vec3i& a, const Vec3i& b) const {
    const Vec3d p = low_ + cast<double>(a), q = low_ + cast<double>(b);
    if (!isCap(a, b)) {
      const double da = distances_[a], db = distances_[b];
      return p + (q - p) * (da + db > 0 ? da / (da + db) : 0.5);
    }
    // The winding number is smooth along the edge: halve it.
    double s0 = 0, s1 = 1;
    for (int step = 0; step < 6; ++step) {
      const double s = (s0 + s1) / 2;
      (solid_.inside(p + (q - p) * s) == (inside_[a] != 0) ? s0 : s1) = s;
    }
    return p + (q - p) * ((s0 + s1) / 2);
  }

  // The vertex of the cell from `c` to `c` + (1, 1, 1): the mean of the crossings of its edges.
  Vec3d vertex(const Vec3i& c) const {
    Vec3d sum{};
    int count = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (int corner = 0; corner < 4; ++corner) {
        Vec3i a = c;
        a[(axis + 1) % 3] += corner & 1;
        a[(axis + 2) % 3] += corner >> 1;
        Vec3i b = a;
        ++b[axis];
        if (inside_[a] == inside_[b]) continue;
        sum += crossing(a, b);
        ++count;
      }
    return sum / count;
  }

 private:
  const SolidTest& solid_;
  Vec3d low_;
  const Array3D<std::uint8_t>& inside_;
  const Array3D<float>& distances_;
};

}  // namespace

std::vector<Corners> openingCaps(const SolidTest& solid, const Vec3i& low,
                                 const Array3D<std::uint8_t>& inside,
                                 const Array3D<float>& distances) {
  const Vec3i n = inside.size();
  const Caps caps(solid, low, inside, distances);
  std::vector<std::vector<Corners>> layers(static_cast<std::size_t>(n.z));
  parallelFor(0, layers.size(), 1, [&](std::size_t k0, std::size_t k1) {
    for (std::size_t layer = k0; layer < k1; ++layer) {
      const int k = static_cast<int>(layer);
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i)
          for (int axis = 0; axis < 3; ++axis) {
            const Vec3i a{i, j, k};
            Vec3i b = a;
            ++b[axis];
            if (!inside.contains(b) || !caps.isCap(a, b)) continue;
            // The four cells around the edge, in turn; at the box's sides some are missing.
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (a[u] == 0 || a[v] == 0 || a[u] + 1 >= n[u] || a[v] + 1 >= n[v]) continue;
            std::array<Vec3d, 4> corner;
            for (int c = 0; c < 4; ++c) {
              Vec3i cell = a;
              cell[u] -= c == 1 || c == 2;
              cell[v] -= c >= 2;
              corner[c] = caps.vertex(cell);
            }
            layers[layer].push_back({corner[0], corner[1], corner[2]});
            layers[layer].push_back({corner[0], corner[2], corner[3]});
          }
    }
  });
  std::vector<Corners> triangles;
  for (const auto& layer : layers) triangles.insert(triangles.end(), layer.begin(), layer.end());
  return triangles;
}

}  // namespace exemplar
