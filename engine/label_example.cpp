// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as grids of labels.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "mesh/image.h"
#include "mesh/scene.h"

namespace exemplar {
namespace {

constexpr int kDefaultResolution = 32;

/// A mesh with the grid that it is made for, where it has one.
struct GriddedMesh {
  TriangleMesh mesh;
  std::optional<Box3d> box;
  std::optional<Vec3d> cell;
  Vec3d scale{2, 2, 1};
  std::string what;
};

GriddedMesh readGriddedMesh(Example& example, const Progress& progress) {
  GriddedMesh gridded;
  if (example.kind == SourceKind::Mesh || example.kind == SourceKind::Solids) {
    gridded.mesh = readTriangles(example.source, meshReading(example), progress);
    gridded.what = "mesh";
    return gridded;
  }
  Scene scene = readSceneOf(example.source, example.reading, progress);
  gridded.mesh = std::move(scene.mesh);
  gridded.box = scene.box;
  gridded.cell = scene.cell;
  gridded.scale = scene.scale;
  gridded.what = "scene " + scene.name;
  return gridded;
}

/// Samples the example as a field and labels its blocks.
void fromField(Example& example, const Progress& progress) {
  Example sampled = example;
  sampled.reading.form = Form::Field;
  sampled.reading.padding = example.reading.air;
  readAsField(sampled, progress.part(0, 0.6));
  Example blocks = labeled(sampled, example.reading.blocks, progress.part(0.6, 1));
  blocks.reading = example.reading;
  example = std::move(blocks);
}

void fromMesh(Example& example, const Progress& progress) {
  const ReadOptions& options = example.reading;
  GriddedMesh source = readGriddedMesh(example, progress.part(0, 0.2));
  const Box3d box = source.box.value_or(boundingBox(source.mesh));
  Vec3d cell = source.cell.value_or(Vec3d{});
  if (options.cell) {
    cell = *options.cell;
  } else if (!source.cell || options.resolution) {
    if (!options.voxels) {
      fromField(example, progress.part(0.2, 1));
      return;
    }
    const Vec3d size = box.size();
    const double side =
        std::max({size.x, size.y, size.z}) / options.resolution.value_or(kDefaultResolution);
    cell = {side, side, side};
  }
  example.hints.scale = source.scale;
  const int air = options.air.value_or(source.box ? 0 : 1);
  if (options.voxels) {
    example.data =
        meshToLabels(source.mesh, {.cellSize = cell, .box = box, .air = air, .fill = options.fill},
                     progress.part(0.2, 1));
    example.description = "voxels of a " + source.what;
    return;
  }
  ModelPieces pieces = cutIntoPieces(
      source.mesh, {.cellSize = cell, .box = box, .air = air, .tolerance = options.tolerance},
      progress.part(0.2, 1));
  example.data = pieces.grid;
  example.content = std::move(pieces);
  example.mesh = std::move(source.mesh);
  example.description = "cut from a " + source.what;
}

void fromPicture(Example& example, const Progress& progress) {
  ImageLabels image = labelsFromImage(decodeImage(readBytes(example.source), example.name()),
                                      example.name(), example.reading.image, progress);
  example.data = image.grid;
  example.content = std::move(image);
  example.description = "from a picture";
}

void fromTiles(Example& example, const Progress& progress) {
  TiledMap map = readTiles(example.source, progress);
  for (const std::string& what : map.dropped)
    example.warnings.push_back(example.name() + ": its " + what + " are left out");
  example.data = map.grid;
  example.content = std::move(map);
  example.description = "map of tiles";
}

void describe(Example& example) {
  const LabelGrid& grid = example.labels();
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.size()[axis] == 1) example.hints.scale[axis] = 1;
  }
  if (grid.cells.count() == 1 && std::holds_alternative<LabeledField>(example.content)) {
    example.warnings.push_back(example.name() +
                               ": all of it is a single block, which can only be repeated; give a "
                               "smaller `field-block`, or use the engine geometry");
  }
  example.description = readableSize(grid.size(), "cells") + " of " +
                        withThousands(grid.labelCount()) + " labels, " + example.description;
}

/// Whether two labels of two examples look the same.
bool looksAlike(const Example& a, std::size_t label, const Example& b, std::size_t other) {
  const auto* pieces = std::get_if<ImageLabels>(&a.content);
  const auto* others = std::get_if<ImageLabels>(&b.content);
  if (pieces && others) return pieces->pieces[label].pixels == others->pieces[other].pixels;
  const auto* tiles = std::get_if<TiledMap>(&a.content);
  const auto* otherTiles = std::get_if<TiledMap>(&b.content);
  if (tiles && otherTiles) return tiles->stacks[label] == otherTiles->stacks[other];
  return a.labels().labels[label].color == b.labels().labels[other].color;
}

}  // namespace

