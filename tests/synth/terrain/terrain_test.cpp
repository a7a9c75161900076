// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "maps/drainage.h"
#include "measure/terrain.h"
#include "synth/terrain/gradient_direction.h"
#include "synth/terrain/guide_lines.h"
#include "synth/terrain/height_pyramid.h"
#include "synth/terrain/outlets.h"
#include "tests/progress_checks.h"
#include "tests/synth/terrain/height_samples.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using ::testing::HasSubstr;
using testing::ridges;
using ::testing::ThrowsMessage;

/// Mountains whose rivers run to the border, as an example is.
Grid<float> mountains(int width, int height, std::uint64_t seed) {
  Grid<float> heights = ridges(width, height, seed);
  cutOutlets(heights, {}, {.fill = 0.5, .fall = 0.2, .bank = 8});
  return heights;
}

SynthesizedTerrain made(const Grid<float>& example, const TerrainSynthesisOptions& options) {
  return synthesizeTerrain({&example, 1}, options);
}

double correlation(const Grid<float>& a, const Grid<float>& b) {
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  const auto n = static_cast<double>(a.count());
  for (std::size_t s = 0; s < a.count(); ++s) ma += a[s] / n, mb += b[s] / n;
  for (std::size_t s = 0; s < a.count(); ++s) {
    ab += (a[s] - ma) * (b[s] - mb);
    aa += (a[s] - ma) * (a[s] - ma);
    bb += (b[s] - mb) * (b[s] - mb);
  }
  return ab / std::sqrt(aa * bb);
}

TEST(Terrain, IsOfTheSizeAskedForAndWaterRunsFromAllOfIt) {
  const Grid<float> example = mountains(96, 80, 1);
  for (const Pixel size : {Pixel{160, 144}, Pixel{97, 203}, Pixel{64, 40}}) {
    const SynthesizedTerrain terrain = made(example, {.width = size.x, .height = size.y});
    ASSERT_EQ(terrain.heights.width(), size.x);
    ASSERT_EQ(terrain.heights.height(), size.y);
    ASSERT_TRUE(terrain.origins.sameSize(terrain.heights));
    const Drainage drainage = drain(terrain.heights);
    for (std::size_t s = 0; s < terrain.heights.count(); ++s) {
      ASSERT_LE(drainage.levels[s], terrain.heights[s]);
      ASSERT_TRUE(example.contains(terrain.origins[s].x, terrain.origins[s].y));
    }
  }
}

TEST(Terrain, IsLikeItsExample) {
  const Grid<float> example = mountains(128, 128, 2);
  const SynthesizedTerrain terrain = made(example, {.width = 256, .height = 256, .seed = 3});
  const TerrainLikeness likeness = measureTerrain(example, terrain.heights, {.cellSize = 10});
  // In standard deviations. Made land is alike everywhere, so that its halves hardly differ; what
  // outlets change of it, where none of its hollows stays, is .11 in slopes.
  EXPECT_LT(*likeness.slopes.result, *likeness.slopes.floor + 0.12);
  EXPECT_LT(*likeness.curvature.result, *likeness.curvature.floor + 0.03);
  EXPECT_LT(*likeness.heights.result, *likeness.heights.floor + 0.02);
  EXPECT_LE(*likeness.stepRatio, 1.3);
  EXPECT_LE(*likeness.result.floodedShare, 1e-6);
  // And not by being copies of it.
  EXPECT_LT(correlation(terrain.heights, stretched(example, 256, 256)), 0.5);
  EXPECT_LE(*likeness.verbatimShare, 0.02);
  EXPECT_LE(*likeness.result.repeatedPeaks, *likeness.example.repeatedPeaks + 0.1);
  EXPECT_LE(*likeness.copiedLayout.result, 0.05);
}

TEST(Terrain, LandWithHollowsOfItsOwnIsLikeItsExampleWithinItsHalves) {
  const Grid<float> example = ridges(128, 128, 2);
  ASSERT_GT(*terrainFigures(example).floodedShare, 0.05);
  const SynthesizedTerrain terrain = made(example, {.width = 256, .height = 256, .seed = 3});
  const TerrainLikeness likeness = measureTerrain(example, terrain.heights);
  // Where all of its hollows are drained, slopes are .11 beyond the floor; from seed to seed they
  // differ by .02.
  EXPECT_LT(*likeness.slopes.result, *likeness.slopes.floor + 0.07);
  EXPECT_LT(*likeness.curvature.result, *likeness.curvature.floor + 0.03);
  EXPECT_LE(*likeness.result.floodedShare, 2 * *likeness.example.floodedShare);
}

