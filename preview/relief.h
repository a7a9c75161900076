// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"
#include "mesh/image.h"

namespace exemplar {

/// Heights to show, and the distance of neighboring ones in their unit. NaN cells show as
/// background.
struct ReliefMap {
  const Grid<float>* heights = nullptr;
  double cellSize = 1;
};

struct ReliefOptions {
  /// Where the light comes from, a row of pictures for each: radians clockwise from north (the
  /// top).
  std::vector<double> azimuths{5.497787};  ///< northwest
  double elevation = 0.7;                  ///< of the light above the horizon, radians, 0.05..1.5
  /// What heights are multiplied with before they are lit; 0: so that the first map's slopes are
  /// 0.6 on average (root mean square), and the same for all maps.
  double exaggeration = 0;
  /// Draws the streams that so many cells or more drain through, wider where more do; 0: none.
  std::uint32_t streamCells = 0;
  bool tint = true;    ///< colors by height, from the lowest to the highest of all maps; else gray
  int longest = 1000;  ///< of a map's picture, pixels, 16..16384: the largest map is scaled to it
};

/// Shaded relief: maps seen from above and lit from the side, side by side at one scale, one range
/// of colors and one exaggeration, a row for each light. Maps with more cells than pixels are
/// averaged, others drawn with smooth slopes between their points. Opaque sRGB, three channels.
/// O(pixels) and, with streams, the cost of `drain`. The same bytes at any number of threads.
/// Throws `InputError` for no map, an empty one, options out of range and where memory does not
/// suffice, and `Cancelled`.
Image8 renderRelief(std::span<const ReliefMap> maps, const ReliefOptions& options = {},
                    const Progress& progress = {});

}  // namespace exemplar
