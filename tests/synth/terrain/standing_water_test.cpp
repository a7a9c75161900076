// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/standing_water.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "maps/drainage.h"
#include "maps/halved.h"
#include "synth/terrain/outlets.h"
#include "synth/terrain/terrain.h"
#include "tests/synth/terrain/height_samples.h"

namespace exemplar {
namespace {

using testing::ridges;

std::size_t countOf(const Grid<std::uint8_t>& water, std::uint8_t kind) {
  return static_cast<std::size_t>(std::ranges::count(water.values(), kind));
}

/// Mountains under which all is flooded up to a level.
Grid<float> flooded(int width, int height, std::uint64_t seed, float level) {
  Grid<float> heights = ridges(width, height, seed);
  for (float& h : heights.values()) h = std::max(h, level);
  return heights;
}

TEST(FlatWater, IsALakeOrTheSeaButNoTerraceAndNoPlain) {
  Grid<float> heights(60, 50);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 60; ++x) {
      heights(x, y) = static_cast<float>(100 + std::hypot(x - 40, y - 25));
      if (x < 12) heights(x, y) = 3;                            // the sea
      if (std::hypot(x - 40, y - 25) < 6) heights(x, y) = 104;  // a lake
      if (x >= 12 && x < 22 && y < 10) heights(x, y) = 50;      // higher than the sea beside it
    }
  }
  const Grid<std::uint8_t> water = flatWater(heights);
  EXPECT_EQ(water(3, 20), kSea);
  EXPECT_EQ(countOf(water, kSea), 12u * 50);
  EXPECT_EQ(water(40, 25), kLake);
  EXPECT_EQ(countOf(water, kLake),
            static_cast<std::size_t>(std::ranges::count(heights.values(), 104.0f)));
  EXPECT_EQ(water(16, 4), kLand);
  EXPECT_EQ(countOf(flatWater(Grid<float>(40, 40, 5)), kLand), 1600u);
  const Grid<std::uint8_t> half = halvedWater(water);
  EXPECT_EQ(half(2, 20), kSea);
  EXPECT_EQ(half(20, 12), kLake);
  EXPECT_EQ(half(14, 20), kLand);
}

TEST(CutOutlets, GivesALakeAnOutletAndLeavesItFlat) {
  // A lake in a bowl, with water that runs into it.
  Grid<float> heights(41, 41);
  WaterBodies water{Grid<std::uint32_t>(41, 41)};
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      const double r = std::hypot(x - 20, y - 20);
      heights(x, y) = static_cast<float>(r < 6 ? 6 : r < 15 ? r : 30 - r);
      if (r < 6) water.bodies(x, y) = kFirstLake;
    }
  }
  water.count = kFirstLake + 1;
  cutOutlets(heights, {}, {.fill = 0}, &water);
  for (std::size_t s = 0; s < heights.count(); ++s) {
    if (water.bodies[s] == kFirstLake) {
      ASSERT_EQ(heights[s], 6.0f);
    }
  }
  const Drainage drainage = drain(heights);
  for (std::size_t s = 0; s < heights.count(); ++s) EXPECT_EQ(drainage.levels[s], heights[s]);
  // The sea takes all water: nothing is cut.
  Grid<float> island = heights;
  for (int y = 0; y < 41; ++y) island(0, y) = island(40, y) = 99;
  for (int x = 0; x < 41; ++x) island(x, 0) = island(x, 40) = 99;
  for (std::uint32_t& body : water.bodies.values()) body = body == kFirstLake ? kSeaBody : 0;
  for (int y = 1; y < 40; ++y) {
    for (int x = 1; x < 40; ++x) {
      const double r = std::hypot(x - 20, y - 20);
      island(x, y) = static_cast<float>(std::max(6.0, r));
    }
  }
  EXPECT_EQ(cutOutlets(island, {}, {.fill = 0}, &water).outlets, 0);
}

TEST(Hollows, OnCoarserResolutionsAreThoseOfTheFinest) {
  // A basin whose way out is one sample wide, and a pit without one.
  Grid<float> heights(64, 64, 100);
  for (int y = 8; y < 28; ++y)
    for (int x = 8; x < 28; ++x) heights(x, y) = 50;
  for (int x = 0; x < 8; ++x) heights(x, 17) = static_cast<float>(40 + x);
  for (int y = 32; y < 48; ++y)
    for (int x = 32; x < 48; ++x) heights(x, y) = 60;
  const double pit = 16.0 * 16 / (64 * 64);
  for (const Hollows& hollows : hollowsOf({&heights, 1}, 4)) EXPECT_DOUBLE_EQ(hollows.share, pit);
  // Means close the way out.
  const Grid<float> half = halved(heights, false);
  EXPECT_GT(hollowsOf({&half, 1}).front().share, 2 * pit);
}

