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

/// Blocks of 8 samples that share 2, and agree there within two voxels: of those tried the
/// strictest that can go on with a terrain.
constexpr FieldBlocksOptions kOverlapping{.tolerance = 1, .overlap = 2};
constexpr double kBytesPerSample = 80;  // of the field, origins, search and surface

void takeGeometry(SynthesisResult made, ComparedResult& result) {
  result.status = made.status == SynthesisStatus::Complete ? "complete" : "cancelled";
  result.field = std::move(made.field);
  result.origins = std::move(made.origins);
}

/// Model synthesis by blocks cut as `cut` says.
void runModel(const Example& example, const FieldBlocksOptions& cut, const Vec3d& scale,
              std::uint64_t seed, const Progress& progress, ComparedResult& result) {
  const FieldBlocks blocks = cutIntoBlocks(example.field, cut, progress);
  result.status = "cancelled";
  if (progress.cancelled()) return;
  result.labels = blocks.grid.labelCount();
  ModelOptions options;
  options.seed = seed;
  const std::array<bool, 6> open = cutSides(example.field);
  for (std::size_t side = 0; side < open.size(); ++side)
    if (open[side]) options.sides[side].kind = SideRule::Kind::Free;
  const Vec3i wanted = scaledSize(example.field.size(), scale, "samples");
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = static_cast<double>(wanted[axis]) / blocks.stride[axis];
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
  PlacedBlocks placed = placeBlocks(example.field, blocks, made.grid().cells);
  result.field = std::move(placed.field);
  result.origins = std::move(placed.origins);
}

/// Counts the pairs of blocks that the example does not show: for every engine in the same way, by
/// the result's samples alone.
void countViolations(const Example& example, const Progress& progress, ComparedResult& result) {
  try {
    const FieldBlocks blocks = cutIntoBlocks(example.field, {}, progress);
    if (progress.cancelled()) return;
    const RecognizedBlocks found = recognizeBlocks(result.field, example.field, blocks, progress);
    if (progress.cancelled()) return;
    const AdjacencyViolations violations = findViolations(found.grid, blocks.grid);
    result.pairs = violations.pairs;
    result.violations = violations.count;
    result.unknownBlocks =
        static_cast<double>(found.unknown) / static_cast<double>(found.grid.cells.count());
  } catch (const InputError&) {
    // Too many kinds of blocks, or a result smaller than one: nothing is counted.
  }
}

}  // namespace

const char* engineName(ComparedEngine engine) {
  switch (engine) {
    case ComparedEngine::Blocks:
      return "blocks";
    case ComparedEngine::Optimize:
      return "optimize";
    case ComparedEngine::Model:
      return "model";
    case ComparedEngine::Overlap:
      break;
  }
  return "overlap";
}

ComparedResult runEngine(ComparedEngine engine, const Example& example, const Vec3d& scale,
                         std::uint64_t seed, const Progress& progress) {
  ComparedResult result;
  const Vec3i size = scaledSize(example.field.size(), scale, "samples");
  requireMemory(kBytesPerSample * static_cast<double>(volume(size)),
                "a result of " + readableSize(size), "use a lower --resolution or --scale");
  const bool peak = resetPeakResident();
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
    } else if (engine == ComparedEngine::Model) {
      runModel(example, {}, scale, seed, progress, result);
    } else {
      runModel(example, kOverlapping, scale, seed, progress, result);
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
  if (peak) result.peakBytes = peakResidentBytes();
  countViolations(example, progress, result);
  return result;
}

}  // namespace exemplar
