// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/height_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "maps/drainage.h"
#include "synth/terrain/outlets.h"
#include "tests/grid_share.h"
#include "tests/synth/terrain/height_samples.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::onThreads;
using testing::ridges;

constexpr int kPitch = 64;
/// Two windows along x and most of two along y, from somewhere.
constexpr PlaneBox kBox{{-28, 20}, {108, 128}};

const std::vector<Grid<float>>& examples() {
  // Land without hollows, or the world would have as many.
  static const std::vector<Grid<float>> list = [] {
    Grid<float> land = ridges(96, 96, 3);
    cutOutlets(land, {});
    return std::vector{land};
  }();
  return list;
}

const TerrainSynthesisOptions kOptions{.seed = 4};

const Grid<float>& start() {
  static const Grid<float> grid = heightWorldStart(examples(), kOptions, heightLattice(kPitch));
  return grid;
}

/// A world of which nothing is known yet.
struct NewWorld {
  WindowCache cache{1};
  HeightWorld world{examples(), kOptions, start(), heightLattice(kPitch), cache};
};

const HeightWorld::Region& region() {
  static const HeightWorld::Region made =
      onThreads(8, [] { return NewWorld().world.region(kBox); });
  return made;
}

/// How many samples lie below the level at which water would leave the box, or end in it.
int flooded(Grid<float> heights) {
  const NewWorld any;
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x)
      if (any.world.takesWater({kBox.begin.x + x, kBox.end.y - 1 - y}))
        heights(x, y) = std::numeric_limits<float>::quiet_NaN();
  const Drainage drainage = drain(heights);
  int count = 0;
  for (std::size_t s = 0; s < heights.count(); ++s) count += drainage.levels[s] > heights[s];
  return count;
}

TEST(HeightWorld, WaterRunsEverywhereAcrossWindows) {
  EXPECT_EQ(flooded(region().heights), 0);
  // A pit is found.
  Grid<float> broken = region().heights;
  broken(70, 54) -= 500;
  EXPECT_GT(flooded(broken), 0);
}

/// Whether a part of the region is what another world made of it.
bool isPartOfRegion(const HeightWorld::Region& part, const PlaneBox& box) {
  const int left = static_cast<int>(box.begin.x - kBox.begin.x),
            top = static_cast<int>(kBox.end.y - box.end.y);
  for (int y = 0; y < part.heights.height(); ++y) {
    for (int x = 0; x < part.heights.width(); ++x) {
      if (part.heights(x, y) != region().heights(left + x, top + y)) return false;
      if (!(part.origins(x, y) == region().origins(left + x, top + y))) return false;
    }
  }
  return true;
}

TEST(HeightWorld, PartsAreTheSameInAnyOrderAtAnyThreads) {
  const PlaneBox parts[] = {{{70, 70}, {90, 128}}, {{-28, 20}, {-14, 40}}, {{28, 60}, {48, 74}}};
  const int orders[3][3] = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}};
  for (int n = 0; n < 3; ++n) {
    onThreads(n == 1 ? 8 : 1, [&] {
      const NewWorld nothing;
      // The first alone, the others with what the first have left in the cache.
      for (const int which : orders[n])
        EXPECT_TRUE(isPartOfRegion(nothing.world.region(parts[which]), parts[which]))
            << n << " " << which;
      return 0;
    });
  }
  EXPECT_FALSE(isPartOfRegion(NewWorld().world.region(parts[1]), {{-27, 20}, {-13, 40}}));
}

/// The mean step of heights along x to the columns where a phase's rims begin or end, over the mean
/// of all; the largest of the phases.
double stepAtRims(const Grid<float>& heights) {
  const WindowLattice lattice = heightLattice(kPitch);
  double largest = 0;
  for (int phase = 1; phase <= WindowLattice::phases; ++phase) {
    double at = 0, all = 0;
    int countAt = 0, countAll = 0;
    for (int x = 1; x < heights.width(); ++x) {
      const std::int64_t in = kBox.begin.x + x - lattice.shift(phase);
      const std::int64_t place = in - floorDivide(in, kPitch) * kPitch;
      const bool rim = place == 0 || place == lattice.separator;
      for (int y = 0; y < heights.height(); ++y) {
        const double step = std::abs(heights(x, y) - heights(x - 1, y));
        all += step;
        ++countAll;
        if (rim) at += step, ++countAt;
      }
    }
    largest = std::max(largest, at / countAt / (all / countAll));
  }
  return largest;
}

TEST(HeightWorld, NoStepShowsWhereWindowsMeet) {
  // A line of 108 steps of land whose steps differ by about their mean has a mean within .29 of the
  // land's, three deviations.
  EXPECT_LT(stepAtRims(region().heights), 1.29);
  Grid<float> broken = region().heights;
  for (int y = 0; y < broken.height(); ++y)
    for (int x = 28; x < broken.width(); ++x) broken(x, y) += 60;
  EXPECT_GT(stepAtRims(broken), 1.29);
}

/// Where heights bend along x: a column's mean second difference.
std::vector<double> bendsOf(const Grid<float>& heights) {
  std::vector<double> bends;
  for (int x = 1; x + 1 < heights.width(); ++x) {
    double sum = 0;
    for (int y = 0; y < heights.height(); ++y)
      sum += std::abs(heights(x + 1, y) - 2 * heights(x, y) + heights(x - 1, y));
    bends.push_back(sum / heights.height());
  }
  return bends;
}

TEST(HeightWorld, NoGridOfWindowsShows) {
  Grid<float> strip = onThreads(8, [] {
    return NewWorld().world.region({{-1, 0}, {8 * kPitch + 1, 64}}).heights;
  });
  EXPECT_LT(testing::gridShare(bendsOf(strip), kPitch), 0.1);
  // A step as high as the land's bends are on average, along every window, shows.
  const std::vector<double> own = bendsOf(strip);
  const double mean =
      std::accumulate(own.begin(), own.end(), 0.0) / static_cast<double>(own.size());
  for (int x = 0; x < strip.width(); ++x)
    for (int y = 0; y < strip.height(); ++y)
      strip(x, y) += static_cast<float>(mean * (x / kPitch % 2));
  EXPECT_GT(testing::gridShare(bendsOf(strip), kPitch), 0.1);
}

TEST(HeightWorld, NothingOfItsStartIsLeft) {
  const int n = start().width();
  int same = 0;
  for (int y = 0; y < region().heights.height(); ++y) {
    for (int x = 0; x < region().heights.width(); ++x) {
      const std::size_t there =
          start().wrapped(static_cast<int>(kBox.begin.x) + x, 1 - static_cast<int>(kBox.end.y) + y);
      same += region().heights(x, y) == start()[there];
    }
  }
  // But where water ends.
  EXPECT_LT(same, 60);
  EXPECT_GT(n, 2 * kPitch);
}

TEST(HeightWorld, HeightsStayNearTheExamples) {
  const HeightRange range = heightWorldRange(examples(), start());
  const auto [low, high] = std::ranges::minmax(region().heights.values());
  EXPECT_GE(low, range.low);
  EXPECT_LE(high, range.high);
}

}  // namespace
}  // namespace exemplar
