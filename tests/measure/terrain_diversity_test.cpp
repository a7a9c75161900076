// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/terrain_diversity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/measure/land.h"

namespace exemplar {
namespace {

using testing::land;

TerrainDistance between(const Grid<float>& a, const Grid<float>& b) {
  return distanceBetween(TerrainLayout(a), TerrainLayout(b));
}

/// Moved around, and then turned by a quarter and mirrored.
Grid<float> moved(const Grid<float>& heights, int dx, int dy, bool turn) {
  const int n = heights.width();
  Grid<float> result(n, n);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const float h = heights((x + dx) % n, (y + dy) % n);
      turn ? result(y, x) = h : result(x, y) = h;
    }
  }
  return result;
}

TEST(TerrainDistance, OfACopyIsZeroHoweverItIsMovedOrTurned) {
  const Grid<float> some = land(128, 128, 1);
  EXPECT_NEAR(between(some, some).plain, 0, 1e-6);
  EXPECT_NEAR(between(some, some).moved, 0, 1e-5);
  for (const bool turn : {false, true}) {
    const TerrainDistance distance = between(some, moved(some, 40, 22, turn));
    EXPECT_GT(distance.plain, 0.7);
    // What was its border lies inside, and the other way round.
    EXPECT_LT(distance.moved, 0.25);
  }
}

TEST(TerrainDistance, OfIndependentLandIsLarge) {
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    const TerrainDistance distance = between(land(128, 128, seed), land(128, 128, seed + 10));
    EXPECT_NEAR(distance.plain, 1, 0.25);
    EXPECT_GT(distance.moved, 0.5);
  }
  const Grid<float> wide = land(200, 90, 3);
  EXPECT_NEAR(between(wide, wide).moved, 0, 1e-5);
  EXPECT_GT(between(wide, land(200, 90, 4)).moved, 0.5);
}

TEST(TerrainDistance, OfOtherSizesAndOfOneHeightIsOne) {
  const Grid<float> some = land(96, 96, 1), flat(96, 96, 1000.3f);
  EXPECT_EQ(between(some, land(128, 96, 1)).moved, 1);
  EXPECT_EQ(between(some, flat).plain, 1);
  EXPECT_EQ(between(flat, flat).moved, 1);
}

}  // namespace
}  // namespace exemplar
