// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/label_example.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "apps/command.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/scene.h"
#include "reconstruct/reconstruct.h"
#include "sdf/vdb_file.h"
#include "voxelize/label_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar {
namespace {

constexpr int kDefaultResolution = 32;

bool isPicture(const std::string& ending) {
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

/// A mesh with the grid that it is made for, where it has one.
struct MeshExample {
  TriangleMesh mesh;
  std::optional<Box3d> box;
  std::optional<Vec3d> cell;
  Vec3d scale{2, 2, 1};
  std::string what;
};

MeshExample loadMeshExample(const std::filesystem::path& path, const LabelReading& options) {
  MeshExample example;
  if (isMeshFile(path)) {
    example.mesh = readMesh(path, options.mesh);
    example.what = "mesh";
    return example;
  }
  Scene scene = readScene(findScene(path.string()), {.seed = options.sceneSeed});
  example.mesh = std::move(scene.mesh);
  example.box = scene.box;
  example.cell = scene.cell;
  example.scale = scene.scale;
  example.what = "scene " + scene.name;
  return example;
}

/// Whether a `.vdb` holds a distance field; where not, reading it as labels says what is wrong.
bool holdsDistances(const std::filesystem::path& path) {
  try {
    readVdb(path);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Samples the example as a distance field; equal blocks of it are a label.
void fromField(LabelExample& example, const LabelReading& options, const Progress& progress) {
  ExampleOptions sampling;
  sampling.resolution = options.resolution;
  sampling.padding = options.air;
  sampling.sceneSeed = options.sceneSeed;
  sampling.mesh = options.mesh;
  sampling.cellSize = options.pointDistance;
  sampling.heightScale = options.heightScale;
  FieldBlocksOptions blocks = options.blocks;
  if (!options.fieldBlock.empty()) blocks.block = parseCells(options.fieldBlock, "--field-block");
  QuantizedExample& field =
      example.field.emplace(QuantizedExample{loadExample(example.path, sampling, progress), {}});
  if (progress.cancelled()) return;
  field.blocks = cutIntoBlocks(field.example.field, blocks, progress);
  example.grid = field.blocks.grid;
  example.scale = field.example.scale;
  const Vec3i& side = field.blocks.block;
  example.description =
      "blocks of " + std::to_string(side.x) + " x " + std::to_string(side.y) + " x " +
      std::to_string(side.z) + " samples" +
      (blocks.overlap > 0 ? " that overlap by " + std::to_string(blocks.overlap) : "") + " of a " +
      field.example.description + ", " +
      std::to_string(std::lround(100 * field.blocks.repetition)) + " % of them repeated";
}

void fromMesh(LabelExample& example, const LabelReading& options, const Progress& progress) {
  MeshExample source = loadMeshExample(example.path, options);
  const Box3d box = source.box.value_or(boundingBox(source.mesh));
  Vec3d cell = source.cell.value_or(Vec3d{});
  if (!options.cell.empty()) {
    cell = parseTriple(options.cell, "--cell");
  } else if (cell == Vec3d{} || options.resolution) {
    if (!options.voxels) {
      fromField(example, options, progress);
      return;
    }
    const Vec3d size = box.size();
    const double side =
        std::max({size.x, size.y, size.z}) / options.resolution.value_or(kDefaultResolution);
    cell = {side, side, side};
  }
  example.scale = source.scale;
  const int air = options.air.value_or(source.box ? 0 : 1);
  if (options.voxels) {
    example.grid = meshToLabels(
        source.mesh, {.cellSize = cell, .box = box, .air = air, .fill = options.fill}, progress);
    example.description = "voxels of a " + source.what;
    return;
  }
  example.pieces = cutIntoPieces(
      source.mesh, {.cellSize = cell, .box = box, .air = air, .tolerance = options.tolerance},
      progress);
  example.grid = example.pieces->grid;
  example.description = "cut from a " + source.what;
}

}  // namespace

void addLabelReadingOptions(CLI::App& command, LabelReading& options) {
  command.add_option("--cell", options.cell,
                     "side of a cell of a mesh, in its own units: S or X,Y,Z");
  command
      .add_option("--resolution", options.resolution,
                  "cells along a mesh's longest side, in place of --cell")
      ->check(CLI::Range(1, 4096));
  command
      .add_option("--air", options.air,
                  "empty cells at a mesh's sides and above it (1; 0 for a scene)")
      ->check(CLI::Range(0, 1024));
  command
      .add_option("--tolerance", options.tolerance,
                  "how far equal pieces of a mesh may differ, in cells")
      ->check(CLI::Range(1e-7, 0.1))
      ->capture_default_str();
  command
      .add_option("--piece", options.image.piece, "pixels a side of what is one label in a picture")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_flag("--overlap", options.image.overlap,
                   "let a picture's pieces begin at every pixel");
  command.add_option("--scene-seed", options.sceneSeed,
                     "another sample of a scene's own random process");
  command.add_option("--field-block", options.fieldBlock,
                     "samples a side of what is one label in a distance field (of a mesh without "
                     "--cell, a height map, a volume): N or X,Y,Z (found)");
  command
      .add_option("--field-tolerance", options.blocks.tolerance,
                  "how far blocks of one label may differ, voxels")
      ->check(CLI::Range(0.0, 16.0))
      ->capture_default_str();
  command
      .add_option("--field-overlap", options.blocks.overlap,
                  "samples that neighboring blocks of a field share; those may stand side by side "
                  "that agree in them (0: blocks tile, and stand as in the example)")
      ->check(CLI::Range(0, 63))
      ->capture_default_str();
  addHeightMapOptions(command, options.pointDistance, options.heightScale);
  addUpOption(command, options.mesh);
}

LabelExample loadLabelExample(const std::filesystem::path& path, const LabelReading& options,
                              const Progress& progress) {
  progress.report("reading " + path.string(), 0);
  const std::string ending = lowerExtension(path);
  LabelExample example;
  example.path = path;
  if (isMeshFile(path) || ending == ".toml") {
    fromMesh(example, options, progress);
  } else if (isPicture(ending)) {
    const std::string name = path.string();
    example.image = labelsFromImage(decodeImage(readFile(path), name), name, options.image);
    example.grid = example.image->grid;
    example.description = "from a picture";
  } else if (ending == ".pgm" || ending == ".asc" || (ending == ".vdb" && holdsDistances(path))) {
    fromField(example, options, progress);
  } else {
    example.grid = readLabels(path);
    example.description = "grid of labels";
  }
  if (example.grid.cells.empty()) return example;  // cancelled
  for (int axis = 0; axis < 3; ++axis) {
    if (example.grid.size()[axis] == 1) example.scale[axis] = 1;
  }
  example.description = readableCells(example.grid.size()) + " of " +
                        withThousands(example.grid.labelCount()) + " labels, " +
                        example.description;
  return example;
}

LabelExample loadLabelFrames(const std::vector<std::string>& paths, const LabelReading& options,
                             std::vector<LabelGrid>& grids, const Progress& progress) {
  LabelExample first = loadLabelExample(paths.front(), options, progress);
  grids.assign(1, first.grid);
  for (std::size_t n = 1; n < paths.size(); ++n) {
    LabelExample next = loadLabelExample(paths[n], options, progress);
    if (next.pieces || first.pieces) {
      throw InputError(paths[n] + ": frames should be label grids or pictures, not meshes");
    }
    const std::string ending = lowerExtension(paths[n]);
    if (ending == ".txt" || ending == ".vdb") {
      for (std::size_t l = first.grid.labels.size(); l < next.grid.labels.size(); ++l) {
        first.grid.labels.push_back(next.grid.labels[l]);
      }
    } else {
      // Labels that look the same are the same.
      std::vector<Label> numbers;
      for (std::size_t l = 0; l < next.grid.labels.size(); ++l) {
        std::size_t same = 0;
        const auto alike = [&](std::size_t k) {
          return next.image && first.image
                     ? next.image->pieces[l].pixels == first.image->pieces[k].pixels
                     : next.grid.labels[l].color == first.grid.labels[k].color;
        };
        while (same < first.grid.labels.size() && !alike(same)) ++same;
        if (same == first.grid.labels.size()) {
          if (same == static_cast<std::size_t>(kMostLabels)) {
            throw InputError(paths[n] + ": the frames have more than 65,536 labels");
          }
          first.grid.labels.push_back(next.grid.labels[l]);
          if (next.image && first.image) first.image->pieces.push_back(next.image->pieces[l]);
        }
        numbers.push_back(static_cast<Label>(same));
      }
      for (Label& label : next.grid.cells.values()) label = numbers[label];
    }
    grids.push_back(std::move(next.grid));
  }
  for (LabelGrid& grid : grids) grid.labels = first.grid.labels;
  if (paths.size() > 1) {
    first.description += ", " + withThousands(static_cast<long long>(paths.size())) + " files";
  }
  return first;
}

bool isLabelExample(const std::filesystem::path& path) {
  if (isLabelFile(path)) return true;
  return lowerExtension(path) == ".toml" && isPieceScene(path);
}

Adjacency findAdjacency(const LabelExample& example, const std::vector<LabelGrid>& grids,
                        const AdjacencyOptions& options) {
  if (!example.field || example.field->blocks.stride == example.field->blocks.block)
    return findAdjacency(grids, options);
  const std::array<bool, 3>& p = options.periodic;
  if (!options.offsets.empty() || options.frames || p[0] || p[1] || p[2]) {
    throw InputError(
        "--field-overlap: what stands beside what is told by the samples blocks share; leave out "
        "options about the example's pairs, or the overlap");
  }
  return example.field->blocks.adjacency;
}

Vec3i cellsOfSize(const LabelExample& example) {
  Vec3i cells = example.grid.size();
  if (!example.field) return cells;
  const FieldBlocks& blocks = example.field->blocks;
  for (int axis = 0; axis < 3; ++axis)
    cells[axis] = (cells[axis] - 1) * blocks.step[axis] / blocks.stride[axis] + 1;
  return cells;
}

TriangleMesh labelsToMesh(const LabelGrid& grid, const LabelExample& example) {
  if (example.pieces) return assemblePieces(grid, *example.pieces);
  if (example.field) {
    const Example& source = example.field->example;
    const PlacedBlocks placed = placeBlocks(source.field, example.field->blocks, grid.cells);
    ReconstructOptions asItIs;
    asItIs.blend = 0;
    return reconstructSurface(placed.field, placed.origins,
                              {source.field, source.mesh ? &*source.mesh : nullptr}, asItIs)
        .mesh;
  }
  TriangleMesh mesh = labelMesh(grid);
  if (mesh.triangles.empty()) throw InputError("the result has no geometry: its cells are empty");
  return mesh;
}

std::string writeLabelResult(const std::filesystem::path& path, const LabelGrid& grid,
                             const LabelExample& example, bool instances,
                             const MeshFileOptions& options) {
  if (!isMeshFile(path)) {
    if (lowerExtension(path) == ".vdb" && example.field) {
      const PlacedBlocks placed =
          placeBlocks(example.field->example.field, example.field->blocks, grid.cells);
      writeVdb(path, placed.field);
      return path.string() + ": distances, " + readableCells(placed.field.size());
    }
    if (lowerExtension(path) == ".png" && example.image) {
      writePng(path, imageFromLabels(grid, *example.image));
    } else {
      writeLabels(path, grid);
    }
    return path.string() + ": " + readableCells(grid.size());
  }
  if (instances) {
    if (!example.pieces || lowerExtension(path) != ".glb") {
      throw InputError("--instances: only a .glb of model pieces (of a mesh) has instances");
    }
    const std::size_t placed = writePieceInstances(path, grid, *example.pieces);
    return path.string() + ": " + withThousands(static_cast<long long>(placed)) + " instances";
  }
  const TriangleMesh mesh = labelsToMesh(grid, example);
  writeMesh(path, mesh, options);
  return path.string() + ": " + readableHealth(meshHealth(mesh));
}

Vec3i parseCells(const std::string& text, const std::string& option) {
  const Vec3d triple = parseTriple(text, option);
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis) {
    if (triple[axis] != std::floor(triple[axis]) || triple[axis] > 32767) {
      throw InputError(option + " " + text + ": expected whole numbers of cells, 1 to 32767");
    }
    size[axis] = static_cast<int>(triple[axis]);
  }
  return size;
}

std::vector<Label> parseLabels(const std::string& text, const LabelGrid& grid,
                               const std::string& option) {
  std::set<Label> labels;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');) {
    int number = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    const bool isNumber = error == std::errc{} && end == word.data() + word.size();
    bool found = false;
    for (int label = 0; label < grid.labelCount(); ++label) {
      if (isNumber ? label == number : grid.labels[label].name == word) {
        labels.insert(static_cast<Label>(label));
        found = true;
      }
    }
    if (!found) {
      throw InputError(option + ": there is no label '" + word + "'; labels are 0 to " +
                       std::to_string(grid.labelCount() - 1) + ", or their names");
    }
  }
  if (labels.empty()) throw InputError(option + ": no label is given");
  return {labels.begin(), labels.end()};
}

std::string readableCells(const Vec3i& size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z) +
         " cells";
}

}  // namespace exemplar
