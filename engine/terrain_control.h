// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/progress.h"
#include "engine/example.h"
#include "engine/request.h"
#include "maps/height_map.h"
#include "synth/terrain/terrain.h"

/// What a request asks of a terrain beyond its size: files as grids.
namespace exemplar {

struct TerrainFiles {
  std::string detailOf, mask, base, at;
  double follow = 0.8;
  int blend = 16;
};

/// The coarse terrain of `detail-of`, and how many points of the example one of its points is.
struct CoarseTerrain {
  HeightMap map;
  double factor = 4;
};
/// Reads it: the factor is that of the cells' sizes where both are known, else 4. Throws
/// `InputError`, also where it is not coarser than the example.
CoarseTerrain readCoarseTerrain(const std::string& file, const Example& example,
                                const Progress& progress = {});

/// Rough heights, and how much they count where: in full where the weight is empty.
struct TerrainGuide {
  Grid<float> heights, weight;
};
/// Reads a guide: a height map, which holds heights of the example's unit, or grays from its lowest
/// to its highest where the file holds integers that nothing is said about; or lines (.csv .txt).
/// Each line of such a file is `ridge` or `valley` and points `x,y` or `x,y,height` in the result's
/// coordinates, x from its west, y from its south; `#` begins a comment. Land is free where a map
/// has no data (a picture is transparent), and away from lines. Throws `InputError`.
TerrainGuide readTerrainGuide(const Source& source, std::span<const Grid<float>> examples,
                              double cellSize, int width, int height,
                              const Progress& progress = {});

/// What the settings of the engine terrain say that holds for any part of a result. Throws
/// `InputError` naming those that speak of a whole.
TerrainSynthesisOptions localTerrainOptions(const Request& request);

/// What stays: of the example what `keep` paints white, where `at` puts it, and of `base` what
/// `mask` paints black, with a transition of `blend` points beside it. Throws `InputError`.
void readHeld(const std::optional<Source>& keep, const TerrainFiles& files, const Example& example,
              int width, int height, TerrainControl& control, const Progress& progress = {});

/// Holds all points of the example that have data. Throws `InputError` where all have.
void holdData(const Example& example, TerrainControl& control);

/// Where a map has no data, which it then has: smoothly between what lies around.
Grid<std::uint8_t> takeHoles(Grid<float>& heights);
/// Leaves out of a result what comes from holes (of the examples, in their order).
void putHoles(std::span<const Grid<std::uint8_t>> holes, SynthesizedTerrain& made);

}  // namespace exemplar
