// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/example.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "mesh/image.h"
#include "mesh/svg_file.h"

namespace exemplar {
namespace {

constexpr Range kAir{0, 1024};

SettingTable<ReadOptions>::Row meshUpRow() {
  return choiceRow<ReadOptions, UpAxis>(
      "up", [](ReadOptions& o) -> UpAxis& { return o.mesh.up; },
      "which axis is up in files of meshes and volumes: y for .obj and .glb, else z, where it is "
      "auto",
      {{"auto", UpAxis::Default}, {"y", UpAxis::Y}, {"z", UpAxis::Z}});
}

/// Samples along the longest side, or "auto".
SettingTable<ReadOptions>::Row resolutionRow() {
  Setting setting{.key = "resolution",
                  .type = SettingType::IntegerOrAuto,
                  .meaning =
                      "samples along the example's longest side; finer detail is lost; auto: "
                      "as many as a mesh's detail needs",
                  .unit = "samples",
                  .least = 4,
                  .most = 4096,
                  .byDefault = "64; a volume keeps its own"};
  return {std::move(setting), [](const Setting& s, const std::string& text, ReadOptions& o) {
            o.holdDetail = text == "auto";
            o.resolution.reset();
            if (!o.holdDetail) o.resolution = static_cast<int>(readInteger(s, text));
          }};
}

/// Voxels of air: one number, or three.
SettingTable<ReadOptions>::Row paddingRow() {
  Setting setting{.key = "padding",
                  .type = SettingType::Size,
                  .meaning =
                      "air around a mesh, on both sides of each axis: one number for all, or "
                      "three",
                  .unit = "voxels",
                  .least = kAir.least,
                  .most = kAir.most,
                  .byDefault = "4; 0 at the ends of a mesh that goes on, and of windows"};
  return {std::move(setting), [](const Setting& s, const std::string& text, ReadOptions& o) {
            o.padding = Padding(readSize(s, text));
          }};
}

/// Warns of what was asked for and has no meaning for this kind of example.
void warnOfUnused(Example& example) {
  const ReadOptions& o = example.reading;
  const SourceKind kind = example.kind;
  const bool labels = o.form == Form::Labels, polygons = o.form == Form::Polygons;
  const bool mesh = kind == SourceKind::Mesh || kind == SourceKind::Solids;
  const bool heights = kind == SourceKind::HeightMap;
  const bool scene = kind == SourceKind::Scene || kind == SourceKind::Pieces;
  const bool picture = kind == SourceKind::Picture;
  const bool sampled = kind != SourceKind::Volume && kind != SourceKind::Labels && !picture;
  const ReadOptions usual;
  std::vector<std::string> unused;
  const auto use = [&](const char* key, bool given, bool used) {
    if (given && !used) unused.push_back("`" + std::string(key) + "`");
  };
  use("resolution", o.resolution.has_value(), sampled);
  if (o.holdDetail && !mesh && sampled) {
    example.warnings.push_back(example.name() +
                               ": `resolution` auto is for meshes; this example is read as usual");
  }
  use("padding", o.padding.has_value(), !labels && (mesh || scene));
  use("scatter", o.scatter, !labels && (mesh || kind == SourceKind::Volume));
  use("align", o.align != usual.align, !labels && mesh);
  use("scene-seed", o.sceneSeed.has_value(), scene);
  use("scene-extent", o.sceneExtent.has_value(), scene);
  use("cell-size", o.cellSize.has_value(), heights);
  use("height-scale", o.heightScale.has_value(), heights);
  use("grid", !o.grid.empty(), kind == SourceKind::Volume);
  use("cell", o.cell.has_value(), labels && (mesh || scene));
  use("air", o.air.has_value(), labels && (mesh || scene));
  use("piece", o.image.piece != usual.image.piece, picture);
  use("overlap", o.image.overlap, picture);
  use("symmetry", o.image.symmetry != usual.image.symmetry, picture);
  use("unit", o.unit.has_value(),
      polygons && (kind == SourceKind::Mesh || isDrawingFile(example.source.path())));
  use("snap", o.snap.has_value(), polygons && kind == SourceKind::Mesh);
  use("ground", o.ground.has_value(), polygons && kind == SourceKind::Mesh);
  use("seen-only", o.image.seen, picture && o.image.overlap);
  use("example-periodic", o.image.periodic.any(),
      labels && !std::holds_alternative<LabeledField>(example.content));
  const bool blocks = std::holds_alternative<LabeledField>(example.content);
  use("field-block", o.blocks.block != usual.blocks.block, blocks);
  use("field-tolerance", o.blocks.tolerance != usual.blocks.tolerance, blocks);
  use("field-overlap", o.blocks.overlap != usual.blocks.overlap, blocks);
  if (!unused.empty()) {
    example.warnings.push_back(example.name() + ": " + joined(unused, "and") +
                               (unused.size() == 1 ? " has" : " have") +
                               " no meaning for this kind of example");
  }
}

SettingTable<ReadOptions>::Row normalsRow() {
  return choiceRow<ReadOptions, MeshNormals>(
      "normals", [](ReadOptions& o) -> MeshNormals& { return o.mesh.normals; },
      "normals in .glb, .gltf, .obj and .ply: with hard edges where faces meet at more than 40 "
      "degrees, smooth everywhere, or none",
      {{"crease", MeshNormals::Crease},
       {"smooth", MeshNormals::Smooth},
       {"none", MeshNormals::None}});
}

}  // namespace

const SettingTable<ReadOptions>& readingSettings(Form form) {
  using O = ReadOptions;
  const auto sceneSeed = [] {
    return settingRow<O>("scene-seed", &O::sceneSeed,
                         "another sample of a scene's own random process", kFromZero, "",
                         "the scene's");
  };
  const auto sceneExtent = [] {
    return settingRow<O>("scene-extent", &O::sceneExtent,
                         "a larger sample of a scene's own random process, in its boxes", {1, 16},
                         "", "1,1,1");
  };
  const auto cellSize = [] {
    return settingRow<O>("cell-size", &O::cellSize,
                         "distance of a height map's points, where the file does not say",
                         kAboveZero, "world units", "so that its relief is a fifth of its side");
  };
  const auto heightScale = [] {
    return settingRow<O>("height-scale", &O::heightScale,
                         "height of one step of a height map's integers", kAboveZero, "world units",
                         "1");
  };
  const auto grid = [] {
    return settingRow<O>("grid", &O::grid, "which grid of a .vdb file is read, by its name", {}, "",
                         "a level set, else \"density\", else the first");
  };
  static const SettingTable<O> polygons{
      settingRow<O>("unit", &O::unit,
                    "side of the grid to which a mesh's vertices are snapped, so that its planes "
                    "are exact",
                    kAboveZero, "world units", "found from the distances between parallel faces"),
      settingRow<O>("snap", &O::snap,
                    "how far the surface of a mesh may move when it is snapped; where that is not "
                    "closed or fits no grid, it is read as the union of its parts, without faces "
                    "narrower than this",
                    {1e-6, 0.2}, "lengths of the longest side",
                    "0.001; for unions as much as needed, up to 0.07"),
      settingRow<O>("ground", &O::ground,
                    "height below which a mesh has ground that goes on for ever", {}, "world units",
                    "none"),
      meshUpRow(), normalsRow()};
  static const SettingTable<O> field{
      resolutionRow(),
      paddingRow(),
      settingRow<O>("scatter", &O::scatter,
                    "copies of an object are strewn and grow together, in place of the object "
                    "extended or varied as one; a mesh has air on all sides, also where it looks "
                    "like a piece of something longer, as a wall does"),
      choiceRow<O, Align>(
          "align", [](O& o) -> Align& { return o.align; },
          "what is done about a mesh that lies turned about the vertical against its box: turn it "
          "straight, and the result back, or nothing",
          {{"auto", Align::Auto}, {"none", Align::None}}),
      sceneSeed(),
      sceneExtent(),
      cellSize(),
      heightScale(),
      grid(),
      meshUpRow(),
      normalsRow()};
  static const SettingTable<O> labels{
      settingRow<O>("cell", &O::cell, "side of a cell of a mesh, which cuts it into model pieces",
                    kAboveZero, "world units", "a scene's own"),
      settingRow<O>("resolution", &O::resolution,
                    "cells, or samples of a field, along the longest side, in place of `cell`",
                    {1, 4096}, "", "by the kind of example"),
      settingRow<O>("air", &O::air, "empty cells at a mesh's sides and above it", kAir, "cells",
                    "1; 0 for a scene"),
      settingRow<O>("tolerance", &O::tolerance, "how far equal pieces of a mesh may differ",
                    {1e-7, 0.1}, "cells"),
      settingRow<O>(
          "piece", [](O& o) -> int& { return o.image.piece; },
          "side of what is one label in a picture", {1, 256}, "pixels"),
      settingRow<O>(
          "overlap", [](O& o) -> bool& { return o.image.overlap; },
          "let a picture's pieces begin at every pixel; those are neighbors that agree in the "
          "pixels they share"),
      settingRow<O>(
          "seen-only", [](O& o) -> bool& { return o.image.seen; },
          "pieces that overlap are neighbors only where the picture shows them so"),
      settingRow<O>(
          "symmetry", [](O& o) -> int& { return o.image.symmetry; },
          "in how many ways a picture is an example, 1, 2, 4 or 8: as it is (1), mirrored left and "
          "right, too (2), turned a quarter (4), in all ways (8)",
          {1, 8}),
      settingRow<O>(
          "example-periodic", [](O& o) -> Axes& { return o.image.periodic; },
          "axes along which the example goes on from its end with its beginning"),
      settingRow<O>(
          "field-block", [](O& o) -> Vec3i& { return o.blocks.block; },
          "side of what is one label in a distance field (of a mesh without `cell`, a "
          "height map, a volume)",
          {2, 64}, "samples", "found"),
      settingRow<O>(
          "field-tolerance", [](O& o) -> double& { return o.blocks.tolerance; },
          "how far blocks of one label may differ", {0, 16}, "voxels"),
      settingRow<O>(
          "field-truncation", [](O& o) -> double& { return o.blocks.truncation; },
          "distances count up to here when blocks are compared", kAboveZero, "voxels"),
      settingRow<O>(
          "field-overlap", [](O& o) -> int& { return o.blocks.overlap; },
          "samples that neighboring blocks of a field share; those are neighbors that "
          "agree in them (0: blocks tile, and are neighbors as in the example)",
          {0, 63}, "samples"),
      sceneSeed(),
      sceneExtent(),
      cellSize(),
      heightScale(),
      grid(),
      meshUpRow(),
      normalsRow()};
  static const SettingTable<O> heights{cellSize(), heightScale()};
  static const SettingTable<O> maps{
      {{.key = "channel",
        .type = SettingType::Text,
        .meaning = "NAME=FILE: another picture of the same surface (its normals, its heights), "
                   "which is synthesized along",
        .repeats = true},
       [](const Setting&, const std::string& text, O& o) {
         o.channels.push_back(keyAndValue(text, "`channel`", "NAME=FILE"));
       }}};
  switch (form) {
    case Form::Field:
      return field;
    case Form::Labels:
      return labels;
    case Form::Polygons:
      return polygons;
    case Form::Heights:
      return heights;
    default:
      return maps;
  }
}

void checkReading(const ReadOptions& options) {
  if (options.scatter && options.padding)
    throw InputError("`scatter` and `padding` both say where there is air; give one of the two");
  if (options.form == Form::Labels && options.cell && options.resolution)
    throw InputError("`cell` and `resolution` both say how large cells are; give one of the two");
}

Example readExample(const Source& source, const ReadOptions& options, const Progress& progress) {
  progress.report("reading " + source.name(), 0);
  Example example;
  example.source = source;
  example.reading = options;
  example.kind = sourceKind(source);
  if (!options.form) {
    const bool labels = example.kind == SourceKind::Labels || example.kind == SourceKind::Pieces ||
                        example.kind == SourceKind::Picture;
    const bool solids = example.kind == SourceKind::Solids;
    example.reading.form = labels ? Form::Labels : solids ? Form::Polygons : Form::Field;
  }
  checkReading(example.reading);
  if (example.reading.form == Form::Field) {
    readAsField(example, progress);
  } else if (example.reading.form == Form::Map) {
    readAsMap(example, progress);
  } else if (example.reading.form == Form::Heights) {
    readAsHeights(example, progress);
  } else if (example.reading.form == Form::Polygons) {
    readAsPolygons(example, progress);
  } else {
    readAsLabels(example, progress);
  }
  warnOfUnused(example);
  progress.report("reading " + source.name(), 1);
  return example;
}

MeshFileOptions meshReading(Example& example) {
  MeshFileOptions file = example.reading.mesh;
  file.warnings = &example.warnings;
  file.beside = &example.beside;
  return file;
}

Scene readSceneOf(const Source& source, const ReadOptions& options, const Progress& progress) {
  const SceneOptions scene{.seed = options.sceneSeed,
                           .extent = options.sceneExtent.value_or(Vec3d{1, 1, 1})};
  if (const std::string* bytes = source.inMemory<std::string>())
    return readScene(*bytes, source.name(), scene, progress);
  return readScene(findScene(source.name()), scene, progress);
}

std::vector<Example> readExamples(std::span<const Source> sources, const ReadOptions& options,
                                  const Progress& progress) {
  if (sources.empty()) throw InputError("there is no example");
  std::vector<Example> examples;
  const double share = 1.0 / static_cast<double>(sources.size());
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const double from = share * static_cast<double>(n);
    const Progress part = progress.part(from, from + share);
    examples.push_back(readExample(sources[n], options, part));
    if (n > 0 && examples[n].form() != examples[0].form()) {
      throw InputError(sources[n].name() + " and " + sources[0].name() +
                       " are of different kinds; examples that are used together should be alike");
    }
    if (n > 0 && examples[n].form() == Form::Heights) requireAlike(examples[n], examples[0]);
    if (n > 0 && examples[n].form() == Form::Field) sampleAlike(examples[n], examples[0], part);
  }
  if (examples[0].form() == Form::Labels) numberAlike(examples);
  if (examples[0].form() == Form::Heights) joinTiles(examples);
  return examples;
}

std::vector<const DistanceField*> fieldsOf(std::span<const Example> examples) {
  std::vector<const DistanceField*> fields;
  for (const Example& example : examples) fields.push_back(&example.field());
  return fields;
}

}  // namespace exemplar
