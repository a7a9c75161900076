// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/command.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/memory.h"
#include "reconstruct/reconstruct.h"
#include "synth/geometry/blocks.h"
#include "synth/geometry/optimize.h"
#include "synth/model/synthesize.h"
#include "voxelize/field_blocks.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

constexpr double kBytesPerSample = 80;  // of the field, origins, search and surface

void takeGeometry(SynthesisResult made, ComparedResult& result) {
  result.status = made.status == SynthesisStatus::Complete ? "complete" : "cancelled";
  result.field = std::move(made.field);
  result.origins = std::move(made.origins);
}

void runModel(const Example& example, const Vec3d& scale, std::uint64_t seed,
              const Progress& progress, ComparedResult& result) {
  const FieldBlocks blocks = cutIntoBlocks(example.field, {}, progress);
  result.status = "cancelled";
  if (progress.cancelled()) return;
  result.labels = blocks.grid.labelCount();
  ModelOptions options;
  options.seed = seed;
  const std::array<bool, 6> cut = cutSides(example.field);
  for (std::size_t side = 0; side < cut.size(); ++side)
    if (cut[side]) options.sides[side].kind = SideRule::Kind::Free;
  const Vec3i wanted = scaledSize(example.field.size(), scale, "samples");
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = static_cast<double>(wanted[axis]) / blocks.block[axis];
    options.size[axis] = std::max(1, static_cast<int>(std::lround(cells)));
  }
  const ModelResult made =
      synthesizeModel(std::span(&blocks.grid, 1), blocks.adjacency, options, progress);
  switch (made.status) {
    case ModelStatus::Cancelled:
      return;
    case ModelStatus::Impossible:
      result.status = "impossible";
      result.why = made.conflict.text;
      return;
    case ModelStatus::Unfinished:
      result.status = "unfinished";
      result.why = "no result within the budget, and none is proved impossible";
      return;
    case ModelStatus::Complete:
      break;
  }
  result.status = "complete";
  result.violations = findViolations(made.grid(), blocks.grid).count;
  PlacedBlocks placed = placeBlocks(example.field, blocks, made.grid().cells);
  result.field = std::move(placed.field);
  result.origins = std::move(placed.origins);
}

}  // namespace

const char* engineName(ComparedEngine engine) {
  switch (engine) {
    case ComparedEngine::Blocks:
      return "blocks";
    case ComparedEngine::Optimize:
      return "optimize";
    case ComparedEngine::Model:
      break;
  }
  return "model";
}

ComparedResult runEngine(ComparedEngine engine, const Example& example, const Vec3d& scale,
                         std::uint64_t seed, const Progress& progress) {
  ComparedResult result;
  const Vec3i size = scaledSize(example.field.size(), scale, "samples");
  requireMemory(kBytesPerSample * static_cast<double>(volume(size)),
                "a result of " + readableSize(size), "use a lower --resolution or --scale");
  const Stopwatch stopwatch;
  try {
    if (engine == ComparedEngine::Blocks) {
      BlocksOptions options;
      options.size = size;
      options.seed = seed;
      options.block = example.block;
      takeGeometry(synthesizeBlocks(example.field, options, progress), result);
    } else if (engine == ComparedEngine::Optimize) {
      OptimizeOptions options;
      options.size = size;
      options.seed = seed;
      takeGeometry(synthesizeOptimized(example.field, options, progress), result);
    } else {
      runModel(example, scale, seed, progress, result);
    }
  } catch (const InputError& error) {
    // The comparison goes on: that an engine cannot take the example is a finding.
    result.status = "refused";
    result.why = error.what();
  }
  result.seconds = stopwatch.seconds();
  if (result.status != "complete") return result;
  result.mesh = reconstructSurface(result.field, result.origins,
                                   {example.field, example.mesh ? &*example.mesh : nullptr},
                                   {.blend = 0}, progress)
                    .mesh;
  return result;
}

}  // namespace exemplar
