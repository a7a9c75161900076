// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/vec.h"

namespace exemplar {

/// Where one cell of a result came from: a cell of an example, and how that example was turned.
///
/// Materials, colors and finer detail are pulled through origins; novelty and seams are measured
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

// Turning: quarter turns about z, anticlockwise seen from above; negative turns go back.

/// A direction or a point, turned about the origin of its coordinates.
template <class T>
constexpr Vec3<T> turned(const Vec3<T>& v, int turns) {
  switch (turns & 3) {
    case 1:
      return {T(-v.y), v.x, v.z};
    case 2:
      return {T(-v.x), T(-v.y), v.z};
    case 3:
      return {v.y, T(-v.x), v.z};
    default:
      return v;
  }
}

/// The size of a grid of `size` when it is turned.
constexpr Vec3i turnedSize(const Vec3i& size, int turns) {
  return turns % 2 ? Vec3i{size.y, size.x, size.z} : size;
}

/// Where a cell of a grid of `size` is in the turned grid.
constexpr Vec3i turnedCell(const Vec3i& cell, const Vec3i& size, int turns) {
  switch (turns & 3) {
    case 1:
      return {size.y - 1 - cell.y, cell.x, cell.z};
    case 2:
      return {size.x - 1 - cell.x, size.y - 1 - cell.y, cell.z};
    case 3:
      return {cell.y, size.x - 1 - cell.x, cell.z};
    default:
      return cell;
  }
}

/// A grid turned; its values only change places.
template <class T>
Array3D<T> turnedGrid(const Array3D<T>& grid, int turns) {
  Array3D<T> result(turnedSize(grid.size(), turns));
  for (std::size_t s = 0; s < result.count(); ++s) {
    result.values()[s] = grid[turnedCell(result.ijk(s), result.size(), -turns)];
  }
  return result;
}

// Offsets: what neighboring cells of a result that were copied together have in common.

/// What a step in the result is in its example: turned back by the quarter turns of `origin`.
inline Vec3i turnedBack(const Vec3i& step, const Origin& origin) {
  return turned(step, -int{origin.turns});
}

/// Whether b, one `step` away from a in the result, is also where a's source goes on: the same
/// example and turns, and cells that differ as the result's do.
inline bool continues(const Origin& a, const Origin& b, const Vec3i& step) {
  return a.example == b.example && a.turns == b.turns && b.cell() - a.cell() == turnedBack(step, a);
}

/// The rigid motion that an origin stands for: which example, how it was turned and how it was
/// shifted. All cells of one copied part share one motion; where it changes there is a seam.
struct OriginMotion {
  std::uint8_t example = 0, turns = 0;
  Vec3i shift{};  ///< example cell = cell turned back + shift

  OriginMotion() = default;
  OriginMotion(const Origin& origin, const Vec3i& cell)
      : example(origin.example),
        turns(origin.turns),
        shift(origin.cell() - turned(cell, -int{origin.turns})) {}

  /// The example's index, fractional, of an index of the result.
  Vec3d toExample(const Vec3d& index) const {
    return turned(index, -int{turns}) + cast<double>(shift);
  }
  Vec3i toExample(const Vec3i& cell) const { return turned(cell, -int{turns}) + shift; }
  /// The result's index of an index of the example.
  Vec3d toResult(const Vec3d& index) const { return turned(index - cast<double>(shift), turns); }
  /// Directions, both ways.
  Vec3d directionToExample(const Vec3d& d) const { return turned(d, -int{turns}); }
  Vec3d directionToResult(const Vec3d& d) const { return turned(d, turns); }

  bool operator==(const OriginMotion&) const = default;
  /// A total order, for sorting.
  bool operator<(const OriginMotion& b) const {
    if (example != b.example) return example < b.example;
    if (turns != b.turns) return turns < b.turns;
    if (shift.z != b.shift.z) return shift.z < b.shift.z;
    if (shift.y != b.shift.y) return shift.y < b.shift.y;
    return shift.x < b.shift.x;
  }
};

/// The motion of a cell of a result.
inline OriginMotion motionAt(const Origins& origins, const Vec3i& cell) {
  return {origins[cell], cell};
}

// Composition: a result of a result.

/// The origin of what was copied from `outer.cell()` of a result whose origin there is `inner`.
inline Origin composed(const Origin& outer, const Origin& inner) {
  return Origin(inner.cell(), inner.example, (inner.turns + outer.turns) & 3);
}

}  // namespace exemplar
