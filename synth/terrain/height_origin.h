// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "maps/boundary_patches.h"
#include "maps/grid.h"

namespace exemplar {

/// Where a sample of a height map came from: a sample of an example, and how that was turned.
struct HeightOrigin {
  std::int16_t x = 0, y = 0;
  std::uint8_t example = 0;
  std::uint8_t turn = 0;  ///< of `turnedStep`, from example to result: 0..7

  bool operator==(const HeightOrigin&) const = default;
};

/// The symmetry that takes back what `turn` does (`turnedStep`).
constexpr int turnedBackBy(int turn) { return turn < 4 ? (4 - turn) & 3 : turn; }

/// Where the sample one `step` away from one with this origin comes from, if both were copied
/// together.
inline HeightOrigin stepped(const HeightOrigin& origin, Pixel step) {
  const Pixel back = turnedStep(step, turnedBackBy(origin.turn));
  HeightOrigin next = origin;
  next.x = static_cast<std::int16_t>(next.x + back.x);
  next.y = static_cast<std::int16_t>(next.y + back.y);
  return next;
}

}  // namespace exemplar
