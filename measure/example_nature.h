// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>

#include "core/axes.h"
#include "core/cells.h"
#include "measure/occupancy.h"

namespace exemplar {

/// What lies at one side of an example's box.
enum class BoxSide {
  Air,   ///< no solid: whatever is there ends before the box does
  Cut,   ///< solid and air: the box cuts it out of something that goes on
  Solid  ///< all solid, as below ground
};

/// What kind of thing an example is, from its solid alone.
struct ExampleNature {
  Vec3i size{};
  double solidShare = 0;            ///< 0..1
  CellBox solid;                    ///< the smallest box that holds all of its solid
  std::array<BoxSide, 6> sides{};   ///< -x, +x, -y, +y, -z, +z
  std::array<double, 6> atSides{};  ///< the solid share of the outermost layer there, 0..1
  /// Solid shares of the four quarters along each axis.
  std::array<std::array<double, 4>, 3> quarters{};
  /// How far the quarters' shares are apart, over the solid's share or the air's, whichever is
  /// less; 0 where all are alike.
  std::array<double, 3> spread{};

  /// Along which axes it fills its box as evenly as a material does: cut at both sides, by layers
  /// about as full as the rest, and with quarters alike. What leaves the box at one side may then
  /// come in at the other: a rolled example is as good a sample of the material as another.
  Axes fillsEvenly;

  /// Air on all sides, but for the ground that it may stand on.
  bool freeStanding() const;
};

/// O(cells). The same at any number of threads.
ExampleNature natureOf(const Occupancy& example);

}  // namespace exemplar
