// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

/// The unbounded plane that worlds are made in, and the windows that it is made by.
namespace exemplar {

/// A column of the plane, or a window's or tile's number along x and y.
struct PlanePoint {
  std::int64_t x = 0, y = 0;
  std::int64_t& operator[](int axis) { return axis == 0 ? x : y; }
  std::int64_t operator[](int axis) const { return axis == 0 ? x : y; }
  auto operator<=>(const PlanePoint&) const = default;
};

/// The columns from `begin` to before `end`.
struct PlaneBox {
  PlanePoint begin, end;

  std::int64_t size(int axis) const { return std::max<std::int64_t>(end[axis] - begin[axis], 0); }
  std::int64_t columns() const { return size(0) * size(1); }
  bool empty() const { return columns() == 0; }
  bool contains(const PlanePoint& p) const {
    return p.x >= begin.x && p.y >= begin.y && p.x < end.x && p.y < end.y;
  }
  bool operator==(const PlaneBox&) const = default;
  friend PlaneBox operator&(const PlaneBox& a, const PlaneBox& b) {
    return {{std::max(a.begin.x, b.begin.x), std::max(a.begin.y, b.begin.y)},
            {std::min(a.end.x, b.end.x), std::min(a.end.y, b.end.y)}};
  }
};

/// The largest whole number that is not above a / b, for b > 0.
constexpr std::int64_t floorDivide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0); }

/// Windows in phases. Phase p = 1..phases cuts the plane into squares of `pitch` columns, shifted
/// along the diagonal by a part of the pitch from phase to phase. A window's *free* columns are
/// those of its square but for the first `separator` ones along x and y; these, and the ones after
/// its end, are its *rim*. In a phase all free columns may change, each window seeing nothing but
/// itself and its rim as the phase before left them, so that windows of one phase can be made in
/// any order, at once, or alone.
///
/// Squares of different phases share no sides, so with three phases every column is free in one at
/// least: it lies beside a side across x in one phase at most, and beside one across y in another.
/// Half shifts along each axis (Merrell 2007; BorisTheBrave, "Infinite modifying in blocks", 2021)
/// need four phases for that.
struct WindowLattice {
  int pitch = 36;     ///< columns, >= 3 * (separator + 1)
  int separator = 1;  ///< columns, >= 1: how far apart columns are that speak of each other
  static constexpr int phases = 3;

  /// Where the square of window 0 begins, along both axes; 0 in the last phase.
  std::int64_t shift(int phase) const { return std::int64_t{phase - phases} * pitch / phases; }
  PlaneBox free(int phase, const PlanePoint& window) const;
  /// Free columns and rim.
  PlaneBox whole(int phase, const PlanePoint& window) const;
  /// The windows whose squares meet a box, x outermost.
  std::vector<PlanePoint> touching(int phase, const PlaneBox& box) const;
};

}  // namespace exemplar
