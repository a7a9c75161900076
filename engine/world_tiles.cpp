// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world_tiles.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <mutex>
#include <optional>

#include "core/cells.h"
#include "core/error.h"
#include "core/file.h"
#include "core/parallel.h"
#include "engine/height_mesh.h"
#include "engine/output.h"
#include "engine/words.h"
#include "maps/height_map_file.h"
#include "mesh/given_normals.h"
#include "mesh/mesh_file.h"
#include "mesh/shading_normals.h"
#include "reconstruct/adjacency.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

std::optional<std::int64_t> wholeNumber(const std::string& text) {
  std::int64_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return n;
}

}  // namespace

const char* tileEndings(const World& world) {
  // What a result is written to, but for what shows one layer, or time.
  return world.examples().front().form() == Form::Heights
             ? ".tif .png .asc .r16 .raw .exr .pgm .obj .ply .stl .off .glb .gltf"
             : ".txt .vox .vdb .obj .ply .stl .off .glb .gltf";
}

std::string usualFormat(const World& world) {
  return world.examples().front().form() == Form::Heights ? "tif" : "glb";
}

std::vector<std::string> tileEndings(const World& world, const std::string& formats) {
  std::vector<std::string> endings;
  for (std::string text : split(formats.empty() ? usualFormat(world) : formats, ',')) {
    if (text.empty()) continue;
    if (text.front() != '.') text.insert(text.begin(), '.');
    if ((" " + std::string(tileEndings(world)) + " ").find(" " + text + " ") == std::string::npos)
      throw InputError("`formats` " + text + ": tiles are written to " + tileEndings(world));
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

namespace {

/// A tile of pieces. Cells around it are seen, so that its edges are divided as its neighbors' are.
TriangleMesh meshOfPieces(const World& world, const PlaneBox& one, const ModelPieces& pieces,
                          const Progress& progress) {
  const Result around = world.around(one, 1, progress.part(0, 0.5));
  const LabelGrid& grid = around.labels();
  std::vector<std::uint32_t> cellOf;
  TriangleMesh mesh = assemblePieces(grid, pieces, &cellOf, progress.part(0.5, 1));
  const CellBox inside{{1, 1, 0}, grid.size() - Vec3i{1, 1, 0}};
  std::vector<std::uint8_t> keep;
  for (const std::uint32_t cell : cellOf) keep.push_back(inside.contains(grid.cells.ijk(cell)));
  keepTriangles(mesh, keep);
  return mesh;
}

/// A tile of heights, and the normals of its vertices: those of its border are its neighbors', too,
/// for the points beyond are seen.
TriangleMesh meshOfHeightTile(const World& world, const PlaneBox& one, std::vector<Vec3f>& normals,
                              const Progress& progress) {
  const Result around = world.around(one, 1, progress.part(0, 0.5));
  return meshOfInside(around.heights(), normals, progress.part(0.5, 1));
}

}  // namespace

TriangleMesh meshOfInside(const HeightMap& map, std::vector<Vec3f>& normals,
                          const Progress& progress) {
  TriangleMesh all = meshOfHeights(map, progress.part(0, 0.4));
  const ShadingNormals shading = shadingNormals(all, MeshNormals::Smooth, progress.part(0.4, 1));
  std::vector<std::uint32_t> normalOf(all.positions.size());
  for (std::size_t t = 0; t < all.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) normalOf[all.triangles[t][c]] = shading.corners[t][c];
  // Without the points around it, which has all rows and columns of its own.
  const auto width = static_cast<std::uint32_t>(map.width());
  const auto side = width - 2;
  const auto inside = [&](std::uint32_t v) {
    const std::uint32_t x = v % width, y = v / width;
    return x > 0 && y > 0 && x <= side && y <= side;
  };
  TriangleMesh mesh;
  for (std::uint32_t v = 0; v < all.positions.size(); ++v) {
    if (!inside(v)) continue;
    const std::uint32_t x = v % width - 1, y = v / width - 1;
    mesh.positions.push_back({x * map.cellSize, (side - 1 - y) * map.cellSize, all.positions[v].z});
    normals.push_back(shading.normals[normalOf[v]]);
  }
  for (const auto& triangle : all.triangles) {
    if (!std::ranges::all_of(triangle, inside)) continue;
    auto& made = mesh.triangles.emplace_back();
    for (int c = 0; c < 3; ++c)
      made[c] = (triangle[c] / width - 1) * side + triangle[c] % width - 1;
  }
  return mesh;
}

TriangleMesh tileMesh(const World& world, const PlanePoint& tile, std::vector<Vec3f>* normals,
                      const Progress& progress) {
  const Example& example = world.examples().front();
  const PlaneBox one{tile, {tile.x + 1, tile.y + 1}};
  TriangleMesh mesh;
  if (example.form() == Form::Heights) {
    std::vector<Vec3f> own;
    mesh = meshOfHeightTile(world, one, own, progress);
    if (normals) *normals = std::move(own);
  } else if (const auto* pieces = std::get_if<ModelPieces>(&example.content)) {
    mesh = meshOfPieces(world, one, *pieces, progress);
  } else {
    return realizeLabels(world.tile(tile, progress).labels(), example, progress);
  }
  mesh.name = "tile " + tileText(tile);
  return mesh;
}

Warnings writeTile(const World& world, const PlanePoint& tile, const Result& result,
                   const fs::path& path, const Progress& progress) {
  Warnings warnings;
  if (isMeshFile(path)) {
    const MeshFileOptions& options = world.examples().front().reading.mesh;
    std::vector<Vec3f> normals;
    const TriangleMesh mesh = tileMesh(world, tile, &normals, progress);
    const std::string ending = lowerExtension(path);
    if (!normals.empty() && (ending == ".glb" || ending == ".gltf")) {
      writeMeshWithNormals(path, mesh, normals, options);
    } else {
      writeMesh(path, mesh, options);
    }
  } else if (result.form() == Form::Heights) {
    writeHeightMap(path, result.heights(), {.warnings = &warnings}, progress);
  } else {
    LabelGrid grid = result.labels();
    for (int axis = 0; axis < 2; ++axis)
      grid.origin[axis] +=
          static_cast<double>(tile[axis] * world.file().tile) * grid.cellSize[axis];
    writeLabels(path, grid, world.examples().front(), {}, progress);
  }
  return warnings;
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
        Warnings warnings;
        try {
          const Result result = whole ? world.tileOf(*whole, job, tile) : world.tile(tile, hearing);
          for (const fs::path& path : work[n].second) {
            std::error_code error;
            fs::create_directories(path.parent_path(), error);
            const Warnings said = writeTile(world, tile, result, path, hearing);
            warnings.insert(warnings.end(), said.begin(), said.end());
          }
        } catch (const InputError& e) {
          why = e.what();
        }
        const std::lock_guard lock(mutex);
        // One for all tiles says it: of the first that was made.
        if (state.warnings.empty()) state.warnings = warnings;
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
