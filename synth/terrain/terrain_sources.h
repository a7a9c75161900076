// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/terrain/height_pyramid.h"
#include "synth/terrain/standing_water.h"
#include "synth/terrain/terrain.h"

namespace exemplar {

/// From which share of the samples in hollows on they are the land's own.
inline constexpr double kNaturalHollows = 0.02;

/// Examples as terrain synthesis uses them: the same for all results of one size.
struct TerrainSources {
  std::size_t examples = 0;  ///< how many there are; further sources are bent copies of them
  int levels = 0;
  double fall = 0;                   ///< of beds of cuts, height per sample
  std::vector<Hollows> hollows;      ///< of the examples on each resolution, the finest first
  std::vector<int> turns;            ///< orientations in which they are used
  std::vector<HeightLevel> pyramid;  ///< finest first
};

/// Prepares examples for results of the options' size. Their seed says how copies bend. Throws
/// `InputError` where maps are too small or hold no patch without holes, and `Cancelled`.
TerrainSources terrainSources(std::span<const Grid<float>> examples,
                              const TerrainSynthesisOptions& options,
                              const Progress& progress = {});

}  // namespace exemplar
