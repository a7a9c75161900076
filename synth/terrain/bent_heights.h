// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maps/grid.h"
#include "synth/terrain/height_pyramid.h"

/// Examples that are turned by any angle and bent: what the layout of a result is made of.
///
/// On coarse resolutions a patch is a good part of an example, so that whatever is put together of
/// patches has the example's mountain chains in it, along the directions in which they run there.
/// Turned and bent ones run elsewhere, and no two of them bend alike; their slopes and profiles
/// stay the example's, for bending keeps areas.
namespace exemplar {

struct Bend {
  double angle = 0;        ///< by which it is turned, from the x axis toward the y axis, radians
  double strain = 0;       ///< by about how much directions change from place to place, radians
  std::uint64_t seed = 0;  ///< how it bends
};

/// Heights on half their resolution, turned and bent; NaN beside what they cover. O(samples).
Grid<float> bentHalf(const Grid<float>& heights, const Bend& bend);
/// Which sample of a map of `size` each one of a turned and bent map comes from; beside what that
/// covers, one that would lie beside the map.
Grid<Pixel> bentPlaces(Pixel size, const Bend& bend);
/// What kind each sample is, as it is `from` a map: 0 beside that.
Grid<std::uint8_t> bentKinds(const Grid<std::uint8_t>& kinds, const Grid<Pixel>& from);

/// The ways in which examples whose patches are used in the orientations `turns` (of `turnedStep`)
/// may be turned and bent: by any angle where they may be turned by quarters; otherwise by no more
/// than keeps the direction of their gradients, and by none where `asTheyAre`.
std::vector<Bend> bendsOf(std::span<const Grid<float>> examples, std::span<const int> turns,
                          bool asTheyAre, std::uint64_t seed);

/// Adds bent copies of the first `examples` sources to the coarsest resolutions of a pyramid, after
/// all others.
void addBentCopies(std::vector<HeightLevel>& pyramid, std::size_t examples,
                   std::span<const Bend> bends);

}  // namespace exemplar
