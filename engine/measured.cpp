// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/measured.h"

#include <cmath>
#include <utility>

#include "core/error.h"
#include "engine/example_forms.h"
#include "engine/heights.h"
#include "engine/label_layers.h"
#include "engine/model_request.h"
#include "engine/realize.h"
#include "engine/request.h"
#include "engine/words.h"
#include "measure/mesh_result.h"
#include "mesh/footprint.h"
#include "sdf/height_map.h"
#include "sdf/vdb_file.h"

namespace exemplar {

std::optional<Measures> measure(const Result& result, std::span<const Example> examples,
                                const TriangleMesh* surface, const Progress& progress) {
  const Example& example = examples.front();
  MeasureInput input;
  input.mesh = surface;
  if (result.form() == Form::Field) {
    input.origins = &result.origins;
    return measure(example.field(), result.field(), input, {}, progress);
  }
  if (result.form() == Form::Polygons || result.form() == Form::Map ||
      result.form() == Form::Heights)
    return std::nullopt;
  const std::optional<SampledResult> placed = sampled(result, example);
  if (!placed) return std::nullopt;
  input.origins = &placed->origins;
  return measure(std::get<LabeledField>(example.content).field, placed->field, input, {}, progress);
}

std::optional<Content> measureContent(const Result& result, std::span<const Example> examples,
                                      const Progress& progress) {
  if (result.form() != Form::Labels) return std::nullopt;
  const std::vector<LabelGrid> shown = modelGrids(examples);
  std::vector<const LabelGrid*> grids;
  for (const LabelGrid& grid : shown) grids.push_back(&grid);
  return measureContent(grids, result.labels(), progress);
}

Content measureContent(const Source& result, const Example& example, const Progress& progress) {
  ReadOptions options = example.reading;
  options.resolution.reset();
  std::vector<Example> both{example, readExample(result, options, progress.part(0, 0.3))};
  if (both[1].kind != SourceKind::Labels && both[1].kind != SourceKind::Picture)
    throw InputError(result.name() +
                     ": a result of labels is a .txt, .vox, .vdb, .tmx, .csv or a picture");
  // A grid of pieces or blocks is written by their numbers.
  const bool looks = both[1].kind == SourceKind::Picture || isTiledFile(result.path());
  both[0].content = looks ? both[0].content : LabelContent{};
  numberAlike(both);
  return measureContent(both[0].labels(), both[1].labels(), progress.part(0.3, 1));
}

std::optional<TerrainLikeness> measureTerrain(const Result& result,
                                              std::span<const Example> examples,
                                              const Progress& progress) {
  const Example& example = examples.front();
  if (result.form() == Form::Heights) {
    const HeightMap &wanted = example.heights(), &made = result.heights();
    Grid<std::uint8_t> seams(made.width(), made.height());
    const Grid<HeightOrigin>& origins = result.heightOrigins;
    for (int y = 0; y < made.height(); ++y) {
      for (int x = 0; x < made.width(); ++x) {
        const HeightOrigin& here = origins(x, y);
        if (x + 1 < made.width() && !(origins(x + 1, y) == stepped(here, {1, 0})))
          seams(x, y) |= kSeamRight;
        if (y + 1 < made.height() && !(origins(x, y + 1) == stepped(here, {0, 1})))
          seams(x, y) |= kSeamBelow;
      }
    }
    return measureTerrain(wanted.heights, made.heights,
                          {.cellSize = wanted.cellSize, .meters = wanted.cellSizeKnown}, &seams,
                          progress);
  }
  if (result.form() != Form::Field || example.kind != SourceKind::HeightMap) return std::nullopt;
  const HeightMap wanted = sdfToHeightMap(example.field(), progress.part(0, 0.05));
  const HeightMap made = sdfToHeightMap(result.field(), progress.part(0.05, 0.1));
  return measureTerrain(wanted.heights, made.heights, {.cellSize = wanted.cellSize}, nullptr,
                        progress.part(0.1, 1));
}

LayersLikeness measureLayers(const Source& example, const Source& result,
                             const Progress& progress) {
  const Source both[] = {example, result};
  const std::vector<Example> read =
      readExamples(both, {.form = Form::Labels}, progress.part(0, 0.2));
  const LabelLayers layers = layersOfLabels(read[0].labels(), {}, example.name());
  return measureLayers(layers.layers, false, layersLike(read[1].labels(), layers, result.name()),
                       progress.part(0.2, 1));
}

bool areHeights(const Source& example, const Source& result) {
  return sourceKind(example) == SourceKind::HeightMap &&
         sourceKind(result) == SourceKind::HeightMap;
}

TerrainLikeness measureTerrain(const Source& example, const Source& result,
                               const ReadOptions& reading, Warnings& warnings,
                               const Progress& progress) {
  const Source both[] = {example, result};
  const std::vector<HeightMap> maps =
      readHeightsAlike(both, reading, warnings, progress.part(0, 0.2));
  const double wanted = maps[0].cellSize, made = maps[1].cellSize;
  // A volume's samples divide the length that the points of its example span.
  if (std::abs(made - wanted) > 0.02 * wanted) {
    throw InputError(result.name() + " has cells of " + numberText(made) + ", and " +
                     example.name() + " of " + numberText(wanted) +
                     "; terrain is measured at one resolution: resample one of them");
  }
  return measureTerrain(maps[0].heights, maps[1].heights,
                        {.cellSize = wanted, .meters = maps[0].cellSizeKnown}, nullptr,
                        progress.part(0.2, 1));
}

Measured readMeasured(const Source& result, const std::optional<Source>& origins,
                      const std::optional<Vec3d>& scale, const Example& example,
                      const Progress& progress) {
  Measured measured;
  if (origins) measured.origins = readOriginsVdb(origins->path());
  if (sourceKind(result) != SourceKind::Mesh) {
    if (scale)
      throw InputError("`scale`: " + result.name() + " has a size of its own; only a mesh has not");
    ReadOptions options = example.reading;
    options.form = Form::Field;
    options.holdDetail = options.scatter = false;
    options.wanted.reset();
    options.padding = 0;
    measured.field = readExample(result, options, progress).field();
    return measured;
  }
  std::optional<Vec3i> size;
  if (measured.origins.count() > 0) {
    if (scale) throw InputError("`scale`: the origins say the size already; give one of the two");
    size = measured.origins.size();
  } else if (scale) {
    size = scaledSize(example.field().size(), *scale, "samples");
  }
  measured.mesh = readTriangles(result, example.reading.mesh);
  turn(*measured.mesh, example.turn.back());
  try {
    measured.field = sampleMeshResult(*measured.mesh, example.field(), {.size = size}, progress);
  } catch (const InputError& error) {
    throw InputError(result.name() + ": " + error.what());
  }
  return measured;
}

TriangleMesh surfaceOf(const Measured& measured, const Example& example, const Progress& progress) {
  if (measured.mesh) {
    TriangleMesh mesh = *measured.mesh;
    turn(mesh, example.turn);
    return mesh;
  }
  if (measured.origins.count() == 0) {
    Example alone;
    alone.data = measured.field;
    alone.turn = example.turn;
    return contourOf(alone, {}, progress).mesh;
  }
  Result result;
  result.data = measured.field;
  result.origins = measured.origins;
  return realize(result, {&example, 1}, {}, progress).mesh;
}

Measures measure(const Measured& result, const Example& example, const Progress& progress) {
  MeasureInput input;
  if (result.origins.count() > 0) input.origins = &result.origins;
  if (result.mesh) input.mesh = &*result.mesh;
  return measure(example.field(), result.field, input,
                 {.likeness = {.contoured = result.mesh.has_value()}}, progress);
}

}  // namespace exemplar
