// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"
#include "synth/terrain/height_origin.h"

/// Terrain synthesis: more of a height map, whose rivers run to its border.
///
/// Coarse to fine on a pyramid of heights. On each resolution, patches of the result look for the
/// example's patch of the same shape, wherever that lies in height, and vote; then hollows get
/// outlets, so that the next finer resolution grows valleys where water must run. Between pieces
/// from different places the steps of both sides decide, and heights follow them (a Poisson
/// equation). After Zhou, Sun, Turk, Rehg: "Terrain synthesis from digital elevation models", IEEE
/// TVCG 13(4), 2007, doi:10.1109/TVCG.2007.1027, and Gain, Merry, Marais: "Parallel, realistic and
/// controllable terrain synthesis", Computer Graphics Forum 34(2), 2015, doi:10.1111/cgf.12545;
/// unlike them, drainage is a part of each resolution, and nothing but the example says what
/// valleys look like.
namespace exemplar {

/// Sides of the smallest examples and results, samples.
inline constexpr int kLeastTerrain = 16;

/// What is known of a result before it is made. Empty grids say nothing.
struct TerrainControl {
  /// Heights that the result should roughly have, stretched over it; of any size, finite.
  Grid<float> guide;
  /// How much of `follow` counts where, 0 (the land is free) to 1; of the guide's size. Empty: all.
  Grid<float> guideWeight;
  /// How strictly they are followed: 0 (not) to 1.
  double follow = 0.8;
  /// Which resolution's heights the guide is, 0 the finest: what is finer is the example's.
  /// Negative: roughly, as large shapes are.
  int guideLevel = -1;
  /// Heights of some of the result's samples (of its size), and how firmly each is held: 1 stays to
  /// the bit, 0 is free, between them both mix.
  Grid<float> given, hold;
  /// Where water leaves the result, 1 (of its size); empty: all along its border. What is held then
  /// stays on all resolutions.
  Grid<std::uint8_t> outlets;
};

struct TerrainSynthesisOptions {
  int width = 0, height = 0;  ///< of the result, samples; each at least `kLeastTerrain`
  std::uint64_t seed = 0;
  bool wrapsX = false, wrapsY = false;  ///< copies of the result tile
  /// Orientations in which the examples are used (`turnedStep`); empty: those that keep the
  /// direction of the terrain, all eight where it has none.
  std::vector<int> turns;
  int levels = 0;  ///< resolutions, each half the one before; 0: found; 1..12
  int rounds = 3;  ///< of matching and voting on each resolution, 1..50
  /// About the width of the pieces that are taken from one place, samples of each resolution:
  /// larger ones are more like the examples, and recognized; 8..24.
  int piece = 9;
  /// Cut no outlets. Otherwise a result has at most 1.5 times as many hollows as its examples, none
  /// where fewer than 2 % of their samples lie in some.
  bool keepsHollows = false;
  TerrainControl control;
};

struct SynthesizedTerrain {
  Grid<float> heights;
  Grid<HeightOrigin> origins;  ///< where each sample's shape came from
  int levels = 0;
  std::vector<int> turns;
  double flooded = 0;        ///< the share below its spill level before the last outlets
  std::int64_t outlets = 0;  ///< that were cut at the finest resolution
  double meanCut = 0;        ///< what was taken away for them, a sample
  double deepestCut = 0;
};

/// Makes more of height maps of one unit and cell size; samples that are NaN are holes, from which
/// nothing is taken. About 4 microseconds of one core a sample, and 80 bytes. The same bytes at any
/// number of threads. Throws `InputError` where maps are too small or hold no patch without holes,
/// and `Cancelled`.
SynthesizedTerrain synthesizeTerrain(std::span<const Grid<float>> examples,
                                     const TerrainSynthesisOptions& options,
                                     const Progress& progress = {});

struct TerrainSources;

/// The same for many results of one size, which share what is found out about the examples. The
/// options' seed says how copies of them bend; their control is not used.
class TerrainSynthesizer {
 public:
  TerrainSynthesizer(std::span<const Grid<float>> examples, const TerrainSynthesisOptions& options,
                     const Progress& progress = {});
  ~TerrainSynthesizer();

  /// A result of a seed. Thread-safe; throws `Cancelled`.
  SynthesizedTerrain make(std::uint64_t seed, const TerrainControl& control,
                          const Progress& progress = {}) const;

 private:
  TerrainSynthesisOptions options_;
  std::unique_ptr<TerrainSources> sources_;
};

}  // namespace exemplar
