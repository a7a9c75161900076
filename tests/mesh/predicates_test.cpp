// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/random.h"

namespace exemplar {
namespace {

__extension__ typedef __int128 Int;
struct Point {
  std::array<std::int64_t, 3> c;
};

/// The determinant behind `orientation` in whole numbers: exact for coordinates below 2^38.
Int exactDeterminant(const Point& a, const Point& b, const Point& c, const Point& d) {
  Int m[3][3];
  const Point* rows[] = {&b, &c, &d};
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k) m[r][k] = rows[r]->c[k] - a.c[k];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
int sign(Int x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

Vec3d toVec(const Point& p, double scale = 1) {
  return Vec3d{static_cast<double>(p.c[0]), static_cast<double>(p.c[1]),
               static_cast<double>(p.c[2])} *
         scale;
}

Point randomPoint(const Random& random, std::uint64_t cell, std::int64_t range) {
  Point p;
  for (std::uint32_t k = 0; k < 3; ++k) {
    p.c[k] = static_cast<std::int64_t>(
                 random.below(static_cast<std::uint32_t>(2 * range + 1), cell, k)) -
             range;
  }
  return p;
}

TEST(Orientation, IsPositiveWhereTheTriangleRunsCounterclockwise) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(orientation(a, b, c, {0.2, 0.2, 1}), 1);
  EXPECT_EQ(orientation(a, b, c, {0.2, 0.2, -1}), -1);
  EXPECT_EQ(orientation(a, b, c, {5, -7, 0}), 0);
}

TEST(Orientation, AgreesWithWholeNumbers) {
  const Random random(1);
  int zeros = 0;
  for (std::uint64_t trial = 0; trial < 200000; ++trial) {
    // Small ranges give many points in one plane, large ones many rounded products.
    const std::int64_t range = trial % 2 == 0 ? 3 : 1 << 30;
    std::array<Point, 4> p;
    for (std::uint64_t i = 0; i < 4; ++i) p[i] = randomPoint(random, 4 * trial + i, range);
    const int expected = sign(exactDeterminant(p[0], p[1], p[2], p[3]));
    zeros += expected == 0;
    ASSERT_EQ(orientation(toVec(p[0]), toVec(p[1]), toVec(p[2]), toVec(p[3])), expected) << trial;
  }
  EXPECT_GT(zeros, 1000);
}

TEST(Orientation, IsExactForPointsNextToAPlaneWhereRoundingIsNot) {
  // d is a combination of a, b and c, moved by one unit in 2^36: plain doubles lose it.
  const Random random(2);
  int plainIsWrong = 0;
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    std::array<Point, 4> p;
    for (std::uint64_t i = 0; i < 3; ++i)
      p[i] = randomPoint(random, 4 * trial + i, std::int64_t{1} << 30);
    for (int k = 0; k < 3; ++k) p[3].c[k] = 17 * p[0].c[k] - 9 * p[1].c[k] - 7 * p[2].c[k];
    p[3].c[trial % 3] += static_cast<std::int64_t>(trial % 3) - 1;
    const int expected = sign(exactDeterminant(p[0], p[1], p[2], p[3]));
    const Vec3d a = toVec(p[0], 0x1p-20), b = toVec(p[1], 0x1p-20), c = toVec(p[2], 0x1p-20),
                d = toVec(p[3], 0x1p-20);
    ASSERT_EQ(orientation(a, b, c, d), expected) << trial;
    const double plain = dot(d - a, cross(b - a, c - a));
    plainIsWrong += (plain > 0) - (plain < 0) != expected;
  }
  EXPECT_GT(plainIsWrong, 100) << "else this test would pass without exact arithmetic";
}

/// Whether two triangles with whole coordinates cross, by fractions: the pieces of the line that
/// their planes have in common, compared along an axis.
bool crossByFractions(const std::array<Point, 3>& first, const std::array<Point, 3>& second) {
  struct Fraction {
    Int numerator, denominator;  // the denominator is positive
  };
  const auto less = [](const Fraction& a, const Fraction& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  };
  // The piece of t between its crossings with the plane of `plane`, along `axis`.
  const auto piece = [&](const std::array<Point, 3>& t, const std::array<Point, 3>& plane, int axis,
                         Fraction& low, Fraction& high) {
    Int side[3];
    for (int i = 0; i < 3; ++i) side[i] = exactDeterminant(plane[0], plane[1], plane[2], t[i]);
    if (std::max({side[0], side[1], side[2]}) <= 0 || std::min({side[0], side[1], side[2]}) >= 0)
      return false;
    std::vector<Fraction> ends;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if (side[i] == 0) ends.push_back({t[i].c[axis], 1});
      if (sign(side[i]) * sign(side[j]) >= 0) continue;
      const Int up = t[i].c[axis] * side[j] - t[j].c[axis] * side[i], down = side[j] - side[i];
      ends.push_back(down > 0 ? Fraction{up, down} : Fraction{-up, -down});
    }
    low = *std::min_element(ends.begin(), ends.end(), less);
    high = *std::max_element(ends.begin(), ends.end(), less);
    return true;
  };
  // Along an axis that is not across the common line; the other two would do as well.
  const auto normal = [](const std::array<Point, 3>& t) {
    const auto e = [&](int i, int k) { return t[i].c[k] - t[0].c[k]; };
    return std::array<std::int64_t, 3>{e(1, 1) * e(2, 2) - e(1, 2) * e(2, 1),
                                       e(1, 2) * e(2, 0) - e(1, 0) * e(2, 2),
                                       e(1, 0) * e(2, 1) - e(1, 1) * e(2, 0)};
  };
  const auto n = normal(first), m = normal(second);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (n[u] * m[v] == n[v] * m[u]) continue;
    Fraction low1, high1, low2, high2;
    if (!piece(first, second, axis, low1, high1) || !piece(second, first, axis, low2, high2))
      return false;
    return less(low1, high2) && less(low2, high1);
  }
  return false;
}

