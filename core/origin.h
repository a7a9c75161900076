// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"

namespace exemplar {

/// Where one cell of a result came from: a cell of an example, and how that example was turned.
///
/// Materials, colours and finer detail are pulled through origins; novelty and seams are measured
/// on them. Indices are 16-bit: no side of an example is longer than 32,767 cells.
struct Origin {
  std::int16_t i = 0, j = 0, k = 0;
  std::uint8_t example = 0;  ///< which example, for several examples at once
  std::uint8_t turns = 0;    ///< quarter turns about z, anticlockwise, from example to result: 0..3

  Origin() = default;
  Origin(const Vec3i& cell, int example_ = 0, int turns_ = 0)
      : i(static_cast<std::int16_t>(cell.x)),
        j(static_cast<std::int16_t>(cell.y)),
        k(static_cast<std::int16_t>(cell.z)),
        example(static_cast<std::uint8_t>(example_)),
        turns(static_cast<std::uint8_t>(turns_)) {}

  Vec3i cell() const { return {i, j, k}; }
  bool operator==(const Origin&) const = default;
};

/// One origin for every cell of a result; the same size as the result.
using Origins = Array3D<Origin>;

}  // namespace exemplar
