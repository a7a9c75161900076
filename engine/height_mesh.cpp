// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/height_mesh.h"

#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/memory.h"

namespace exemplar {
TriangleMesh meshOfHeights(const HeightMap& map, const Progress& progress) {
  const double points = static_cast<double>(map.width()) * map.height();
  requireMemory(64 * points, "the surface of the height map",
                "write a height map, or ask for a smaller `size`");
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex(map.heights.count());
  mesh.positions.reserve(map.heights.count());
  for (int row = 0; row < map.height(); ++row) {
    for (int column = 0; column < map.width(); ++column) {
      const float h = map.at(column, row);
      vertex[static_cast<std::size_t>(row) * map.width() + column] =
          static_cast<std::uint32_t>(mesh.positions.size());
      if (std::isnan(h)) continue;
      mesh.positions.push_back({(column + 0.5) * map.cellSize,
                                (map.height() - row - 0.5) * map.cellSize, static_cast<double>(h)});
    }
  }
  const auto at = [&](int column, int row) {
    return vertex[static_cast<std::size_t>(row) * map.width() + column];
  };
  mesh.triangles.reserve(2 * map.heights.count());
  for (int y = 0; y + 1 < map.height(); ++y) {
    progress.check();
    for (int x = 0; x + 1 < map.width(); ++x) {
      const float a = map.at(x, y), b = map.at(x + 1, y), c = map.at(x, y + 1),
                  d = map.at(x + 1, y + 1);
      if (std::isnan(a + b + c + d)) continue;
      if (std::abs(a - d) <= std::abs(b - c)) {
        mesh.triangles.push_back({at(x, y), at(x, y + 1), at(x + 1, y + 1)});
        mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x + 1, y)});
      } else {
        mesh.triangles.push_back({at(x, y), at(x, y + 1), at(x + 1, y)});
        mesh.triangles.push_back({at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)});
      }
    }
  }
  if (mesh.triangles.empty()) throw InputError("the height map has no four points with heights");
  return mesh;
}

}  // namespace exemplar