TEST(CutOutlets, KeepsHollowsUpToTheirSharesBySize) {
  const Grid<float> rough = ridges(120, 100, 3);
  const Hollows all = hollowsOf({&rough, 1}).front();
  ASSERT_GT(all.share, 0.05);
  EXPECT_NEAR(std::accumulate(all.bySize.begin(), all.bySize.end(), 0.0), all.share, 1e-12);
  ASSERT_GT(all.bySize.size(), 4u);
  // Half of each size, and none of the largest.
  std::vector<double> wanted = all.bySize;
  for (double& share : wanted) share /= 2;
  wanted.pop_back();
  Grid<float> heights = rough;
  const OutletsCut cut = cutOutlets(heights, {}, {.kept = wanted});
  EXPECT_NEAR(cut.flooded, all.share, 1e-9);
  const Hollows kept = hollowsOf({&heights, 1}).front();
  const double most = std::accumulate(wanted.begin(), wanted.end(), 0.0);
  EXPECT_LE(kept.share, most);
  EXPECT_GT(kept.share, most / 2);
  // Two that stay side by side may become one of the next size.
  EXPECT_LE(kept.bySize.size(), all.bySize.size());
  // All of them: nothing changes.
  Grid<float> same = rough;
  EXPECT_EQ(cutOutlets(same, {}, {.kept = all.bySize}).outlets, 0);
  EXPECT_EQ(same, rough);
}

TEST(CutOutlets, GivesLakesInARowALevelAtWhichTheyDrain) {
  // A gorge with two lakes; the upper one is the lower one by far.
  Grid<float> heights(60, 41, 200);
  WaterBodies water{Grid<std::uint32_t>(60, 41), kFirstLake + 2};
  for (int y = 18; y < 23; ++y) {
    for (int x = 0; x < 50; ++x) {
      const bool lower = x >= 10 && x < 17, upper = x >= 30 && x < 44;
      heights(x, y) = lower ? 95 : upper ? 80 : 96 + 0.1f * static_cast<float>(x);
      if (lower) water.bodies(x, y) = kFirstLake;
      if (upper) water.bodies(x, y) = kFirstLake + 1;
    }
  }
  ASSERT_GT(hollowsOf({&heights, 1}).front().share, 0.02);
  cutOutlets(heights, {}, {.fill = 0}, &water);
  EXPECT_EQ(hollowsOf({&heights, 1}).front().share, 0);
  // The mean of both, by their areas.
  const float level = (95.0f * 7 + 80.0f * 14) / 21;
  for (std::size_t s = 0; s < heights.count(); ++s) {
    if (water.bodies[s] != 0) {
      ASSERT_FLOAT_EQ(heights[s], level);
    }
  }
}

TEST(CutOutlets, LowersTheShoresOfWaterThatCameToALowerLevel) {
  // Land that falls toward water at the border, which came down by 30.
  constexpr float kFell = 30, kBank = 2;
  for (const std::uint32_t body : {kSeaBody, kFirstLake}) {
    WaterBodies water{Grid<std::uint32_t>(61, 41), body + 1, Grid<float>(61, 41)};
    water.count = std::max(water.count, kFirstLake);
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 61; ++x) {
        const double r = std::hypot(x - 30, y);
        water.before(x, y) = static_cast<float>(150 + 0.1 * r);
        if (r < 8) water.bodies(x, y) = body;
        if (r < 8) water.before(x, y) = 150;
      }
    }
    Grid<float> heights = water.before;
    for (std::size_t s = 0; s < heights.count(); ++s)
      if (water.bodies[s] != 0) heights[s] -= kFell;
    EXPECT_EQ(cutOutlets(heights, {}, {.fill = 0, .bank = kBank}, &water).outlets, 0);
    const auto lowered = [&](int x, int y) { return water.before(x, y) - heights(x, y); };
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 61; ++x) {
        if (water.bodies(x, y) != 0) {
          ASSERT_EQ(lowered(x, y), kFell);
          continue;
        }
        // By so much less a step as banks rise, straight or over a corner: no cliff, and no more.
        double most = 0;
        for (int v = std::max(0, y - 1); v <= std::min(40, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(60, x + 1); ++u)
            if (u != x || v != y)
              most = std::max(most, lowered(u, v) - kBank * std::hypot(u - x, v - y));
        ASSERT_LE(lowered(x, y), most + 1e-3) << x << " " << y;
        ASSERT_GE(lowered(x, y), most - 0.415 * kBank) << x << " " << y;
      }
    }
  }
}

