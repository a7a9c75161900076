// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/measured.h"

#include "engine/model_request.h"

#include <utility>

#include "core/error.h"
#include "engine/example_forms.h"
#include "engine/realize.h"
#include "engine/request.h"
#include "measure/mesh_result.h"
#include "mesh/footprint.h"
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
  if (result.form() == Form::Polygons || result.form() == Form::Map) return std::nullopt;
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
    throw InputError(result.name() + ": a result of labels is a .txt, .vox, .vdb or a picture");
  // A grid of pieces or blocks is written by their numbers.
  both[0].content = both[1].kind == SourceKind::Picture ? both[0].content : LabelContent{};
  numberAlike(both);
  return measureContent(both[0].labels(), both[1].labels(), progress.part(0.3, 1));
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
