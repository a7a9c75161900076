// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/simplify_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace exemplar {
namespace {

constexpr int kFinest = 4096;  // cells along the longest side

/// For each vertex the number of its cell, from 0 without gaps.
std::vector<std::uint32_t> cellNumbers(const TriangleMesh& mesh, const Box3d& box, int cells,
                                       std::uint32_t* count) {
  const Vec3d size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  const double scale = longest > 0 ? cells / longest : 0;
  std::vector<std::uint64_t> codes(mesh.positions.size());
  for (std::size_t v = 0; v < codes.size(); ++v) {
    const Vec3d p = (mesh.positions[v] - box.min) * scale;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = std::clamp(std::floor(p[axis]), 0.0, static_cast<double>(cells));
      codes[v] = codes[v] << 13 | static_cast<std::uint64_t>(step);
    }
  }
  std::vector<std::uint64_t> sorted = codes;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  *count = static_cast<std::uint32_t>(sorted.size());
  std::vector<std::uint32_t> numbers(codes.size());
  for (std::size_t v = 0; v < codes.size(); ++v)
    numbers[v] = static_cast<std::uint32_t>(
        std::lower_bound(sorted.begin(), sorted.end(), codes[v]) - sorted.begin());
  return numbers;
}

TriangleMesh joined(const TriangleMesh& mesh, const Box3d& box, int cells) {
  TriangleMesh coarse;
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> cell = cellNumbers(mesh, box, cells, &count);
  coarse.positions.assign(count, {});
  std::vector<double> members(count, 0);
  for (std::size_t v = 0; v < cell.size(); ++v) {
    coarse.positions[cell[v]] += mesh.positions[v];
    members[cell[v]] += 1;
  }
  for (std::uint32_t c = 0; c < count; ++c) coarse.positions[c] *= 1 / members[c];
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> corners{cell[t[0]], cell[t[1]], cell[t[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[0] == corners[2]) continue;
    // The lowest corner first, and the same triangle once.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    coarse.triangles.push_back(corners);
  }
  std::sort(coarse.triangles.begin(), coarse.triangles.end());
  coarse.triangles.erase(std::unique(coarse.triangles.begin(), coarse.triangles.end()),
                         coarse.triangles.end());
  return coarse;
}

}  // namespace

TriangleMesh simplifySoup(const TriangleMesh& mesh, std::int64_t triangles) {
  const Box3d box = boundingBox(mesh);
  TriangleMesh best;
  for (int low = 1, high = kFinest; low <= high;) {
    const int cells = (low + high) / 2;
    TriangleMesh coarse = joined(mesh, box, cells);
    if (static_cast<std::int64_t>(coarse.triangles.size()) > triangles) {
      high = cells - 1;
    } else {
      low = cells + 1;
      if (!coarse.triangles.empty()) best = std::move(coarse);
    }
  }
  if (best.triangles.empty()) {
    best.positions = mesh.positions;
    best.triangles.assign(mesh.triangles.begin(),
                          mesh.triangles.begin() +
                              std::min<std::ptrdiff_t>(
                                  triangles, static_cast<std::ptrdiff_t>(mesh.triangles.size())));
  }
  return best;
}

}  // namespace exemplar
