// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Whether tiles of a world fit each other, and are what they should be.

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "engine/model_request.h"
#include "engine/words.h"
#include "engine/world_tiles.h"
#include "mesh/mesh_file.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// An edge on the plane between two tiles: its ends' coordinates along y (or x) and z, the lower
/// end first, as floats, in which files hold them.
using RimEdge = std::array<float, 4>;

/// The edges of one triangle alone on a tile's four sides. One on an upright line where four tiles
/// meet can go on in any of the three others, so these are kept apart.
struct Rim {
  std::array<std::vector<RimEdge>, 4> sides;    ///< low and high along x, then along y
  std::array<std::vector<RimEdge>, 4> corners;  ///< low x low y, high x low y, low high, high high
};

Rim rimOf(const TriangleMesh& mesh, const Vec2f& low, const Vec2f& high) {
  std::array<std::map<RimEdge, int>, 4> sides, corners;
  const auto at = [](const Vec3d& p, int axis) { return static_cast<float>(p[axis]); };
  for (const auto& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3d& a = mesh.positions[triangle[corner]];
      const Vec3d& b = mesh.positions[triangle[(corner + 1) % 3]];
      std::array<int, 2> side{-1, -1};  // for each axis, 0 for the low one, 1 for the high one
      for (int axis = 0; axis < 2; ++axis) {
        if (at(a, axis) != at(b, axis)) continue;
        const float lowest = axis == 0 ? low.x : low.y, highest = axis == 0 ? high.x : high.y;
        if (at(a, axis) == lowest) side[axis] = 0;
        if (at(a, axis) == highest) side[axis] = 1;
      }
      if (side[0] < 0 && side[1] < 0) continue;
      const bool upright = side[0] >= 0 && side[1] >= 0;
      const int axis = side[0] >= 0 ? 0 : 1;
      std::array<float, 2> p{upright ? 0 : at(a, 1 - axis), at(a, 2)};
      std::array<float, 2> q{upright ? 0 : at(b, 1 - axis), at(b, 2)};
      if (q < p) std::swap(p, q);
      auto& count = upright ? corners[side[0] + 2 * side[1]] : sides[2 * axis + side[axis]];
      ++count[{p[0], p[1], q[0], q[1]}];
    }
  }
  Rim rim;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const auto& [edge, triangles] : sides[k])
      if (triangles % 2 == 1) rim.sides[k].push_back(edge);
    for (const auto& [edge, triangles] : corners[k])
      if (triangles % 2 == 1) rim.corners[k].push_back(edge);
  }
  return rim;
}

/// How many edges are in one list alone; both ascending.
std::int64_t unmatchedEdges(const std::vector<RimEdge>& a, const std::vector<RimEdge>& b) {
  std::vector<RimEdge> alone;
  std::ranges::set_symmetric_difference(a, b, std::back_inserter(alone));
  return static_cast<std::int64_t>(alone.size());
}

/// Compares the rims of neighboring tiles: each edge is there in an even number of them.
void matchRims(const std::map<PlanePoint, Rim>& rims, CheckedTiles& found) {
  for (const auto& [tile, rim] : rims) {
    for (int axis = 0; axis < 2; ++axis) {
      PlanePoint next = tile;
      ++next[axis];
      const auto beside = rims.find(next);
      if (beside == rims.end()) continue;
      const auto& here = rim.sides[2 * axis + 1];
      const auto& there = beside->second.sides[2 * axis];
      found.rimEdges += static_cast<std::int64_t>(here.size() + there.size());
      found.unmatched += unmatchedEdges(here, there);
    }
    // Where this tile and three others meet.
    std::map<RimEdge, int> tiles;
    int meeting = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const auto around = rims.find({tile.x + 1 - corner % 2, tile.y + 1 - corner / 2});
      if (around == rims.end()) continue;
      ++meeting;
      for (const RimEdge& edge : around->second.corners[static_cast<std::size_t>(corner)])
        ++tiles[edge];
    }
    if (meeting < 4) continue;
    for (const auto& [edge, count] : tiles) {
      found.rimEdges += count;
      found.unmatched += count % 2;
    }
  }
}

/// Counts neighbors: of labels pairs of cells, of heights the points that two tiles share.
class Neighbors {
 public:
  explicit Neighbors(const World& world) : world_(world) {
    const Example& example = world.examples().front();
    if (example.form() != Form::Labels || std::holds_alternative<LabeledField>(example.content))
      return;
    examples_ = modelGrids(world.examples());
    ModelSettings settings;
    modelSettings().apply(world.file().settings, settings);
    rules_.adjacency = adjacencyOptions(settings);
  }

