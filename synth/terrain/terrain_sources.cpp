// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/terrain_sources.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/error.h"
#include "maps/drainage.h"
#include "synth/terrain/bent_heights.h"
#include "synth/terrain/gradient_direction.h"

namespace exemplar {
namespace {

/// Least side of the examples on the coarsest resolution: room for different patches.
constexpr int kCoarsestSide = 14;
/// How many more hollows a result may have: to fill or cut what is land changes its slopes.
constexpr double kMoreHollows = 1.5;
/// Where no more than this lies in hollows, valleys drain the land, and what means over samples dam
/// on coarse resolutions is no hollow.
constexpr double kDrained = 0.1;
/// How much beds of cuts fall beside the larger streams of the example.
constexpr double kFallShare = 0.5;

/// How far the larger streams of the examples fall, height per sample.
double streamFall(std::span<const Grid<float>> examples, const Progress& progress) {
  double fall = 0, length = 0;
  for (const Grid<float>& heights : examples) {
    const Drainage drainage = drain(heights, progress);
    const Grid<std::uint32_t> accumulation = flowAccumulation(drainage);
    const auto least = std::max<std::size_t>(8, heights.count() / 200);
    for (const std::uint32_t cell : drainage.order) {
      const std::uint8_t direction = drainage.directions[cell];
      if (accumulation[cell] < least || direction >= kLeavesMap) continue;
      const Pixel step = kNeighbors[direction];
      const auto down = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + step.x +
                                                 std::ptrdiff_t{step.y} * heights.width());
      fall += drainage.levels[cell] - drainage.levels[down];
      length += step.x != 0 && step.y != 0 ? 1.41421356 : 1;
    }
  }
  return length > 0 ? fall / length : 0;
}

int levelsOf(std::span<const Grid<float>> examples, const TerrainSynthesisOptions& options) {
  int least = std::numeric_limits<int>::max();
  for (const Grid<float>& example : examples)
    least = std::min({least, example.width(), example.height()});
  const int result = std::min(options.width, options.height);
  if (least < kLeastTerrain || result < kLeastTerrain) {
    throw InputError("height maps have at least " + std::to_string(kLeastTerrain) + " x " +
                     std::to_string(kLeastTerrain) + " samples; " +
                     (least < kLeastTerrain ? "an example has a side of " + std::to_string(least)
                                            : "the result would have " + std::to_string(result)));
  }
  int levels = 1;
  while ((options.levels == 0 ? least >> levels >= kCoarsestSide
                              : levels < options.levels && least >> levels >= kHeightPatch) &&
         result >> levels >= kHeightPatch)
    ++levels;
  return levels;
}

}  // namespace

TerrainSources terrainSources(std::span<const Grid<float>> examples,
                              const TerrainSynthesisOptions& options, const Progress& progress) {
  TerrainSources from;
  from.examples = examples.size();
  from.levels = levelsOf(examples, options);
  from.turns = options.turns.empty() ? turnsOf(examples) : options.turns;
  from.pyramid = heightPyramid(examples, from.levels);
  const auto hasPlaces = [](const HeightSource& source) { return source.places > 0; };
  while (from.levels > 0 && !std::ranges::all_of(from.pyramid.back().sources, hasPlaces)) {
    from.pyramid.pop_back();
    --from.levels;
  }
  if (from.levels == 0) {
    throw InputError("no " + std::to_string(kHeightPatch) + " x " + std::to_string(kHeightPatch) +
                     " samples of a height map are without holes; fill them first");
  }
  if (!options.keepsHollows) {
    // In a larger result streams are longer, and the relief is the same.
    double larger = 1;
    for (const Grid<float>& example : examples) {
      larger = std::max(larger, std::sqrt(static_cast<double>(options.width) * options.height /
                                          static_cast<double>(example.count())));
    }
    from.fall = kFallShare * streamFall(examples, progress.part(0, 0.6)) / larger;
    from.hollows = hollowsOf(examples, from.levels, progress.part(0.6, 0.9));
    for (std::size_t l = 1; l < from.hollows.size() && from.hollows[0].share > kDrained; ++l) {
      std::vector<Grid<float>> maps;
      for (const HeightSource& source : from.pyramid[l].sources) maps.push_back(source.heights);
      from.hollows[l] = hollowsOf(maps).front();
    }
    for (Hollows& hollows : from.hollows)
      for (double& share : hollows.bySize) share *= kMoreHollows;
  }
  addBentCopies(from.pyramid, from.examples,
                bendsOf(examples, from.turns, !options.turns.empty(), options.seed));
  return from;
}

}  // namespace exemplar
