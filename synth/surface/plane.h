// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cmath>
#include <numbers>

namespace exemplar::surface {

/// A place in the example's plane, or a step there: samples, or periods (`Lattice`).
struct Vec2d {
  double x = 0, y = 0;

  friend constexpr Vec2d operator+(const Vec2d& a, const Vec2d& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend constexpr Vec2d operator-(const Vec2d& a, const Vec2d& b) {
    return {a.x - b.x, a.y - b.y};
  }
  friend constexpr Vec2d operator-(const Vec2d& a) { return {-a.x, -a.y}; }
  friend constexpr Vec2d operator*(const Vec2d& a, double s) { return {a.x * s, a.y * s}; }
  Vec2d& operator+=(const Vec2d& b) { return *this = *this + b; }
};
inline double length(const Vec2d& a) { return std::hypot(a.x, a.y); }
constexpr double dot(const Vec2d& a, const Vec2d& b) { return a.x * b.x + a.y * b.y; }

/// A linear map of the plane.
struct Mat2d {
  double xx = 1, xy = 0, yx = 0, yy = 1;  ///< rows (xx, xy), (yx, yy)

  constexpr Vec2d operator*(const Vec2d& v) const {
    return {xx * v.x + xy * v.y, yx * v.x + yy * v.y};
  }
  constexpr Mat2d operator*(const Mat2d& b) const {
    return {xx * b.xx + xy * b.yx, xx * b.xy + xy * b.yy, yx * b.xx + yy * b.yx,
            yx * b.xy + yy * b.yy};
  }
  constexpr double determinant() const { return xx * yy - xy * yx; }
  constexpr Mat2d inverse() const {
    const double d = determinant();
    return {yy / d, -xy / d, -yx / d, xx / d};
  }
};

/// Anticlockwise, by `turns` of `symmetry` turns that are once around. Quarter turns are exact.
inline Mat2d rotation(int turns, int symmetry) {
  const int quarter = 4 * turns % symmetry == 0 ? 4 * turns / symmetry : -1;
  if (quarter >= 0) {
    constexpr double cosine[] = {1, 0, -1, 0};
    const double c = cosine[quarter & 3], s = cosine[(quarter + 3) & 3];
    return {c, -s, s, c};
  }
  const double angle = 2 * std::numbers::pi * turns / symmetry;
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}

/// Two steps in the example's plane. Of the first `periods` ones the example repeats.
struct Lattice {
  int periods = 0;
  Vec2d first{1, 0}, second{0, 1};  ///< samples

  Mat2d basis() const { return {first.x, second.x, first.y, second.y}; }
  /// Whether coordinate 0 or 1 counts periods.
  bool periodic(int coordinate) const { return coordinate < periods; }
};

}  // namespace exemplar::surface