void readAsLabels(Example& example, const Progress& progress) {
  const std::string ending = lowerExtension(example.source.path());
  if (example.kind == SourceKind::HeightMap && ending == ".png") example.kind = SourceKind::Picture;
  switch (example.kind) {
    case SourceKind::Mesh:
    case SourceKind::Solids:
    case SourceKind::Scene:
    case SourceKind::Pieces:
      fromMesh(example, progress);
      break;
    case SourceKind::Picture:
      fromPicture(example, progress);
      break;
    case SourceKind::HeightMap:
    case SourceKind::Volume:
      fromField(example, progress);
      break;
    case SourceKind::Labels:
      if (isTiledFile(example.source.path()) && !example.source.inMemory<LabelGrid>()) {
        fromTiles(example, progress);
        break;
      }
      example.data = readLabelGrid(example.source, progress);
      example.description = "grid of labels";
      break;
  }
  describe(example);
}

Example readSolid(const Source& source, const ReadOptions& options, const Progress& progress) {
  const SourceKind kind = sourceKind(source);
  const bool heights = kind == SourceKind::HeightMap && lowerExtension(source.path()) != ".png";
  if (!heights && kind != SourceKind::Volume) return readExample(source, options, progress);
  ReadOptions sampling = options;
  sampling.form = Form::Field;
  Example example = readExample(source, sampling, progress);
  const DistanceField& field = example.field();
  LabelGrid grid;
  grid.cells = Array3D<Label>(field.size());
  grid.labels = {emptyLook(), LabelLook{.name = "solid"}};
  grid.cellSize = {field.voxelSize, field.voxelSize, field.voxelSize};
  grid.origin = field.box().min;
  for (std::size_t n = 0; n < grid.cells.count(); ++n)
    grid.cells.values()[n] = field.values.values()[n] < 0;
  example.data = std::move(grid);
  return example;
}

Example labeled(const Example& example, const FieldBlocksOptions& options,
                const Progress& progress) {
  Example result = example;
  result.reading.form = Form::Labels;
  result.reading.blocks = options;
  LabeledField content{example.field(), cutIntoBlocks(example.field(), options, progress)};
  const FieldBlocks& blocks = content.blocks;
  result.description =
      "blocks of " + readableSize(blocks.block, "samples") +
      (options.overlap > 0 ? " that overlap by " + std::to_string(options.overlap) : "") +
      " of a " + example.description + ", " + std::to_string(std::lround(100 * blocks.repetition)) +
      " % of them repeated";
  result.data = blocks.grid;
  result.content = std::move(content);
  return result;
}

void numberAlike(std::vector<Example>& examples) {
  auto& first = examples.front();
  auto& grid = std::get<LabelGrid>(first.data);
  for (std::size_t n = 1; n < examples.size(); ++n) {
    Example& next = examples[n];
    // Pieces and blocks of one example are not those of another.
    const auto isOwn = [](const Example& example) {
      return std::holds_alternative<ModelPieces>(example.content) ||
             std::holds_alternative<LabeledField>(example.content);
    };
    if (isOwn(next) || isOwn(first)) {
      throw InputError(next.name() +
                       ": several examples should be label grids or pictures, not meshes, volumes "
                       "or height maps");
    }
    auto& other = std::get<LabelGrid>(next.data);
    const std::string ending = lowerExtension(next.source.path());
    if (ending == ".txt" || ending == ".vdb") {
      for (std::size_t l = grid.labels.size(); l < other.labels.size(); ++l)
        grid.labels.push_back(other.labels[l]);
      continue;
    }
    // Labels that look the same are the same.
    std::vector<Label> numbers;
    for (std::size_t l = 0; l < other.labels.size(); ++l) {
      std::size_t same = 0;
      while (same < grid.labels.size() && !looksAlike(next, l, first, same)) ++same;
      if (same == grid.labels.size()) {
        if (same == static_cast<std::size_t>(kMostLabels))
          throw InputError(next.name() + ": the examples have more than 65,536 labels");
        grid.labels.push_back(other.labels[l]);
        auto* pieces = std::get_if<ImageLabels>(&first.content);
        const auto* added = std::get_if<ImageLabels>(&next.content);
        if (pieces && added) pieces->pieces.push_back(added->pieces[l]);
        auto* tiles = std::get_if<TiledMap>(&first.content);
        const auto* more = std::get_if<TiledMap>(&next.content);
        if (tiles && more) tiles->addLabel(more->stacks[l]);
      }
      numbers.push_back(static_cast<Label>(same));
    }
    for (Label& label : other.cells.values()) label = numbers[label];
    if (auto* image = std::get_if<ImageLabels>(&next.content)) {
      for (ImageLabels::Turned& turned : image->turned)
        for (Label& label : turned.grid.cells.values()) label = numbers[label];
    }
  }
  for (Example& example : examples) {
    std::get<LabelGrid>(example.data).labels = grid.labels;
    if (auto* image = std::get_if<ImageLabels>(&example.content))
      for (ImageLabels::Turned& turned : image->turned) turned.grid.labels = grid.labels;
  }
  if (examples.size() > 1) {
    first.description += ", " + withThousands(static_cast<long long>(examples.size())) + " files";
  }
}

}  // namespace exemplar
