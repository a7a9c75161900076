// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "mesh/image.h"

namespace exemplar {

/// Heights as a picture from above needs them: rows from the top, `heights[row * width + column]`.
struct ReliefHeights {
  int width = 0, height = 0;
  std::span<const float> heights;  ///< NaN where there is no data
  double cellSize = 1;             ///< distance of neighboring heights, in their unit; > 0
  /// 1 where there is a stream or a lake, drawn in blue; one for each height, or empty.
  std::span<const std::uint8_t> water = {};
};

struct ReliefOptions {
  /// Where the light comes from, radians clockwise from the top of the picture: from the top left.
  double azimuth = -0.785398;
  double altitude = 0.785398;  ///< of the light above the ground, radians, above 0 to pi / 2
  double exaggeration = 1;     ///< of heights, > 0
  /// The heights that are tinted as lowest and highest: pictures with the same ones compare.
  double lowest = 0, highest = 1;
};

/// Shaded relief: what faces the light is bright, tinted by height from green to white. One pixel a
/// height. Areas without data are gray.
Image8 shadedRelief(const ReliefHeights& map, const ReliefOptions& options);

/// The exaggeration with which steep ground of a map (steeper than nine tenths of it) is at
/// about 40 degrees: 1 in mountains.
double reliefExaggeration(const ReliefHeights& map);

}  // namespace exemplar
