// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/output.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "engine/placed_cells.h"
#include "engine/words.h"
#include "mesh/face_outlines.h"
#include "mesh/gif.h"
#include "mesh/image.h"
#include "mesh/svg_file.h"
#include "sdf/height_map.h"
#include "sdf/vdb_file.h"
#include "synth/continuous/flat.h"
#include "voxelize/label_file.h"
#include "voxelize/piece_library.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

bool endsWith(const fs::path& path, const char* ending) { return lowerExtension(path) == ending; }

fs::path wholePath(const fs::path& path) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(path, error), error);
}

/// The path of one frame of a sequence: `roll.txt` becomes `roll_007.txt`.
fs::path framePath(const fs::path& path, std::size_t frame) {
  char number[16];
  std::snprintf(number, sizeof number, "_%03zu", frame);
  return path.parent_path() / (path.stem().string() + number + path.extension().string());
}

/// A flat grid as its picture, with cells of several pixels; any other one rendered.
Image8 frameImage(const LabelGrid& grid, const Example& example, const RenderOptions& picture,
                  const Progress& progress) {
  if (grid.size().z != 1) return render(realizeLabels(grid, example), picture, progress);
  const auto* image = std::get_if<ImageLabels>(&example.content);
  const Image8 small = image ? imageFromLabels(grid, *image) : imageFromLabels(grid);
  const int zoom = std::max(1, 256 / std::max(small.width, small.height));
  Image8 large{small.width * zoom, small.height * zoom, small.channels, {}};
  large.pixels.reserve(static_cast<std::size_t>(large.width) * large.height * large.channels);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) {
      const std::uint8_t* pixel = small.at(x / zoom, y / zoom);
      large.pixels.insert(large.pixels.end(), pixel, pixel + small.channels);
    }
  }
  return large;
}

/// A result that changes over time: an animation, or a file for each frame.
Written writeFrames(const fs::path& path, const Result& result, const Example& example,
                    const OutputOptions& options, const Progress& progress) {
  std::vector<const LabelGrid*> frames{&result.labels()};
  for (const LabelGrid& frame : result.laterFrames) frames.push_back(&frame);
  const auto share = [&](std::size_t n) {
    return progress.part(static_cast<double>(n) / static_cast<double>(frames.size()),
                         static_cast<double>(n + 1) / static_cast<double>(frames.size()));
  };
  if (endsWith(path, ".gif")) {
    std::vector<Image8> images;
    for (const LabelGrid* grid : frames)
      images.push_back(frameImage(*grid, example, options.picture, share(images.size())));
    writeGif(path, images);
    return {path, "written", path.string() + ": " + std::to_string(frames.size()) + " frames", {}};
  }
  for (std::size_t n = 0; n < frames.size(); ++n) {
    writeLabels(framePath(path, n), *frames[n], example, options, share(n));
    if (options.wrote) options.wrote(framePath(path, n));
  }
  return {path,
          "written",
          framePath(path, 0).string() + " to " + framePath(path, frames.size() - 1).string(),
          {}};
}

/// The picture, and those of its further channels beside it: `rust.png`, `rust_normal.png`.
Written writeMap(const fs::path& path, const Map& map, const OutputOptions& options) {
  Written written{path,
                  "picture",
                  path.string() + ": " + std::to_string(map.width()) + " x " +
                      std::to_string(map.height()) + " pixels",
                  {}};
  for (const MapLayer& layer : map.layers) {
    if (&layer == &map.layers.front()) {
      writeMapLayer(path, layer);
      continue;
    }
    const fs::path beside = channelPath(path, layer.name);
    writeMapLayer(beside, layer);
    if (options.wrote) options.wrote(beside);
    written.text += ", " + beside.filename().string();
  }
  return written;
}

Written writeField(const fs::path& path, const Result& result, const Example& example,
                   const OutputOptions& options, const Progress& progress) {
  Written written{path, "field", path.string(), {}};
  if (isHeightMapFile(path)) {
    written.label = "heights";
    HeightMap map = sdfToHeightMap(result.field(), progress.part(0, 0.5));
    map.steps = example.heightSteps;
    if (!turnOf(result, example).none())
      written.warnings.push_back(
          path.string() +
          ": heights lie along x and y; the result is not turned back as the example lies");
    writeHeightMap(path, map,
                   {.heightScale = example.reading.heightScale, .warnings = &written.warnings},
                   progress.part(0.5, 1));
  } else {
    writeVdb(path, result.field(),
             {.wraps = result.periodic,
              .turn = turnOf(result, example),
              .yUp = options.mesh.up == UpAxis::Y},
             progress);
  }
  return written;
}

/// The shapes of a flat result.
Written writeDrawing(const fs::path& path, const continuous::PolygonModel& model) {
  const Drawing drawing = continuous::drawingOf(model);
  writeFile(path, drawingText(drawing));
  return {path, "drawing", path.string() + ": " + counted(drawing.shapes.size(), "shape"), {}};
}