TEST(Terrain, KeepsItsUnits) {
  // Heights of twice the unit give twice the heights, to the bit: nothing depends on a unit.
  const Grid<float> example = mountains(80, 80, 4);
  Grid<float> doubled = example;
  for (float& h : doubled.values()) h *= 2;
  const TerrainSynthesisOptions options{.width = 120, .height = 100, .seed = 1};
  Grid<float> heights = made(example, options).heights;
  for (float& h : heights.values()) h *= 2;
  EXPECT_EQ(heights, made(doubled, options).heights);
}

TEST(Terrain, SeedsGiveDifferentOnesAndThreadsTheSame) {
  const Grid<float> example = mountains(80, 80, 5);
  const auto of = [&](std::uint64_t seed) {
    return made(example, {.width = 120, .height = 120, .seed = seed}).heights;
  };
  EXPECT_EQ(of(1), of(1));
  EXPECT_LT(correlation(of(1), of(2)), 0.6);
  testing::expectSameAtAnyThreads([&] { return of(3); });
}

TEST(Terrain, JoinsItsCopiesOnATorus) {
  const Grid<float> example = mountains(96, 96, 6);
  const SynthesizedTerrain terrain =
      made(example, {.width = 128, .height = 96, .wrapsX = true, .wrapsY = true});
  const Grid<float>& h = terrain.heights;
  double across = 0, within = 0;
  for (int y = 0; y < h.height(); ++y) {
    across += std::abs(h(0, y) - h(h.width() - 1, y)) / h.height();
    within += std::abs(h(60, y) - h(59, y)) / h.height();
  }
  for (int x = 0; x < h.width(); ++x) {
    across += std::abs(h(x, 0) - h(x, h.height() - 1)) / h.width();
    within += std::abs(h(x, 40) - h(x, 39)) / h.width();
  }
  EXPECT_LT(across, 1.8 * within);
}

TEST(Terrain, StaysWhereItIsHeld) {
  const Grid<float> example = mountains(96, 96, 7);
  TerrainSynthesisOptions options{.width = 160, .height = 160, .seed = 2};
  TerrainControl& control = options.control;
  control.given = Grid<float>(160, 160);
  control.hold = Grid<float>(160, 160);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      control.given(x + 20, y + 30) = example(x, y);
      const int inside = std::min(std::min(x, 95 - x), std::min(y, 95 - y));
      control.hold(x + 20, y + 30) = std::min(1.0f, static_cast<float>(inside) / 16);
    }
  }
  const SynthesizedTerrain terrain = made(example, options);
  double step = 0, usual = 0;
  for (int y = 16; y < 80; ++y) {
    for (int x = 16; x < 80; ++x)
      ASSERT_EQ(terrain.heights(x + 20, y + 30), example(x, y)) << x << " " << y;
    step += std::abs(terrain.heights(36, y + 30) - terrain.heights(35, y + 30));
    usual += std::abs(example(17, y) - example(16, y));
  }
  EXPECT_LT(step, 3 * usual);
}

TEST(Terrain, FollowsAGuide) {
  const Grid<float> example = mountains(96, 96, 8);
  TerrainSynthesisOptions options{.width = 192, .height = 192, .seed = 4};
  Grid<float> guide(24, 24);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      guide(x, y) = static_cast<float>(900 - 40 * std::hypot(x - 12, y - 12));
  options.control.guide = guide;
  const Grid<float> wanted = stretched(guide, 192, 192);
  const double followed = correlation(made(example, options).heights, wanted);
  options.control.follow = 0;
  EXPECT_GT(followed, 0.8);
  EXPECT_GT(followed, correlation(made(example, options).heights, wanted) + 0.3);
}

TEST(Terrain, IsFreeWhereAGuideHasNoWeight) {
  const Grid<float> example = mountains(96, 96, 8);
  TerrainSynthesisOptions options{.width = 128, .height = 128, .seed = 4};
  const Grid<float> free = made(example, options).heights;
  options.control.guide = Grid<float>(16, 16, 5000);
  options.control.guideWeight = Grid<float>(16, 16);
  EXPECT_EQ(made(example, options).heights, free);
  for (int y = 0; y < 16; ++y) options.control.guideWeight(2, y) = 1;
  EXPECT_NE(made(example, options).heights, free);
}

TEST(LinesGuide, CountsOnLinesAndNotFarFromThem) {
  const Grid<float> example = mountains(64, 64, 1);
  const TerrainLine ridge{true, {{0, 50}, {400, 50}}};
  const LinesGuide guide = guideOfLines({&ridge, 1}, 400, 200, {&example, 1});
  ASSERT_TRUE(guide.weight.sameSize(guide.heights));
  ASSERT_EQ(guide.weight.width(), 192);
  const int row = 24;  // of 96
  for (int x = 0; x < 192; ++x) {
    EXPECT_EQ(guide.weight(x, row), 1);
    EXPECT_EQ(guide.weight(x, row + 3), 1);  // .04 of 192 are 7.7
    EXPECT_NEAR(guide.weight(x, row + 6), 0.44, 0.01);
    EXPECT_EQ(guide.weight(x, row + 8), 0);
    EXPECT_GT(guide.heights(x, row), guide.heights(x, row + 12));
  }
}