  void count(const PlanePoint& tile, const Result& result, CheckedTiles& found) {
    if (result.form() == Form::Heights) {
      shared(tile, result.heights().heights, found);
    } else if (!examples_.empty()) {
      // With the column around: pairs across the border are counted from both sides.
      const Result around = world_.around({tile, {tile.x + 1, tile.y + 1}}, 1);
      const AdjacencyViolations here = findViolations({&around.labels(), 1}, examples_, rules_);
      found.pairs += here.pairs;
      found.violations += here.count;
    }
  }

 private:
  /// Against the tiles to the west and to the south, which come before.
  void shared(const PlanePoint& tile, const Grid<float>& heights, CheckedTiles& found) {
    const int n = heights.width();
    std::array<std::vector<float>, 4> border;  // west, east, south, north
    for (int k = 0; k < n; ++k) {
      border[0].push_back(heights(0, n - 1 - k));
      border[1].push_back(heights(n - 1, n - 1 - k));
      border[2].push_back(heights(k, n - 1));
      border[3].push_back(heights(k, 0));
    }
    for (int axis = 0; axis < 2; ++axis) {
      PlanePoint before = tile;
      --before[axis];
      const auto beside = borders_.find(before);
      if (beside == borders_.end()) continue;
      for (int k = 0; k < n; ++k) {
        ++found.pairs;
        found.violations += border[2 * axis][k] != beside->second[2 * axis + 1][k];
      }
    }
    borders_[tile] = std::move(border);
  }

  const World& world_;
  std::vector<LabelGrid> examples_;
  ViolationOptions rules_;
  std::map<PlanePoint, std::array<std::vector<float>, 4>> borders_;
};

/// The rim of a tile's mesh, with its corner at 0 of heights and where the example has it of
/// labels.
Rim rimOfFile(const World& world, const Result& result, const fs::path& path) {
  const double side = world.file().tile;
  Vec3d low{0, 0, 0}, high;
  if (result.form() == Form::Heights) {
    high = Vec3d{side, side, 0} * result.heights().cellSize;
  } else {
    low = result.labels().origin;
    high = low + side * result.labels().cellSize;
  }
  return rimOf(readMesh(path), {static_cast<float>(low.x), static_cast<float>(low.y)},
               {static_cast<float>(high.x), static_cast<float>(high.y)});
}

/// Whether a tile that is made again has a file's bytes.
bool isSameAgain(const World& world, const PlanePoint& tile, const Result& result,
                 const fs::path& path) {
  const fs::path again = fs::path(path).replace_filename("." + path.stem().string() + "_again" +
                                                         path.extension().string());
  writeTile(world, tile, result, again);
  const bool same = readFile(again) == readFile(path);
  std::error_code error;
  fs::remove(again, error);
  fs::remove(again.string() + ".json", error);
  return same;
}

}  // namespace

CheckedTiles checkTiles(const World& world, const PlaneBox& tiles, const CheckOptions& options,
                        const Progress& progress) {
  CheckedTiles found;
  Neighbors neighbors(world);
  std::map<PlanePoint, Rim> rims;
  std::string hashes;
  const std::vector<PlanePoint> all = tilesOf(tiles);
  for (const PlanePoint& tile : all) {
    progress.report("checking tiles",
                    static_cast<double>(found.tiles) / static_cast<double>(all.size()));
    ++found.tiles;
    const Result result = world.tile(tile);
    hashes += hashText(World::hashOf(result));
    neighbors.count(tile, result, found);
    for (const std::string& ending : split(tileEndings(world), ' ')) {
      const fs::path path = world.tilePath(tile, ending);
      std::error_code error;
      if (!fs::exists(path, error)) continue;
      ++found.files;
      const std::uint64_t draw = contentHash(tileText(tile) + ending) % 10'000;
      if (static_cast<double>(draw) < 100 * options.remake) {
        ++found.remade;
        if (!isSameAgain(world, tile, result, path)) found.different.push_back(path.string());
      }
      if (ending == ".glb") rims[tile] = rimOfFile(world, result, path);
    }
  }
  matchRims(rims, found);
  found.hash = contentHash(hashes);
  return found;
}

}  // namespace exemplar