/// Heights in the units and steps of their example.
Written writeHeights(const fs::path& path, const Result& result, const Example& example,
                     const Progress& progress) {
  Written written{path, "heights", path.string(), {}};
  writeHeightMap(path, result.heights(),
                 {.heightScale = example.reading.heightScale, .warnings = &written.warnings},
                 progress);
  return written;
}

/// Triangles as a file of meshes.
/// More than engines and editors take gladly.
constexpr std::size_t kManyTriangles = 500'000;

Written writeTriangles(const fs::path& path, const TriangleMesh& mesh,
                       std::span<const std::uint32_t> faces, const MeshHealth& health,
                       const char* label, const MeshFileOptions& options,
                       const Progress& progress) {
  Written written{path, label, path.string() + ": " + readableHealth(health), {}};
  MeshFileOptions file = options;
  file.warnings = &written.warnings;
  writePolygons(path, mesh, faces, file, progress);
  std::error_code error;
  const auto bytes = fs::file_size(path, error);
  if (!error) written.text += ", " + readableBytes(static_cast<double>(bytes));
  if (mesh.triangles.size() > kManyTriangles) written.text += "; `triangles` makes it lighter";
  return written;
}

}  // namespace

const char* outputEndings(Form form) {
  switch (form) {
    case Form::Field:
      return ".obj .ply .stl .off .glb .gltf .vdb .asc .tif .exr .png .pgm .r16 .raw";
    case Form::Labels:
      return ".txt .vox .vdb .png .tmx .csv .json .obj .ply .stl .off .glb .gltf .gif";
    case Form::Map:
      return ".png";
    case Form::Polygons:
      return ".obj .ply .stl .off .glb .gltf .svg";
    case Form::Heights:
      return ".asc .tif .tiff .exr .png .pgm .r16 .raw .obj .ply .stl .off .glb .gltf";
    default:
      return kMeshEndings;
  }
}

void requireOutput(const fs::path& path, const std::string& endings) {
  const std::string ending = lowerExtension(path);
  if (ending.empty() || (" " + endings + " ").find(" " + ending + " ") == std::string::npos)
    throw InputError(path.string() + ": cannot write this kind of file; use one of " + endings);
  const OutputFile probe(path);
}

fs::path channelPath(const fs::path& path, const std::string& channel) {
  return path.parent_path() / (path.stem().string() + "_" + channel + path.extension().string());
}

fs::path lodPath(const fs::path& path, int n) {
  return path.parent_path() /
         (path.stem().string() + "_lod" + std::to_string(n) + path.extension().string());
}

std::vector<fs::path> filesOf(std::span<const std::string> outputs, int lods) {
  std::vector<fs::path> files;
  const auto add = [&](const fs::path& path) {
    files.push_back(path);
    if (endsWith(path, ".obj")) files.push_back(fs::path(path).replace_extension(".mtl"));
    // What a file of integers cannot say about heights.
    if (holdsIntegers(path)) files.push_back(heightSidecarPath(path));
  };
  for (const std::string& output : outputs) {
    add(output);
    for (int n = 1; n <= lods && isMeshFile(output); ++n) add(lodPath(output, n));
  }
  return files;
}

void requireDistinct(std::span<const fs::path> files, std::span<const fs::path> inputs) {
  std::set<fs::path> taken;
  for (const fs::path& path : inputs) taken.insert(wholePath(path));
  for (const fs::path& path : files) {
    if (!taken.insert(wholePath(path)).second)
      throw InputError(path.string() + ": is read or written already; choose another name");
  }
}

void requireKept(std::span<const std::string> outputs, int lods,
                 std::span<const Example> examples) {
  const std::vector<fs::path> files = filesOf(outputs, lods);
  for (const Example& example : examples) {
    for (const fs::path& named : example.beside) {
      const fs::path kept = wholePath(named);
      for (const fs::path& file : files) {
        const fs::path written = wholePath(file);
        const bool mayBePicture =
            endsWith(file, ".obj") && kept.parent_path() == written.parent_path() &&
            kept.filename().string().starts_with(written.stem().string() + "_");
        if (kept == written || mayBePicture)
          throw InputError(file.string() + ": would overwrite " + named.string() + ", which " +
                           example.name() + " names; choose another name");
      }
    }
  }
}

void requireOutputKind(const fs::path& path, bool hasFrames, bool instances) {
  if (instances && !endsWith(path, ".glb"))
    throw InputError("`instances`: only a .glb has instances, not " + path.string());
  if (endsWith(path, ".gif") && !hasFrames) {
    throw InputError(path.string() +
                     ": only what changes over time becomes one; say how many `frames`");
  }
}

void requireOutputFits(const fs::path& path, const Example& example, const Vec3i& size) {
  const Form form = example.form();
  const bool pieces = std::holds_alternative<ModelPieces>(example.content);
  const bool tiles = isTiledFile(path) && !(pieces && endsWith(path, ".csv"));
  if (form == Form::Labels && (endsWith(path, ".png") || tiles) && size.z != 1) {
    throw InputError(path.string() + (tiles ? ": a map of tiles" : ": a picture") +
                     " has one layer, and the result " + std::to_string(size.z) +
                     "; write a .txt, .vox, .vdb or a mesh");
  }
  if (form == Form::Polygons && isDrawingFile(path) && size.z != 1) {
    throw InputError(path.string() + ": a drawing is flat, and the result " +
                     std::to_string(size.z) + " spacings high; write a mesh");
  }
}

