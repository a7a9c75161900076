// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/example.h"
#include "reconstruct/reconstruct.h"
#include "synth/geometry/optimize.h"

namespace CLI {
class App;
}

namespace exemplar {

/// What users ask of a synthesis beyond its size, as they type it.
struct SynthControl {
  std::string stationary = "auto", periodic, keep, guide;
  std::vector<std::string> with;  ///< more examples
  bool rotations = false;
  int detail = 1;

  /// Whether there is anything that only the method optimize can do.
  bool asksForOptimize() const;
};

void addControlOptions(CLI::App& command, SynthControl& control);

/// "x,y", "xy" or "none" as a choice of axes; throws `InputError` naming `option`.
std::array<bool, 3> parseAxes(const std::string& text, const std::string& option);
/// "x and y", "none".
std::string readableAxes(bool x, bool y, bool z);

/// The first example, and those of `--with` sampled with its voxels.
struct Examples {
  std::vector<Example> all;

  Examples(Example first, const SynthControl& control, const ExampleOptions& reading,
           const Progress& progress);
  const Example& first() const { return all.front(); }
  std::vector<const DistanceField*> fields() const;
  /// For `reconstructSurface`: triangles and the fields that the origins name.
  std::vector<ReconstructExample> views() const;
  /// Samples all fields `factor` times as finely, in their boxes. Throws `InputError` for volumes,
  /// which have no finer samples.
  void refine(int factor, const ExampleOptions& reading, const Progress& progress);
};

/// The options that the control stands for. Reads the files that it names.
OptimizeOptions optimizeOptions(const SynthControl& control, const Examples& examples,
                                const Vec3i& size, const ExampleOptions& reading,
                                const Progress& progress);

}  // namespace exemplar
