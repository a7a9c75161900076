// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/origin.h"
#include "core/vec.h"

namespace exemplar {

/// `v` turned by quarter turns about z, anticlockwise seen from above; negative turns go back.
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

}  // namespace exemplar