bool needsSurface(const fs::path& path, const Result& result, const OutputOptions& options) {
  return isMeshFile(path) && !options.instances && result.laterFrames.empty();
}

Written writeResult(const fs::path& path, const Result& result, std::span<const Example> examples,
                    const Surface* surface, const OutputOptions& options,
                    const Progress& progress) {
  const Example& example = examples.front();
  progress.report("writing " + path.string(), 0);
  if (surface && needsSurface(path, result, options)) {
    return writeTriangles(path, surface->mesh, surface->faces, surface->health,
                          result.form() == Form::Labels ? "written" : "mesh", options.mesh,
                          progress);
  }
  if (result.form() == Form::Map) return writeMap(path, result.map(), options);
  if (result.form() == Form::Heights) return writeHeights(path, result, example, progress);
  if (result.form() == Form::Field) return writeField(path, result, example, options, progress);
  if (result.form() == Form::Polygons) return writeDrawing(path, result.polygons());
  if (!result.laterFrames.empty()) return writeFrames(path, result, example, options, progress);
  OutputOptions written = options;
  written.periodic = result.periodic;
  return writeLabels(path, result.labels(), example, written, progress);
}

std::vector<Written> writeLods(const fs::path& path, const Surface& surface,
                               const OutputOptions& options, const Progress& progress) {
  std::vector<Written> written;
  if (!isMeshFile(path)) return written;
  const auto count = static_cast<double>(surface.lods.size());
  for (const CoarserSurface& lod : surface.lods) {
    const auto n = static_cast<double>(written.size());
    written.push_back(writeTriangles(lodPath(path, static_cast<int>(n) + 1), lod.mesh, {},
                                     lod.health, "coarser", options.mesh,
                                     progress.part(n / count, (n + 1) / count)));
  }
  return written;
}

Written writePieceLibrary(const fs::path& path, const Example& example, const Progress& progress) {
  const auto* pieces = std::get_if<ModelPieces>(&example.content);
  if (!pieces) {
    throw InputError("pieces: " + example.name() +
                     " is not cut into model pieces; use a scene of pieces, or a mesh with `cell`");
  }
  const std::size_t count = exemplar::writePieceLibrary(path, *pieces, progress);
  return {path, "pieces", path.string() + ": " + std::to_string(count) + " meshes", {}};
}

Written writeLabels(const fs::path& path, const LabelGrid& grid, const Example& example,
                    const OutputOptions& options, const Progress& progress) {
  const auto* pieces = std::get_if<ModelPieces>(&example.content);
  if (options.instances) {
    if (!pieces || !endsWith(path, ".glb"))
      throw InputError("`instances`: only a .glb of model pieces (of a mesh) has instances");
    const std::size_t placed = writePieceInstances(path, grid, *pieces, progress);
    return {path,
            "written",
            path.string() + ": " + withThousands(static_cast<long long>(placed)) + " instances",
            {}};
  }
  if (isMeshFile(path)) {
    const TriangleMesh mesh = realizeLabels(grid, example, progress.part(0, 0.6));
    const MeshHealth health = meshHealth(mesh, progress.part(0.6, 0.8));
    return writeTriangles(path, mesh, {}, health, "written", options.mesh, progress.part(0.8, 1));
  }
  if (const auto* labeled = std::get_if<LabeledField>(&example.content);
      labeled && endsWith(path, ".vdb")) {
    const PlacedBlocks placed =
        placeBlocks(labeled->field, labeled->blocks, grid.cells, progress.part(0, 0.5));
    writeVdb(path, placed.field, {.turn = example.turn, .yUp = options.mesh.up == UpAxis::Y},
             progress.part(0.5, 1));
    return {path,
            "written",
            path.string() + ": distances, " + readableSize(placed.field.size(), "samples"),
            {}};
  }
  if (endsWith(path, ".json") || (pieces && endsWith(path, ".csv"))) {
    const bool json = endsWith(path, ".json");
    writeFile(path, json ? placedCellsJson(grid, pieces) : placedCellsCsv(grid, *pieces), progress);
  } else if (const auto* image = std::get_if<ImageLabels>(&example.content);
             image && endsWith(path, ".png")) {
    writePng(path, imageFromLabels(grid, *image, progress, options.periodic));
  } else if (const auto* tiles = std::get_if<TiledMap>(&example.content);
             tiles && isTiledFile(path)) {
    writeTiledMap(path, grid, *tiles, progress);
  } else {
    writeLabels(path, grid, progress);
  }
  return {path, "written", path.string() + ": " + readableSize(grid.size(), "cells"), {}};
}

}  // namespace exemplar
