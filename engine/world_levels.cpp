// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world_levels.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "engine/height_mesh.h"
#include "engine/json.h"
#include "engine/world_tiles.h"
#include "mesh/given_normals.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// Heights of a part of the plane, and where its southwest point is.
struct Part {
  HeightMap map;
  PlanePoint begin;

  float at(std::int64_t x, std::int64_t y) const {
    return map.at(static_cast<int>(x - begin.x), map.height() - 1 - static_cast<int>(y - begin.y));
  }
};

/// Every `step`-th point of a square of `side` of such steps from `corner` on, and one more around.
HeightMap everyPoint(const Part& part, const PlanePoint& corner, int side, int step) {
  HeightMap map = part.map;
  map.cellSize = part.map.cellSize * step;
  map.heights = Grid<float>(side + 3, side + 3);
  for (int row = 0; row < side + 3; ++row)
    for (int column = 0; column < side + 3; ++column)
      map.heights(column, row) =
          part.at(corner.x + static_cast<std::int64_t>(column - 1) * step,
                  corner.y + static_cast<std::int64_t>(side + 1 - row) * step);
  return map;
}

/// The height of the surface that `meshOfHeights` makes between four points, from the upper left
/// one: u to the right and v down, 0..1.
double between(const HeightMap& map, int column, int row, double u, double v) {
  const double a = map.at(column, row), b = map.at(column + 1, row), c = map.at(column, row + 1),
               d = map.at(column + 1, row + 1);
  if (std::abs(map.at(column, row) - map.at(column + 1, row + 1)) <=
      std::abs(map.at(column + 1, row) - map.at(column, row + 1)))
    return v >= u ? a + v * (c - a) + u * (d - c) : a + u * (b - a) + v * (d - b);
  return u + v <= 1 ? a + u * (b - a) + v * (c - a) : d + (1 - u) * (c - d) + (1 - v) * (b - d);
}

/// The largest distance, up or down, of the square's points from the surface of every `step`-th.
double distanceOf(const Part& part, const HeightMap& coarse, const PlanePoint& corner, int side,
                  int step) {
  double largest = 0;
  const auto placed = [&](int k) {
    const int cell = std::min(k / step, side - 1);
    return std::pair{cell, static_cast<double>(k - cell * step) / step};
  };
  for (int j = 0; j <= side * step; ++j) {
    const auto [row, up] = placed(j);
    for (int i = 0; i <= side * step; ++i) {
      const auto [column, right] = placed(i);
      // The first row and column of `coarse` are around the square.
      const double surface = between(coarse, 1 + column, side - row, right, 1 - up);
      largest = std::max(largest, std::abs(surface - part.at(corner.x + i, corner.y + j)));
    }
  }
  return largest;
}