TEST(SettleWater, HasASeaInlandWhereItMayBe) {
  // Basins of which one comes from the sea, under its level in part, away from the border.
  constexpr float kLevel = 10;
  Grid<float> rough(48, 40);
  Grid<std::uint8_t> water(48, 40);
  Grid<HeightOrigin> origins(48, 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      const double r = std::hypot(x - 24, y - 20);
      if (r < 9) water(x, y) = kSea;
      rough(x, y) = static_cast<float>(r < 9 ? 8 + 0.5 * r : 4 + r);
      origins(x, y) = {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
    }
  }
  const auto settled = [&](bool inland, Grid<float>& heights) {
    return settleWater(heights, origins, {&water, 1}, kLevel, {}, 32, inland);
  };
  Grid<float> sea = rough, lake = rough;
  const WaterBodies within = settled(true, sea), without = settled(false, lake);
  EXPECT_EQ(within.count, kFirstLake);
  EXPECT_EQ(without.count, kFirstLake + 1);
  EXPECT_EQ(within.bodies(24, 20), kSeaBody);
  EXPECT_EQ(sea(24, 20), kLevel);
  EXPECT_GE(lake(24, 20), kLevel);
  EXPECT_EQ(within.before, rough);
  for (std::size_t s = 0; s < rough.count(); ++s) {
    ASSERT_EQ(within.bodies[s] == kSeaBody, without.bodies[s] == kFirstLake) << s;
    ASSERT_EQ(sea[s], within.bodies[s] != 0 ? kLevel : rough[s]) << s;
    ASSERT_EQ(lake[s], without.bodies[s] != 0 ? lake(24, 20) : rough[s]) << s;
  }
}

TEST(CutOutlets, KeepsNoHollowThroughWhichLowerLandDrains) {
  // A gorge with a pond in it, and a basin above that, of this height.
  const auto gorge = [](float basin) {
    Grid<float> heights(60, 41, 200);
    for (int y = 18; y < 23; ++y) {
      for (int x = 0; x < 51; ++x) {
        const float bed = x < 10 ? 90 + 0.1f * static_cast<float>(x) : x < 17 ? 80 : 92;
        heights(x, y) = x < 26 ? bed : basin;
      }
    }
    return heights;
  };
  // The pond's size may stay, the basin's may not.
  const std::vector<double> pond{0, 0, 0, 0, 0, 0.02};
  const auto cut = [&](Grid<float> heights) {
    cutOutlets(heights, {}, {.fill = 0, .kept = pond});
    return heights;
  };
  const Grid<float> low = gorge(60), high = gorge(91.5f);
  const Grid<float> drained = cut(low), kept = cut(high);
  EXPECT_EQ(hollowsOf({&drained, 1}).front().share, 0);
  for (std::size_t s = 0; s < low.count(); ++s) ASSERT_LE(drained[s], low[s]);  // none lifted
  EXPECT_NEAR(hollowsOf({&kept, 1}).front().share, 35.0 / (60 * 41), 1e-9);
}

TEST(Terrain, HasTheExamplesSeaAndLakes) {
  const Grid<float> example = flooded(128, 128, 5, 620);
  const Grid<std::uint8_t> water = flatWater(example);
  const double wanted =
      1 - static_cast<double>(countOf(water, kLand)) / static_cast<double>(water.count());
  ASSERT_GT(wanted, 0.1);
  const Grid<float> heights =
      synthesizeTerrain({&example, 1}, {.width = 200, .height = 200, .seed = 2}).heights;
  const Grid<std::uint8_t> made = flatWater(heights);
  const double share =
      1 - static_cast<double>(countOf(made, kLand)) / static_cast<double>(made.count());
  EXPECT_GT(share, 0.5 * wanted);
  EXPECT_LT(share, 2 * wanted);
  // The sea has its level, and nothing lies lower.
  for (std::size_t s = 0; s < heights.count(); ++s) {
    ASSERT_GE(heights[s], 620.0f);
    if (made[s] == kSea) {
      ASSERT_EQ(heights[s], 620.0f);
    }
  }
}

}  // namespace
}  // namespace exemplar