TEST(Terrain, AddsDetailToCoarseHeights) {
  const Grid<float> example = mountains(128, 128, 9);
  const Grid<float> coarse = stretched(mountains(160, 160, 99), 40, 40);
  TerrainSynthesisOptions options{.width = 160, .height = 160, .seed = 4, .keepsHollows = true};
  options.control.guide = coarse;
  options.control.guideLevel = 2;
  options.control.follow = 1;
  const Grid<float> fine = made(example, options).heights;
  // Its means are the coarse heights, up to what is lost between resolutions and back, and it has
  // the example's detail, not that of heights between coarse ones.
  const Grid<float> means = stretched(fine, 40, 40), smooth = stretched(coarse, 160, 160);
  double error = 0, relief = 0;
  for (std::size_t s = 0; s < means.count(); ++s) error += std::abs(means[s] - coarse[s]);
  for (std::size_t s = 0; s + 1 < means.count(); ++s) relief += std::abs(coarse[s + 1] - coarse[s]);
  EXPECT_LT(error, 0.5 * relief);
  const auto roughness = [](const Grid<float>& h) {
    double sum = 0;
    for (int y = 1; y + 1 < h.height(); ++y)
      for (int x = 1; x + 1 < h.width(); ++x)
        sum += std::abs(4 * h(x, y) - h(x - 1, y) - h(x + 1, y) - h(x, y - 1) - h(x, y + 1));
    return sum / static_cast<double>(h.count());
  };
  EXPECT_GT(roughness(fine), 2 * roughness(smooth));
  EXPECT_NEAR(roughness(fine) / roughness(example), 1, 0.4);
}

TEST(Terrain, MixesExamplesAndLeavesHoles) {
  Grid<float> examples[] = {mountains(80, 80, 10), mountains(90, 70, 11)};
  // It begins and ends in the middle of what is one sample on half the resolution.
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x)
      examples[0](41 + x, 31 + y) = std::numeric_limits<float>::quiet_NaN();
  const SynthesizedTerrain terrain =
      synthesizeTerrain(examples, {.width = 150, .height = 150, .seed = 1});
  std::size_t second = 0;
  for (std::size_t s = 0; s < terrain.heights.count(); ++s) {
    ASSERT_FALSE(std::isnan(terrain.heights[s]));
    const HeightOrigin& origin = terrain.origins[s];
    ASSERT_FALSE(std::isnan(examples[origin.example](origin.x, origin.y)));
    second += origin.example;
  }
  EXPECT_GT(second, terrain.heights.count() / 10);
  EXPECT_LT(second, terrain.heights.count() * 9 / 10);
}

TEST(Terrain, OrientationsKeepTheDirectionOfRidges) {
  const Grid<float> without = ridges(128, 128, 12), stretchedRidges = ridges(128, 128, 12, 5);
  EXPECT_EQ(turnsOf({&without, 1}).size(), 8u);
  const std::vector<int> turns = turnsOf({&stretchedRidges, 1});
  EXPECT_EQ(turns, (std::vector<int>{0, 2, 4, 6}));
}

TEST(Terrain, RefusesWhatIsTooSmallOrAllHoles) {
  const Grid<float> small = ridges(12, 40, 1), good = ridges(40, 40, 1);
  EXPECT_THAT([&] { made(small, {.width = 40, .height = 40}); },
              ThrowsMessage<InputError>(HasSubstr("an example has a side of 12")));
  EXPECT_THAT([&] { made(good, {.width = 40, .height = 9}); },
              ThrowsMessage<InputError>(HasSubstr("the result would have 9")));
  const Grid<float> none(40, 40, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT([&] { made(none, {.width = 40, .height = 40}); },
              ThrowsMessage<InputError>(HasSubstr("without holes")));
}

TEST(Terrain, OfOneHeightIsOfOneHeight) {
  const Grid<float> flat(40, 40, 7.5f);
  const SynthesizedTerrain terrain = made(flat, {.width = 64, .height = 64});
  for (const float h : terrain.heights.values()) ASSERT_NEAR(h, 7.5f, 1e-4);
}

TEST(Terrain, ReportsAndStops) {
  const Grid<float> example = mountains(64, 64, 13);
  testing::expectReportsAndStops(8, [&](const Progress& progress) {
    return synthesizeTerrain({&example, 1}, {.width = 96, .height = 96}, progress);
  });
}

}  // namespace
}  // namespace exemplar
