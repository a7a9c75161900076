// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/result.h"

#include <cmath>

#include "core/error.h"
#include "engine/words.h"
#include "sdf/vdb_file.h"
#include "synth/geometry/detail.h"

namespace exemplar {

Turn turnOf(const Result& result, const Example& example) {
  return result.originMap ? Turn{} : example.turn;
}

std::string readableExtent(const Result& result) {
  switch (result.form()) {
    case Form::Field:
      return readableSize(result.field().size(), "samples");
    case Form::Labels:
      return readableSize(result.labels().size(), "cells");
    case Form::Map:
      return std::to_string(result.map().width()) + " x " + std::to_string(result.map().height()) +
             " pixels";
    case Form::Heights:
      return withThousands(result.heights().width()) + " x " +
             withThousands(result.heights().height()) + " points";
    default: {
      const continuous::PolygonModel& model = result.polygons();
      return readableSize(model.size, "spacings") + ", " +
             withThousands(static_cast<long long>(model.polygons.size())) + " faces";
    }
  }
}

std::optional<SampledResult> sampled(const Result& result, const Example& example) {
  if (result.form() == Form::Field) return SampledResult{result.field(), result.origins};
  const auto* labeled = std::get_if<LabeledField>(&example.content);
  if (!labeled || result.form() != Form::Labels) return std::nullopt;
  PlacedBlocks placed = placeBlocks(labeled->field, labeled->blocks, result.labels().cells);
  return SampledResult{std::move(placed.field), std::move(placed.origins)};
}

Result withDetail(const Result& result, std::span<const Example> finer, int factor,
                  const Progress& progress) {
  if (result.originMap)
    throw InputError("`detail`: a result on a surface is not re-made; use a higher `resolution`");
  SynthesisResult fine = addDetail(fieldsOf(finer), result.origins, factor, progress);
  Result detailed = result;
  detailed.data = std::move(fine.field);
  detailed.origins = std::move(fine.origins);
  detailed.statistics.emplace_back("detail", std::int64_t{factor});
  return detailed;
}

Result readResult(const Source& field, const Source& origins, std::span<const Example> examples) {
  Result result;
  Turn turn;
  DistanceField values = readDistances(field, {.turn = &turn}, &result.periodic);
  result.origins = readOriginsVdb(origins.path());
  if (result.origins.size() != values.size()) {
    throw InputError(origins.name() + ": origins of " +
                     readableSize(result.origins.size(), "samples") + " for a volume of " +
                     readableSize(values.size(), "samples"));
  }
  const double voxel = examples[0].field().voxelSize;
  if (std::abs(voxel / values.voxelSize - 1) > 1e-3) {
    throw InputError(examples[0].name() + ": sampled with voxels of " + numberText(voxel) + ", " +
                     field.name() + " has " + numberText(values.voxelSize) +
                     "; give the `resolution` and `padding` of the synthesis");
  }
  for (const Origin& origin : result.origins.values()) {
    if (origin.example >= examples.size() ||
        !examples[origin.example].field().values.contains(origin.cell())) {
      throw InputError(origins.name() + ": names samples that " + examples[0].name() +
                       " does not have; give the examples and settings of the synthesis");
    }
  }
  result.data = std::move(values);
  return result;
}

}  // namespace exemplar
