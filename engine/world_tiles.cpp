// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world_tiles.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "core/cells.h"
#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "engine/model_request.h"
#include "engine/output.h"
#include "engine/words.h"
#include "mesh/mesh_file.h"
#include "reconstruct/adjacency.h"
#include "voxelize/label_file.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// What tiles are written to: what a result of labels is, but for what shows one layer, or time.
constexpr const char* kTileEndings = ".txt .vox .vdb .obj .ply .stl .off .glb .gltf";

std::optional<std::int64_t> wholeNumber(const std::string& text) {
  std::int64_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return n;
}

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

}  // namespace

std::vector<std::string> tileEndings(const World& world, const std::string& formats) {
  std::vector<std::string> endings;
  for (std::string text : split(formats, ',')) {
    if (text.empty()) continue;
    if (text.front() != '.') text.insert(text.begin(), '.');
    if ((" " + std::string(kTileEndings) + " ").find(" " + text + " ") == std::string::npos)
      throw InputError("`formats` " + text + ": tiles are written to " + kTileEndings);
    if (isMeshFile("tile" + text) &&
        std::holds_alternative<LabeledField>(world.examples().front().content))
      throw InputError("`formats` " + text +
                       ": a world of blocks of a field has no meshes; use .txt, .vox or .vdb");
    if (text == ".vox" && world.file().tile > 256)
      throw InputError("`formats` .vox: holds 256 cells a side at most, and a tile has " +
                       std::to_string(world.file().tile));
    if (std::ranges::find(endings, text) == endings.end()) endings.push_back(text);
  }
  if (endings.empty()) throw InputError("`formats`: no format is given");
  return endings;
}

TriangleMesh tileMesh(const World& world, const PlanePoint& tile, const Progress& progress) {
  const Example& example = world.examples().front();
  const auto* pieces = std::get_if<ModelPieces>(&example.content);
  const PlaneBox one{tile, {tile.x + 1, tile.y + 1}};
  if (!pieces) return realizeLabels(world.tile(tile, progress).labels(), example, progress);
  const Result around = world.around(one, 1, progress.part(0, 0.5));
  const LabelGrid& grid = around.labels();
  std::vector<std::uint32_t> cellOf;
  TriangleMesh mesh = assemblePieces(grid, *pieces, &cellOf, progress.part(0.5, 1));
  const CellBox inside{{1, 1, 0}, grid.size() - Vec3i{1, 1, 0}};
  std::vector<std::uint8_t> keep;
  for (const std::uint32_t cell : cellOf) keep.push_back(inside.contains(grid.cells.ijk(cell)));
  keepTriangles(mesh, keep);
  mesh.name = "tile " + tileText(tile);
  return mesh;
}

void writeTile(const World& world, const PlanePoint& tile, const Result& result,
               const fs::path& path, const Progress& progress) {
  if (isMeshFile(path)) {
    MeshFileOptions options = world.examples().front().reading.mesh;
    writeMesh(path, tileMesh(world, tile, progress), options);
    return;
  }
  LabelGrid grid = result.labels();
  for (int axis = 0; axis < 2; ++axis)
    grid.origin[axis] += static_cast<double>(tile[axis] * world.file().tile) * grid.cellSize[axis];
  writeLabels(path, grid, world.examples().front(), {}, progress);
}

