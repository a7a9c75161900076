// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/comparison.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "apps/command.h"
#include "apps/label_example.h"
#include "apps/terminal.h"
#include "apps/words.h"
#include "core/error.h"
#include "core/memory.h"
#include "measure/mesh_result.h"
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

/// In the order of `ComparedEngine`.
struct Engine {
  const char* name;
  ComparedEngine engine;
  const char* settings;
};
constexpr Engine kEngines[] = {
    {"blocks", ComparedEngine::Blocks, "block levels truncation"},
    {"optimize", ComparedEngine::Optimize, "patch levels rounds completeness truncation"},
    {"model", ComparedEngine::Model, "block overlap tolerance truncation"},
    {"overlap", ComparedEngine::Overlap, "block overlap tolerance truncation"}};

/// Sets `value` where the setting is given.
template <class Value>
void take(const EngineSettings& settings, const std::string& key, Value& value) {
  for (const auto& [name, number] : settings.values) {
    if (name != key) continue;
    if constexpr (std::is_same_v<Value, double>) {
      value = number;
    } else {
      value = wholeNumber(number, key);
    }
  }
}

void takeGeometry(SynthesisResult made, ComparedResult& result) {
  result.status = made.status == SynthesisStatus::Complete ? "complete" : "cancelled";
  result.field = std::move(made.field);
  result.origins = std::move(made.origins);
}

/// Whether model synthesis made anything; else why not.
bool takeModel(const ModelResult& made, ComparedResult& result) {
  switch (made.status) {
    case ModelStatus::Cancelled:
      result.status = "cancelled";
      break;
    case ModelStatus::Impossible:
      result.status = "impossible";
      result.why = made.conflict.text;
      break;
    case ModelStatus::Unfinished:
      result.status = "unfinished";
      result.why = "no result within the budget, and none is proved impossible";
      break;
    case ModelStatus::Complete:
      result.status = "complete";
      break;
  }
  return made.status == ModelStatus::Complete;
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
  if (!takeModel(made, result)) return;
  PlacedBlocks placed = placeBlocks(example.field, blocks, made.grid().cells);
  result.field = std::move(placed.field);
  result.origins = std::move(placed.origins);
}

/// Model synthesis of a scene that is made of pieces on a grid, by these; its result is sampled
/// where the field of one by geometry synthesis would stand.
void runPieces(const Example& example, const Vec3d& scale, std::uint64_t seed,
               const Progress& progress, ComparedResult& result) {
  const LabelExample pieces = loadLabelExample(example.path, {}, progress);
  result.status = "cancelled";
  if (progress.cancelled()) return;
  ModelOptions options;
  options.size = scaledSize(pieces.grid.size(), scale, "cells");
  result.labels = pieces.grid.labelCount();
  options.seed = seed;
  const Stopwatch synthesis;
  const ModelResult made = synthesizeModel(pieces.grid, options, progress);
  if (!takeModel(made, result)) return;
  result.seconds = synthesis.seconds();
  result.mesh = labelsToMesh(made.grid(), pieces);
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis)
    size[axis] = static_cast<int>(std::lround(
        made.grid().size()[axis] * pieces.grid.cellSize[axis] / example.field.voxelSize));
  result.field = sampleMeshResult(result.mesh, example.field, {.size = size}, progress);
  const AdjacencyViolations violations = findViolations(made.grid(), pieces.grid);
  result.pairs = violations.pairs;
  result.violations = violations.count;
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

const char* engineName(ComparedEngine engine) { return kEngines[static_cast<int>(engine)].name; }

EngineSettings parseEngine(const std::string& text) {
  const std::vector<std::string> words = split(text, ':');
  EngineSettings settings;
  const auto* kind = std::ranges::find(kEngines, words[0], [](const Engine& e) { return e.name; });
  if (kind == std::end(kEngines))
    throw InputError("--engines " + words[0] + ": expected blocks, optimize, model or overlap");
  settings.engine = kind->engine;
  const std::vector<std::string> keys = split(kind->settings, ' ');
  const std::string form = "KEY=NUMBER, KEY one of " + std::string(kind->settings);
  for (std::size_t w = 1; w < words.size(); ++w) {
    const auto [key, value] = keyAndValue(words[w], "--engines " + words[0] + ":", form);
    if (std::ranges::find(keys, key) == keys.end())
      throw InputError("--engines " + words[0] + ": " + key + ": expected " + form);
    settings.values.emplace_back(key, parseNumber(value, "--engines " + text));
  }
  return settings;
}

ComparedResult runEngine(const EngineSettings& settings, const Example& example, const Vec3d& scale,
                         std::uint64_t seed, const Progress& progress) {
  ComparedResult result;
  const Vec3i size = scaledSize(example.field.size(), scale, "samples");
  requireMemory(kBytesPerSample * static_cast<double>(volume(size)),
                "a result of " + readableSize(size), "use a lower --resolution or --scale");
  const bool peak = resetPeakResident();
  const Stopwatch stopwatch;
  try {
    if (settings.engine == ComparedEngine::Blocks) {
      BlocksOptions options;
      options.size = size;
      options.seed = seed;
      options.block = example.block;
      take(settings, "block", options.block);
      take(settings, "levels", options.iterations);
      take(settings, "truncation", options.truncation);
      takeGeometry(synthesizeBlocks(example.field, options, progress), result);
    } else if (settings.engine == ComparedEngine::Optimize) {
      OptimizeOptions options;
      options.size = size;
      options.seed = seed;
      take(settings, "patch", options.patch);
      take(settings, "levels", options.levels);
      take(settings, "rounds", options.rounds);
      take(settings, "completeness", options.completeness);
      take(settings, "truncation", options.truncation);
      takeGeometry(synthesizeOptimized(example.field, options, progress), result);
    } else if (settings.engine == ComparedEngine::Model && settings.values.empty() &&
               isLabelExample(example.path)) {
      runPieces(example, scale, seed, progress, result);
    } else {
      FieldBlocksOptions cut =
          settings.engine == ComparedEngine::Overlap ? kOverlapping : FieldBlocksOptions{};
      int block = 0;
      take(settings, "block", block);
      cut.block = {block, block, block};
      take(settings, "overlap", cut.overlap);
      take(settings, "tolerance", cut.tolerance);
      take(settings, "truncation", cut.truncation);
      runModel(example, cut, scale, seed, progress, result);
    }
  } catch (const InputError& error) {
    // The comparison goes on: that an engine cannot take the example is a finding.
    result.status = "refused";
    result.why = error.what();
  }
  // Of pieces without the sampling, which is for the measures alone.
  if (result.seconds == 0) result.seconds = stopwatch.seconds();
  if (result.status != "complete") return result;
  if (result.mesh.triangles.empty()) {
    try {
      result.mesh = reconstructSurface(result.field, result.origins,
                                       {example.field, example.mesh ? &*example.mesh : nullptr},
                                       {.blend = 0}, progress)
                        .mesh;
    } catch (const InputError& error) {
      // All solid or all air: a finding, too.
      result.status = "empty";
      result.why = error.what();
      return result;
    }
  }
  if (peak) result.peakBytes = peakResidentBytes();
  if (!result.violations) countViolations(example, progress, result);
  return result;
}

}  // namespace exemplar
