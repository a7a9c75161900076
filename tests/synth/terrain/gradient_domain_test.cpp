// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/gradient_domain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/synth/terrain/height_samples.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::noise;
using testing::ridges;

HeightSteps2D stepsOf(const Grid<float>& heights) {
  const int width = heights.width(), height = heights.height();
  HeightSteps2D steps{Grid<float>(width, height), Grid<float>(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      steps.right(x, y) = heights((x + 1) % width, y) - heights(x, y);
      steps.down(x, y) = heights(x, (y + 1) % height) - heights(x, y);
    }
  }
  return steps;
}

/// How far the steps of heights are from what they should be, root mean square.
double misfit(const Grid<float>& heights, const HeightSteps2D& steps, bool wraps) {
  const HeightSteps2D taken = stepsOf(heights);
  double sum = 0;
  int count = 0;
  for (int y = 0; y < heights.height(); ++y) {
    for (int x = 0; x < heights.width(); ++x) {
      if (wraps || x + 1 < heights.width())
        sum += std::pow(taken.right(x, y) - steps.right(x, y), 2), ++count;
      if (wraps || y + 1 < heights.height())
        sum += std::pow(taken.down(x, y) - steps.down(x, y), 2), ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(FollowSteps, FindsHeightsThatHaveTheSteps) {
  for (const bool wraps : {false, true}) {
    for (const int width : {64, 61}) {
      const Grid<float> wanted = ridges(width, 48, 3);
      const HeightSteps2D steps = stepsOf(wanted);
      Grid<float> heights(width, 48, 500.0f);
      const double before = misfit(heights, steps, wraps);
      followSteps(heights, steps, {},
                  {.screen = 1e-6, .cycles = 12, .wrapsX = wraps, .wrapsY = wraps});
      // Twelve cycles of a factor of ten at best, three at the worst; floats hold 1e-4 of 500.
      EXPECT_LT(misfit(heights, steps, wraps), 2e-3 * before) << width << wraps;
    }
  }
}

TEST(FollowSteps, MinimizesWhatItSays) {
  // No step of the heights that is tried makes the sum of squares smaller.
  const Grid<float> start = noise(24, 20, 1);
  const HeightSteps2D steps{noise(24, 20, 2), noise(24, 20, 3)};
  constexpr double kScreen = 0.05;
  const auto energy = [&](const Grid<float>& h) {
    double sum = 0;
    for (int y = 0; y < h.height(); ++y) {
      for (int x = 0; x < h.width(); ++x) {
        if (x + 1 < h.width()) sum += std::pow(h(x + 1, y) - h(x, y) - steps.right(x, y), 2);
        if (y + 1 < h.height()) sum += std::pow(h(x, y + 1) - h(x, y) - steps.down(x, y), 2);
        sum += kScreen * std::pow(h(x, y) - start(x, y), 2);
      }
    }
    return sum;
  };
  Grid<float> heights = start;
  followSteps(heights, steps, {}, {.screen = kScreen, .cycles = 12});
  const double least = energy(heights);
  EXPECT_LT(least, energy(start));
  for (std::size_t s = 0; s < heights.count(); s += 7) {
    for (const float by : {-0.01f, 0.01f}) {
      Grid<float> other = heights;
      other[s] += by;
      EXPECT_GT(energy(other), least) << s;
    }
  }
}

TEST(FollowSteps, LeavesHeldSamplesToTheBit) {
  const Grid<float> start = ridges(40, 40, 5);
  Grid<float> hold(40, 40), heights = start;
  for (int y = 10; y < 20; ++y)
    for (int x = 5; x < 30; ++x) hold(x, y) = x < 25 ? 1.0f : 0.5f;
  followSteps(heights, {Grid<float>(40, 40), Grid<float>(40, 40)}, hold, {.screen = 1e-3});
  double moved = 0, half = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (hold(x, y) == 1) {
        ASSERT_EQ(heights(x, y), start(x, y));
      } else if (hold(x, y) > 0) {
        half += std::abs(heights(x, y) - start(x, y)) / 50;
      } else {
        moved += std::abs(heights(x, y) - start(x, y)) / 1350;
      }
    }
  }
  EXPECT_GT(moved, 10);
  EXPECT_LT(half, 0.1 * moved);
}

TEST(FollowSteps, GivesTheSameBytesAtAnyNumberOfThreads) {
  for (const int height : {96, 97}) {
    testing::expectSameAtAnyThreads([&] {
      Grid<float> heights = ridges(300, height, 7);
      followSteps(heights, {noise(300, height, 1), noise(300, height, 2)}, {},
                  {.wrapsX = true, .wrapsY = true});
      return heights;
    });
  }
}

}  // namespace
}  // namespace exemplar
