// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/bent_heights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "maps/halved.h"
#include "synth/terrain/gradient_direction.h"
#include "tests/synth/terrain/height_samples.h"

namespace exemplar {
namespace {

using testing::ridges;

constexpr double kQuarter = std::numbers::pi / 2;

std::size_t known(const Grid<float>& heights) {
  std::size_t count = 0;
  for (const float h : heights.values()) count += !std::isnan(h);
  return count;
}

TEST(BentHeights, WithoutAngleAndStrainAreTheMeans) {
  const Grid<float> heights = ridges(64, 48, 1);
  const Grid<float> half = halved(heights, false), bent = bentHalf(heights, {});
  ASSERT_TRUE(bent.sameSize(half));
  // The mean of four places between samples is their mean as far as heights are linear; curvature
  // and the border, where nothing lies beyond, make the rest.
  for (int y = 1; y + 1 < half.height(); ++y)
    for (int x = 1; x + 1 < half.width(); ++x) ASSERT_NEAR(bent(x, y), half(x, y), 12);
}

TEST(BentHeights, TurnByAQuarterLikeTheSymmetry) {
  const Grid<float> heights = ridges(64, 48, 2);
  const Grid<float> plain = bentHalf(heights, {}), turned = bentHalf(heights, {.angle = kQuarter});
  const auto width = static_cast<double>(turned.width()),
             height = static_cast<double>(turned.height());
  EXPECT_NEAR(width, plain.height(), 1);
  EXPECT_NEAR(height, plain.width(), 1);
  int same = 0, all = 0;
  for (int y = 2; y + 2 < plain.height(); ++y) {
    for (int x = 2; x + 2 < plain.width(); ++x) {
      // A step along x becomes one along y.
      const float there = turned(turned.width() - 1 - y, x);
      ++all;
      same += std::abs(there - plain(x, y)) < 60;
    }
  }
  EXPECT_GT(same, 0.9 * all);
}

TEST(BentHeights, TurnTheDirectionOfASlope) {
  Grid<float> ramp(200, 200);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) ramp(x, y) = static_cast<float>(10 * x);
  for (const double angle : {0.3, 0.8, 1.2}) {
    const Grid<float> bent = bentHalf(ramp, {.angle = angle});
    const int c = bent.width() / 2, r = bent.height() / 2;
    const double dx = bent(c + 1, r) - bent(c - 1, r), dy = bent(c, r + 1) - bent(c, r - 1);
    EXPECT_NEAR(std::atan2(dy, dx), angle, 1e-3);
    EXPECT_NEAR(std::hypot(dx, dy), 40, 0.1);
  }
}

TEST(BentHeights, BendingKeepsAreasAndSlopesNearly) {
  Grid<float> ramp(256, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) ramp(x, y) = static_cast<float>(10 * x);
  const Grid<float> bent = bentHalf(ramp, {.angle = 0.7, .strain = 0.35, .seed = 3});
  // What falls beside the map at one place is made up for at others.
  EXPECT_NEAR(static_cast<double>(known(bent)), 128.0 * 128, 0.05 * 128 * 128);
  double sum = 0, squares = 0, angles = 0;
  int count = 0;
  for (int y = 1; y + 1 < bent.height(); ++y) {
    for (int x = 1; x + 1 < bent.width(); ++x) {
      const double dx = (bent(x + 1, y) - bent(x - 1, y)) / 2;
      const double dy = (bent(x, y + 1) - bent(x, y - 1)) / 2;
      if (std::isnan(dx) || std::isnan(dy)) continue;
      sum += std::hypot(dx, dy);
      const double turned = std::atan2(dy, dx) - 0.7;
      angles += turned;
      squares += turned * turned;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 20, 3);
  const double mean = angles / count, spread = std::sqrt(squares / count - mean * mean);
  EXPECT_GT(spread, 0.1);  // it does bend
  EXPECT_LT(spread, 0.7);
}

TEST(BentHeights, KeepHolesAndKinds) {
  Grid<float> heights = ridges(80, 80, 4);
  Grid<std::uint8_t> kinds(40, 40);
  for (int y = 30; y < 50; ++y)
    for (int x = 30; x < 50; ++x) heights(x, y) = std::numeric_limits<float>::quiet_NaN();
  for (int y = 15; y < 25; ++y)
    for (int x = 15; x < 25; ++x) kinds(x, y) = 1;
  const Bend bend{.angle = 0.5, .strain = 0.2, .seed = 9};
  const Grid<float> bent = bentHalf(heights, bend);
  const Grid<std::uint8_t> where = bentKinds(kinds, bentPlaces({40, 40}, bend));
  ASSERT_TRUE(bent.sameSize(where));
  std::size_t marked = 0;
  for (std::size_t s = 0; s < bent.count(); ++s) {
    if (!where[s]) continue;
    ++marked;
    EXPECT_TRUE(std::isnan(bent[s]));
  }
  EXPECT_NEAR(static_cast<double>(marked), 100, 15);
}

TEST(BentHeights, AreTurnedByAnyAngleWhereLandHasNoDirection) {
  const std::vector<int> all{0, 1, 2, 3, 4, 5, 6, 7}, halves{0, 2};
  const Grid<float> without = ridges(128, 128, 12), directed = ridges(128, 128, 12, 5);
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    double last = 0;
    for (const Bend& bend : bendsOf({&without, 1}, all, false, seed)) {
      // Neither along the axes nor twice about the same.
      EXPECT_GT(bend.angle, last + 0.1);
      EXPECT_LT(bend.angle, kQuarter - 0.1);
      last = bend.angle;
    }
    for (const Bend& bend : bendsOf({&directed, 1}, halves, false, seed)) {
      EXPECT_LE(std::abs(bend.angle), greatestTurn({&directed, 1}));
      EXPECT_LE(std::abs(bend.angle), 0.5);
    }
    for (const Bend& bend : bendsOf({&directed, 1}, halves, true, seed)) EXPECT_EQ(bend.angle, 0);
  }
}

}  // namespace
}  // namespace exemplar
