// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/terrain_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "maps/drainage.h"
#include "preview/render.h"
#include "preview/shaded_relief.h"

namespace exemplar {
namespace {

/// Streams are drawn where this share of the example's points drains through.
constexpr double kStreamShare = 1.0 / 400;

struct Shown {
  Grid<float> heights;
  Grid<std::uint8_t> water;
  double cellSize = 1;
};

Shown viewOf(const HeightMap& map, int reduce, std::size_t streamCells, const Progress& progress) {
  Grid<float> all(map.width, map.height);
  std::ranges::copy(map.heights, all.values().begin());
  const Drainage drainage = drain(all, progress);
  const Grid<std::uint32_t> accumulation = flowAccumulation(drainage);
  Shown view{Grid<float>(map.width / reduce, map.height / reduce), {}, map.cellSize * reduce};
  view.water = Grid<std::uint8_t>(view.heights.width(), view.heights.height());
  for (int y = 0; y < view.heights.height(); ++y) {
    for (int x = 0; x < view.heights.width(); ++x) {
      float sum = 0, count = 0;
      for (int v = y * reduce; v < (y + 1) * reduce; ++v) {
        for (int u = x * reduce; u < (x + 1) * reduce; ++u) {
          if (std::isnan(all(u, v))) continue;
          sum += all(u, v);
          count += 1;
          view.water(x, y) |= accumulation(u, v) >= streamCells;
        }
      }
      view.heights(x, y) = count > 0 ? sum / count : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return view;
}

}  // namespace

Image8 terrainPicture(const Result& result, const Example& example, int longest,
                      const Progress& progress) {
  const HeightMap &before = example.heights(), &after = result.heights();
  const int reduce = std::max({1, (before.width + after.width + longest - 1) / longest,
                               (std::max(before.height, after.height) + longest - 1) / longest});
  const auto streams = static_cast<std::size_t>(
      std::max(2.0, kStreamShare * static_cast<double>(before.heights.size())));
  const std::array<Shown, 2> views{viewOf(before, reduce, streams, progress.part(0, 0.3)),
                                   viewOf(after, reduce, streams, progress.part(0.3, 0.9))};
  ReliefOptions options;
  options.lowest = std::numeric_limits<double>::infinity();
  options.highest = -options.lowest;
  for (const float h : views[0].heights.values()) {
    if (std::isnan(h)) continue;
    options.lowest = std::min<double>(options.lowest, h);
    options.highest = std::max<double>(options.highest, h);
  }
  const auto reliefOf = [](const Shown& view, bool water) {
    ReliefHeights heights{view.heights.width(), view.heights.height(), view.heights.values(),
                          view.cellSize};
    if (water) heights.water = view.water.values();
    return heights;
  };
  options.exaggeration = reliefExaggeration(reliefOf(views[0], false));
  Image8 picture;
  for (const bool water : {true, false}) {
    if (!water) options.azimuth = -options.azimuth;
    std::vector<Image8> pair;
    for (const Shown& view : views) pair.push_back(shadedRelief(reliefOf(view, water), options));
    const Image8 row = sideBySide(pair, 8);
    if (picture.pixels.empty()) {
      picture = row;
      continue;
    }
    const std::size_t rowBytes = static_cast<std::size_t>(row.width) * 3;
    picture.pixels.insert(picture.pixels.end(), 8 * rowBytes, std::uint8_t{255});
    picture.pixels.insert(picture.pixels.end(), row.pixels.begin(), row.pixels.end());
    picture.height += 8 + row.height;
  }
  return picture;
}

TriangleMesh meshOfHeights(const HeightMap& map, const Progress& progress) {
  const double points = static_cast<double>(map.width) * map.height;
  requireMemory(64 * points, "the surface of the height map",
                "write a height map, or ask for a smaller `size`");
  TriangleMesh mesh;
  std::vector<std::uint32_t> vertex(map.heights.size());
  mesh.positions.reserve(map.heights.size());
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const float h = map.at(column, row);
      vertex[static_cast<std::size_t>(row) * map.width + column] =
          static_cast<std::uint32_t>(mesh.positions.size());
      if (std::isnan(h)) continue;
      mesh.positions.push_back({(column + 0.5) * map.cellSize,
                                (map.height - row - 0.5) * map.cellSize, static_cast<double>(h)});
    }
  }
  const auto at = [&](int column, int row) {
    return vertex[static_cast<std::size_t>(row) * map.width + column];
  };
  mesh.triangles.reserve(2 * map.heights.size());
  for (int y = 0; y + 1 < map.height; ++y) {
    progress.check();
    for (int x = 0; x + 1 < map.width; ++x) {
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
