// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/near_materials.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace exemplar {
namespace {

// Of a sample around which there is no triangle yet, while samples are marked.
constexpr std::uint32_t kNothing = NearMaterials::kUnknown - 1;
// Triangles whose box holds more cells than this are cut into halves, but not for ever.
constexpr std::int64_t kMostCells = 125;
constexpr int kMostHalvings = 40;
// What rounding may take from a reach, cells.
constexpr double kRounding = 1e-6;

}  // namespace

NearMaterials::NearMaterials(const TriangleMesh& mesh, std::span<const std::uint32_t> materials,
                             const DistanceField& field, double reach, int cells)
    : reach_(reach * cells + kRounding),
      cells_(cells),
      material_(field.size() * cells, kNothing),
      triangle_(field.size() * cells, kUnknown),
      away_(field.size() * cells, std::numeric_limits<float>::infinity()) {
  assert(reach > 0 && cells >= 1 && materials.size() == mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Vec3d, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const Vec3d index = field.index(mesh.positions[mesh.triangles[t][c]]);
      corners[c] = (index + Vec3d{0.5, 0.5, 0.5}) * cells;
    }
    mark(corners, static_cast<std::uint32_t>(t), materials[t], kMostHalvings);
  }
  for (std::uint32_t& m : material_.values()) {
    if (m == kNothing) m = kUnknown;
  }
  away_ = {};
}

Vec3i NearMaterials::cellOf(const Vec3d& index) const {
  // Far outside the field numbers may not fit.
  const auto whole = [&](double x) {
    return static_cast<int>(std::floor(std::clamp((x + 0.5) * cells_, -1.0, 1e9)));
  };
  return {whole(index.x), whole(index.y), whole(index.z)};
}

// `corners` in cells: cell (0, 0, 0) from 0 to 1.
void NearMaterials::mark(const std::array<Vec3d, 3>& corners, std::uint32_t triangle,
                         std::uint32_t material, int halvings) {
  Vec3i low, high;
  for (int a = 0; a < 3; ++a) {
    const auto [least, most] = std::minmax({corners[0][a], corners[1][a], corners[2][a]});
    const double last = material_.size()[a] - 1.0;
    low[a] = static_cast<int>(std::clamp(std::floor(least - reach_), 0.0, last + 1));
    high[a] = static_cast<int>(std::clamp(std::floor(most + reach_), -1.0, last));
    if (low[a] > high[a]) return;
  }
  if (halvings > 0 && volume(high - low + Vec3i{1, 1, 1}) > kMostCells) {
    int longest = 0;
    double most = 0;
    for (int c = 0; c < 3; ++c) {
      const double side = length(corners[(c + 1) % 3] - corners[c]);
      if (side > most) {
        most = side;
        longest = c;
      }
    }
    if (most > 1) {
      const Vec3d &a = corners[longest], &b = corners[(longest + 1) % 3];
      const Vec3d &apex = corners[(longest + 2) % 3], middle = (a + b) * 0.5;
      mark({a, middle, apex}, triangle, material, halvings - 1);
      mark({middle, b, apex}, triangle, material, halvings - 1);
      return;
    }
  }
  const Vec3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  for (int k = low.z; k <= high.z; ++k) {
    for (int j = low.y; j <= high.y; ++j) {
      for (int i = low.x; i <= high.x; ++i) {
        std::uint32_t& m = material_(i, j, k);
        if (m != material) m = m == kNothing ? material : kUnknown;
        const Vec3d between = Vec3d{i + 0.5, j + 0.5, k + 0.5} - middle;
        const auto away = static_cast<float>(dot(between, between));
        if (away < away_(i, j, k)) {
          away_(i, j, k) = away;
          triangle_(i, j, k) = triangle;
        }
      }
    }
  }
}

}  // namespace exemplar