TEST(TrianglesCross, AgreesWithFractions) {
  const Random random(3);
  int crossing = 0, touching = 0;
  for (std::uint64_t trial = 0; trial < 100000; ++trial) {
    const std::int64_t range = trial % 2 == 0 ? 2 : 40;
    std::array<Point, 3> first, second;
    for (std::uint64_t i = 0; i < 3; ++i) {
      first[i] = randomPoint(random, 6 * trial + i, range);
      second[i] = randomPoint(random, 6 * trial + 3 + i, range);
    }
    const bool expected = crossByFractions(first, second);
    crossing += expected;
    for (int i = 0; i < 3; ++i)
      touching += exactDeterminant(first[0], first[1], first[2], second[i]) == 0;
    const Vec3d b[3] = {toVec(second[0]), toVec(second[1]), toVec(second[2])};
    const Vec3d a[3] = {toVec(first[0]), toVec(first[1]), toVec(first[2])};
    ASSERT_EQ(trianglesCross(a, b), expected) << trial;
    ASSERT_EQ(trianglesCross(b, a), expected) << trial;
  }
  EXPECT_GT(crossing, 5000);
  EXPECT_GT(touching, 5000);
}

TEST(TrianglesCross, TouchingAndCoplanarTrianglesDoNot) {
  const Vec3d floor[3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Vec3d standing[3] = {{1, 1, 0}, {2, 1, 0}, {1, 1, 3}};        // an edge on the floor
  const Vec3d onTip[3] = {{1, 1, 0}, {2, 1, 3}, {1, 2, 3}};           // a corner on the floor
  const Vec3d flat[3] = {{1, 1, 0}, {5, 1, 0}, {1, 5, 0}};            // overlaps in the plane
  const Vec3d neighbor[3] = {{4, 0, 0}, {0, 0, 0}, {0, -4, 1}};       // along an edge
  const Vec3d sunk[3] = {{1, 1, -0.001}, {2, 1, -0.001}, {1, 1, 3}};  // through the floor
  EXPECT_FALSE(trianglesCross(floor, standing));
  EXPECT_FALSE(trianglesCross(floor, onTip));
  EXPECT_FALSE(trianglesCross(floor, flat));
  EXPECT_FALSE(trianglesCross(floor, neighbor));
  EXPECT_FALSE(trianglesCross(floor, floor));
  EXPECT_TRUE(trianglesCross(floor, sunk));
}

}  // namespace
}  // namespace exemplar
