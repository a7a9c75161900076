// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"
#include "synth/terrain/height_origin.h"

/// Where water stands: lakes and the sea, which are flat, and hollows.
namespace exemplar {

/// What is water of an example.
inline constexpr std::uint8_t kLand = 0, kLake = 1, kSea = 2;

/// The flat water of a height map: connected samples (of four neighbors) of one height, at least 32
/// of them, beside which next to nothing is lower, as a terrace's or a plain's would be. It is the
/// sea where it has the map's lowest height, and some of that height comes to its border.
Grid<std::uint8_t> flatWater(const Grid<float>& heights);
/// The same on half the resolution: where half of the samples are water, or more.
Grid<std::uint8_t> halvedWater(const Grid<std::uint8_t>& water);

/// Bodies of water of a result: 0 for land, 1 for the sea, and each lake a number of its own.
inline constexpr std::uint32_t kSeaBody = 1, kFirstLake = 2;
struct WaterBodies {
  Grid<std::uint32_t> bodies;
  std::uint32_t count = kFirstLake;  ///< one more than the largest number
  Grid<float> before;                ///< the heights before they were settled; may be empty
};
/// Makes flat what comes from water: lakes at a height that most of them reach, the sea at
/// `seaLevel`, under which no land lies either. The sea comes to the map's border, or is where it
/// lies, if it may be `inland`, as on a torus; other sea is lakes. Bodies of less than `least`
/// samples become land, and so do single samples at shores. Samples that are `held` (may be empty)
/// stay as they are and are land.
WaterBodies settleWater(Grid<float>& heights, const Grid<HeightOrigin>& origins,
                        std::span<const Grid<std::uint8_t>> water,
                        const std::optional<float>& seaLevel, const Grid<std::uint8_t>& held,
                        std::size_t least, bool inland = false);

/// The hollows of height maps, of which a result keeps as many.
struct Hollows {
  double share = 0;  ///< of the samples, below where they spill over
  /// The same by size: in those of 1 sample, of 2 or 3, of 4 to 7, ...
  std::vector<double> bySize;
};
/// Of maps, on `levels` (>= 1) resolutions, the finest first: coarser ones have those that cover
/// half of a sample or more. What lies low there beside them is no hollow: means over samples close
/// the narrow ways by which it drains.
std::vector<Hollows> hollowsOf(std::span<const Grid<float>> maps, int levels = 1,
                               const Progress& progress = {});

}  // namespace exemplar
