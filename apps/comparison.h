// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/example.h"
#include "core/origin.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// The ways to more of an example that are compared.
enum class ComparedEngine {
  Blocks,    ///< geometry synthesis by best-matching blocks (Lagae 2004)
  Optimize,  ///< geometry synthesis by patch optimisation
  Model,     ///< model synthesis: of a bundled scene of pieces on these, of anything else on blocks
             ///< of the same distance field (`voxelize/field_blocks.h`)
  Overlap,   ///< the same on blocks that overlap, for examples without a grid
};
const char* engineName(ComparedEngine engine);

/// An engine and what of its settings is not as by default.
struct EngineSettings {
  ComparedEngine engine = ComparedEngine::Optimize;
  std::vector<std::pair<std::string, double>> values;
};

/// Reads "optimize", or "optimize:patch=9:rounds=8". Throws `InputError` naming the engines, or the
/// engine's settings: blocks has block, levels, truncation; optimize patch, levels, rounds,
/// completeness, truncation; model and overlap block, overlap, tolerance, truncation.
EngineSettings parseEngine(const std::string& text);

/// What one engine made of the example with one seed.
struct ComparedResult {
  std::string status;  ///< "complete", "empty", "impossible", "unfinished", "refused", "cancelled"
  std::string why;     ///< where it is not complete
  DistanceField field;
  Origins origins;  ///< none of pieces
  TriangleMesh mesh;
  double seconds = 0;                      ///< of synthesis alone
  std::optional<std::uint64_t> peakBytes;  ///< resident while it ran, surface included
  std::optional<std::int64_t> labels;      ///< Model, Overlap: kinds of blocks
  /// Pairs of neighbors and those of them that the example does not show: of pieces on their grid;
  /// else with the example cut into blocks that tile, and the result read in these, of which it
  /// says the share that the example has not.
  std::optional<std::int64_t> pairs, violations;
  std::optional<double> unknownBlocks;
};

/// Runs one engine. `scale`: the result's size as a multiple of the example's;
/// Model's is rounded to whole blocks.
ComparedResult runEngine(const EngineSettings& settings, const Example& example, const Vec3d& scale,
                         std::uint64_t seed, const Progress& progress);

}  // namespace exemplar
