// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "engine/engine.h"
#include "mesh/mesh_file.h"
#include "preview/render.h"

/// Engines compared: on one example, at one size, measured by one ruler.
namespace exemplar {

/// An engine with settings of its own, "blocks:block=8:levels=2".
struct ComparedEngine {
  std::string name;  ///< as it was written
  const Engine* engine = nullptr;
  Settings settings;
};
/// Reads "NAME" or "NAME:KEY=VALUE:..."; the keys are those of `settingsOf` that say how the engine
/// works, not what is asked of it. `optimize` is another name of geometry, and `overlap` is model
/// on blocks of 8 samples that share 2. Throws `InputError`.
ComparedEngine parseComparedEngine(const std::string& text);

/// How far an engine's results are apart, for people.
struct ComparedSeeds {
  std::string engine;
  int results = 0;
  double diversity = 0, rolledDiversity = 0;  ///< `diversity`, and after the best roll
  /// Pairs of seeds that are one result, moved: less than a tenth apart after the best roll.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> equal;
};

struct ComparisonOptions {
  std::filesystem::path folder;  ///< for meshes, pictures, compare.json and report.html
  std::vector<ComparedEngine> engines;
  std::optional<Vec3d> scale;  ///< the example's hint by default
  std::uint64_t firstSeed = 0;
  int seeds = 3;
  RenderOptions picture;
  MeshFileOptions mesh;
  /// Hears of files that were written, so that an interrupted comparison can say so.
  std::function<void(const std::filesystem::path&)> wrote;
  /// Hears how far the seeds of each engine are apart, once all are made.
  std::function<void(const ComparedSeeds&)> compared;
};

/// One run of a comparison, for people.
struct ComparedRun {
  std::string engine;
  std::uint64_t seed = 0;
  /// "complete", "empty", "impossible", "unfinished" or "refused": that an engine cannot take the
  /// example is a finding.
  std::string status;
  std::string why;  ///< where it is not complete
  double seconds = 0;
  std::optional<double> lpDense, coverage;
  std::optional<double> multiscale, rolled;  ///< likeness at several scales, rolled distance
  std::string frontier;                      ///< `frontierName` of the two; empty without them
  std::vector<std::string> doubts;           ///< what to be warned of
  bool again = false;                        ///< it was made before
};

/// Runs every engine with every seed on the example, of the form Field; measures, draws and writes
/// each result into the folder, and the whole as compare.json and report.html. What the folder
/// holds of the same request is not made again. `finished` hears of each run. Throws `InputError`
/// and `Cancelled`; what was finished by then stays in the folder.
void compare(const Example& example, const ComparisonOptions& options,
             const std::function<void(const ComparedRun&)>& finished = {},
             const Progress& progress = {});

}  // namespace exemplar