/// Fills, in the planes of the square's border, what is between the surface's edges and the
/// world's points, seen from both sides.
void closeBorder(const Part& part, const PlanePoint& corner, int side, int step, TriangleMesh& mesh,
                 std::vector<Vec3f>& normals) {
  const int fine = side * step;
  const double cell = part.map.cellSize;
  // Vertices of the surface come row after row, the northern one first.
  const auto vertexOf = [&](int i, int j) {
    return static_cast<std::size_t>(side - j / step) * static_cast<std::size_t>(side + 1) +
           static_cast<std::size_t>(i / step);
  };
  const auto add = [&](int i, int j) {
    mesh.positions.push_back({i * cell, j * cell, part.at(corner.x + i, corner.y + j)});
    const Vec3f normal = normals[vertexOf(i, j)];
    normals.push_back(normal);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  for (int edge = 0; edge < 4; ++edge) {
    const auto place = [&](int k) {
      const int across = edge % 2 == 0 ? 0 : fine;
      return edge < 2 ? std::pair{k, across} : std::pair{across, k};
    };
    for (int k = 0; k < fine; k += step) {
      std::vector<std::uint32_t> fan;
      for (int s = 0; s <= step; ++s) fan.push_back(add(place(k + s).first, place(k + s).second));
      for (std::size_t s = 1; s + 1 < fan.size(); ++s) {
        mesh.triangles.push_back({fan[0], fan[s], fan[s + 1]});
        mesh.triangles.push_back({fan[0], fan[s + 1], fan[s]});
      }
    }
  }
}

/// Writes one coarser tile out of a part that holds it and a step around it.
void writeLevelTile(const World& world, const Part& part, int level, const PlanePoint& tile) {
  const int step = 1 << level, side = world.file().tile;
  const PlanePoint corner{tile.x * side * step, tile.y * side * step};
  const HeightMap coarse = everyPoint(part, corner, side, step);
  std::vector<Vec3f> normals;
  TriangleMesh mesh = meshOfInside(coarse, normals, {});
  mesh.name = "tile " + tileText(tile) + " of level " + std::to_string(level);
  closeBorder(part, corner, side, step, mesh, normals);
  const fs::path path = levelPath(world, level, tile, ".glb");
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  writeFile(levelPath(world, level, tile, ".json"),
            jsonText(Json{{"error", distanceOf(part, coarse, corner, side, step)}}, 1) + "\n");
  writeMeshWithNormals(path, mesh, normals, world.examples().front().reading.mesh);
}

/// The coarser tiles of some levels in one of a level, which come first.
std::vector<std::pair<int, PlanePoint>> tilesWithin(int level, const PlanePoint& tile) {
  std::vector<std::pair<int, PlanePoint>> list;
  for (int m = level; m > 0; --m) {
    const std::int64_t n = std::int64_t{1} << (level - m);
    for (std::int64_t x = 0; x < n; ++x)
      for (std::int64_t y = 0; y < n; ++y) list.push_back({m, {tile.x * n + x, tile.y * n + y}});
  }
  return list;
}

/// The largest squares of coarser tiles that fit into a region, none within another.
std::vector<std::pair<int, PlanePoint>> squaresOf(const PlaneBox& tiles, int levels) {
  std::vector<std::pair<int, PlanePoint>> squares;
  for (int level = levels; level > 0; --level) {
    const std::int64_t n = std::int64_t{1} << level;
    const PlaneBox whole{{-floorDivide(-tiles.begin.x, n), -floorDivide(-tiles.begin.y, n)},
                         {floorDivide(tiles.end.x, n), floorDivide(tiles.end.y, n)}};
    for (std::int64_t x = whole.begin.x; x < whole.end.x; ++x) {
      for (std::int64_t y = whole.begin.y; y < whole.end.y; ++y) {
        const bool within = std::ranges::any_of(squares, [&](const auto& square) {
          const std::int64_t wider = std::int64_t{1} << (square.first - level);
          return floorDivide(x, wider) == square.second.x &&
                 floorDivide(y, wider) == square.second.y;
        });
        if (!within) squares.push_back({level, {x, y}});
      }
    }
  }
  return squares;
}

}  // namespace

fs::path levelPath(const World& world, int level, const PlanePoint& tile,
                   const std::string& ending) {
  return world.folder() / "tiles" / std::to_string(level) / std::to_string(tile.x) /
         (std::to_string(tile.y) + ending);
}

std::optional<double> levelError(const World& world, int level, const PlanePoint& tile) {
  std::error_code none;
  const fs::path path = levelPath(world, level, tile, ".json");
  if (!fs::exists(levelPath(world, level, tile, ".glb"), none) || !fs::exists(path, none))
    return std::nullopt;
  const Json said = Json::parse(readFile(path), nullptr, false);
  if (!said.is_object() || !said.contains("error") || !said["error"].is_number())
    return std::nullopt;
  return said["error"].get<double>();
}

MadeLevels makeLevels(const World& world, const PlaneBox& tiles, int levels,
                      const Progress& progress) {
  if (world.examples().front().form() != Form::Heights)
    throw InputError("`lod`: worlds of labels have one level alone; leave it out");
  MadeLevels state;
  const auto squares = squaresOf(tiles, levels);
  for (std::size_t n = 0; n < squares.size(); ++n) {
    const Progress share =
        progress.part(static_cast<double>(n) / static_cast<double>(squares.size()),
                      static_cast<double>(n + 1) / static_cast<double>(squares.size()));
    const auto& [level, square] = squares[n];
    auto missing = tilesWithin(level, square);
    const auto all = static_cast<std::int64_t>(missing.size());
    std::erase_if(missing, [&](const auto& m) { return levelError(world, m.first, m.second); });
    state.there += all - static_cast<std::int64_t>(missing.size());
    if (missing.empty()) continue;
    const std::int64_t across = std::int64_t{1} << level;
    const PlaneBox range{{square.x * across, square.y * across},
                         {(square.x + 1) * across, (square.y + 1) * across}};
    const int around = 1 << level, side = world.file().tile;
    const Result result = world.around(range, around, share);
    const Part part{result.heights(),
                    {range.begin.x * side - around, range.begin.y * side - around}};
    for (const auto& [m, tile] : missing) {
      progress.check();
      writeLevelTile(world, part, m, tile);
      ++state.made;
    }
  }
  return state;
}

}  // namespace exemplar