MadeTiles makeTiles(const World& world, const PlaneBox& tiles, const MakeOptions& options,
                    const std::function<void(const MadeTiles&)>& made, const Progress& progress) {
  const auto missing = [&](const PlanePoint& tile) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const std::string& ending : options.endings) {
      fs::path path = world.tilePath(tile, ending);
      if (!fs::exists(path, error)) files.push_back(std::move(path));
    }
    return files;
  };
  MadeTiles state;
  state.all = tiles.columns();
  bool verified = false;
  std::mutex mutex;
  for (const PlaneBox& job : jobsOf(tiles, options.job)) {
    std::vector<std::pair<PlanePoint, std::vector<fs::path>>> work;
    for (const PlanePoint& tile : tilesOf(job))
      if (auto files = missing(tile); !files.empty()) work.emplace_back(tile, std::move(files));
    state.there += job.columns() - static_cast<std::int64_t>(work.size());
    if (work.empty()) continue;
    if (!verified) world.requireSameBytes(progress.part(0, 0));
    verified = true;
    // Together where most are wanted; a few alone.
    std::optional<Result> whole;
    const double done =
        static_cast<double>(state.there + state.made) / static_cast<double>(state.all);
    if (2 * static_cast<std::int64_t>(work.size()) >= job.columns())
      whole = world.tiles(job, progress.part(done, done));
    const Progress hearing([&](std::string_view, double) { progress.check(); });
    parallelFor(0, work.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        const PlanePoint& tile = work[n].first;
        std::string why;
        try {
          const Result result = whole ? world.tileOf(*whole, job, tile) : world.tile(tile, hearing);
          for (const fs::path& path : work[n].second) {
            std::error_code error;
            fs::create_directories(path.parent_path(), error);
            writeTile(world, tile, result, path, hearing);
          }
        } catch (const InputError& e) {
          why = e.what();
        }
        const std::lock_guard lock(mutex);
        if (why.empty()) {
          ++state.made;
        } else {
          state.failed.emplace_back(tile, why);
        }
        progress.report("making tiles", static_cast<double>(state.there + state.made) /
                                            static_cast<double>(state.all));
        if (made) made(state);
      }
    });
  }
  std::sort(state.failed.begin(), state.failed.end());
  return state;
}

CheckedTiles checkTiles(const World& world, const PlaneBox& tiles, const CheckOptions& options,
                        const Progress& progress) {
  CheckedTiles found;
  const std::vector<LabelGrid> examples = modelGrids(world.examples());
  const bool pairs = !std::holds_alternative<LabeledField>(world.examples().front().content);
  ModelSettings settings;
  modelSettings().apply(world.file().settings, settings);
  ViolationOptions rules;
  rules.adjacency = adjacencyOptions(settings);
  std::map<PlanePoint, Rim> rims;
  std::string hashes;
  const std::vector<PlanePoint> all = tilesOf(tiles);
  const double side = world.file().tile;
  for (const PlanePoint& tile : all) {
    progress.report("checking tiles",
                    static_cast<double>(found.tiles) / static_cast<double>(all.size()));
    ++found.tiles;
    const PlaneBox one{tile, {tile.x + 1, tile.y + 1}};
    const Result result = world.tile(tile);
    hashes += hashText(World::hashOf(result));
    if (pairs) {
      // With the column around: pairs across the border are counted from both sides.
      const AdjacencyViolations here =
          findViolations({&world.around(one, 1).labels(), 1}, examples, rules);
      found.pairs += here.pairs;
      found.violations += here.count;
    }
    for (const std::string& ending : split(kTileEndings, ' ')) {
      const fs::path path = world.tilePath(tile, ending);
      std::error_code error;
      if (!fs::exists(path, error)) continue;
      ++found.files;
      const std::uint64_t draw = contentHash(tileText(tile) + ending) % 10'000;
      if (static_cast<double>(draw) < 100 * options.remake) {
        ++found.remade;
        const fs::path again = fs::path(path).replace_filename(
            "." + path.stem().string() + "_again" + path.extension().string());
        writeTile(world, tile, result, again);
        if (readFile(again) != readFile(path)) found.different.push_back(path.string());
        fs::remove(again, error);
      }
      if (ending != ".glb") continue;
      const TriangleMesh mesh = readMesh(path);
      const LabelGrid& grid = result.labels();
      const Vec3d high = grid.origin + side * grid.cellSize;
      rims[tile] =
          rimOf(mesh, {static_cast<float>(grid.origin.x), static_cast<float>(grid.origin.y)},
                {static_cast<float>(high.x), static_cast<float>(high.y)});
    }
  }
  matchRims(rims, found);
  found.hash = contentHash(hashes);
  return found;
}

std::vector<ListedTile> listTiles(const World& world) {
  std::map<PlanePoint, std::vector<std::string>> found;
  std::error_code error;
  const fs::path folder = world.folder() / "tiles" / "0";
  for (const auto& column : fs::directory_iterator(folder, error)) {
    const auto x = wholeNumber(column.path().filename().string());
    if (!x || !column.is_directory()) continue;
    for (const auto& file : fs::directory_iterator(column.path(), error)) {
      const auto y = wholeNumber(file.path().stem().string());
      if (y) found[{*x, *y}].push_back(file.path().extension().string());
    }
  }
  std::vector<ListedTile> list;
  for (auto& [tile, endings] : found) {
    std::sort(endings.begin(), endings.end());
    list.push_back({tile, std::move(endings)});
  }
  return list;
}

}  // namespace exemplar
