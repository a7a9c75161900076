// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/triangle_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

const Corners kFlat{Vec3d{0, 0, 0}, Vec3d{4, 0, 0}, Vec3d{0, 4, 0}};

// In any order of the two and of their corners.
bool overlap(Corners a, Corners b) {
  const bool first = trianglesOverlap(a, b);
  for (int turn = 0; turn < 3; ++turn) {
    std::rotate(a.begin(), a.begin() + 1, a.end());
    EXPECT_EQ(trianglesOverlap(a, b), first);
    EXPECT_EQ(trianglesOverlap(b, a), first);
    std::swap(b[0], b[1]);
  }
  return first;
}

TEST(TrianglesOverlap, WhereTheyCross) {
  EXPECT_TRUE(overlap(kFlat, {Vec3d{1, 1, -1}, Vec3d{1, 1, 1}, Vec3d{2, 1, 1}}));
  EXPECT_TRUE(overlap(kFlat, {Vec3d{-1, 1, -1}, Vec3d{5, 1, -1}, Vec3d{2, 1, 5}}));
  EXPECT_FALSE(overlap(kFlat, {Vec3d{5, 1, -1}, Vec3d{5, 1, 1}, Vec3d{6, 1, 1}}));
  EXPECT_FALSE(overlap(kFlat, {Vec3d{1, 1, 0.5}, Vec3d{1, 1, 1}, Vec3d{2, 1, 1}}));
  // Boxes meet, the triangles do not: beyond the long side.
  EXPECT_FALSE(overlap(kFlat, {Vec3d{3, 3, -1}, Vec3d{3, 3, 1}, Vec3d{3.5, 3.5, 1}}));
}

TEST(TrianglesOverlap, WhereTheyLieOnEachOther) {
  EXPECT_TRUE(overlap(kFlat, {Vec3d{1, 1, 0}, Vec3d{2, 1, 0}, Vec3d{1, 2, 0}}));
  EXPECT_TRUE(overlap(kFlat, kFlat));
  EXPECT_TRUE(overlap(kFlat, {Vec3d{-1, 1, 0}, Vec3d{5, 1, 0}, Vec3d{2, -5, 0}}));
  EXPECT_FALSE(overlap(kFlat, {Vec3d{5, 5, 0}, Vec3d{6, 5, 0}, Vec3d{5, 6, 0}}));
  EXPECT_FALSE(overlap(kFlat, {Vec3d{1, 1, 1e-3}, Vec3d{2, 1, 1e-3}, Vec3d{1, 2, 1e-3}}));
}

TEST(TrianglesMeet, WhereOneStandsOnTheOtherOrTouchesItsRim) {
  EXPECT_TRUE(
      trianglesMeet(kFlat, {Vec3d{1, 1, 0}, Vec3d{1, 1, 3}, Vec3d{2, 1, 3}}));  // on a corner
  EXPECT_TRUE(trianglesMeet(kFlat, {Vec3d{1, 1, 0}, Vec3d{2, 1, 0}, Vec3d{1, 1, 3}}));  // on a side
  EXPECT_TRUE(trianglesMeet(kFlat, {Vec3d{3, 0, 0}, Vec3d{1, 0, 0}, Vec3d{2, -3, 0}}));  // edges
  EXPECT_TRUE(trianglesMeet(kFlat, {Vec3d{4, 0, 0}, Vec3d{6, 0, 3}, Vec3d{6, -1, 3}}));  // corners
  EXPECT_FALSE(trianglesMeet(kFlat, {Vec3d{4, 0, 1e-6}, Vec3d{6, 0, 3}, Vec3d{6, -1, 3}}));
  EXPECT_FALSE(trianglesMeet(kFlat, {Vec3d{4, -1e-6, 0}, Vec3d{6, -2, 3}, Vec3d{6, -1, 3}}));
}

TEST(TrianglesOverlap, NotWhereOnlyRimsTouch) {
  // A shared edge, in one plane and across a fold.
  EXPECT_FALSE(overlap(kFlat, {Vec3d{4, 0, 0}, Vec3d{0, 0, 0}, Vec3d{2, -3, 0}}));
  EXPECT_FALSE(overlap(kFlat, {Vec3d{4, 0, 0}, Vec3d{0, 0, 0}, Vec3d{2, -3, 1}}));
  // A shared corner.
  EXPECT_FALSE(overlap(kFlat, {Vec3d{4, 0, 0}, Vec3d{6, 1, 0}, Vec3d{6, -1, 1}}));
  EXPECT_FALSE(overlap(kFlat, {Vec3d{4, 0, 0}, Vec3d{6, 0, 3}, Vec3d{6, -1, 3}}));
  // Part of an edge.
  EXPECT_FALSE(overlap(kFlat, {Vec3d{3, 0, 0}, Vec3d{1, 0, 0}, Vec3d{2, -3, 0}}));
}

TEST(TrianglesOverlap, AgreesWithSamplingOnRandomTriangles) {
  // Points of one that lie within the other's prism on both sides of its plane prove a crossing.
  const Random random(2);
  int crossing = 0, apart = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Corners a, b;
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis) {
        a[c][axis] = random.uniform(trial, 3 * c + axis);
        b[c][axis] = random.uniform(trial, 9 + 3 * c + axis);
      }
    double nearest = 1e9;
    constexpr int n = 120;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vec3d q = b[0] + (b[1] - b[0]) * (double(i) / n) + (b[2] - b[0]) * (double(j) / n);
        nearest = std::min(nearest, squaredDistance(q, a));
      }
    nearest = std::sqrt(nearest);
    const bool answer = overlap(a, b);
    EXPECT_EQ(trianglesMeet(a, b), answer);  // no two random ones only touch
    // Samples are up to 1.7 / 120 from any point of b.
    if (nearest > 0.03) {
      EXPECT_FALSE(answer);
      ++apart;
    } else if (answer) {
      EXPECT_LT(nearest, 0.03);
      ++crossing;
    }
  }
  EXPECT_GT(crossing, 50);
  EXPECT_GT(apart, 50);
}

}  // namespace
}  // namespace exemplar
