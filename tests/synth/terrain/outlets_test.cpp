// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/outlets.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

#include "maps/drainage.h"
#include "tests/synth/terrain/height_samples.h"

namespace exemplar {
namespace {

using testing::noise;
using testing::ridges;

std::size_t flooded(const Grid<float>& heights) {
  const Drainage drainage = drain(heights);
  std::size_t count = 0;
  for (std::size_t s = 0; s < heights.count(); ++s) count += drainage.levels[s] > heights[s];
  return count;
}

TEST(CutOutlets, LetsWaterRunFromEverywhere) {
  for (const double fill : {0.0, 0.5, 1.0}) {
    for (const double fall : {0.0, 0.01}) {
      for (const double bank : {0.3, std::numeric_limits<double>::infinity()}) {
        Grid<float> heights = noise(70, 50, 1);
        ASSERT_GT(flooded(heights), 100u);
        const OutletsCut cut = cutOutlets(heights, {}, {.fill = fill, .fall = fall, .bank = bank});
        EXPECT_EQ(flooded(heights), 0u) << fill << " " << fall << " " << bank;
        EXPECT_TRUE(fill == 1 || cut.outlets > 0);
        EXPECT_GE(cut.deepest, cut.mean);
      }
    }
  }
}

TEST(CutOutlets, ShapesBanksBesideHolesAndLeavesThem) {
  // A pit behind a wall, and beyond that nothing is known.
  const auto isHole = [](int x) { return x >= 30; };
  Grid<float> heights(40, 31);
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 40; ++x) {
      heights(x, y) = static_cast<float>(std::abs(x - 20) < 4 && std::abs(y - 15) < 4
                                             ? 50
                                             : 100 + 0.1 * std::abs(y - 15) - 0.1 * x);
      if (isHole(x)) heights(x, y) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  const Grid<float> before = heights;
  const OutletsCut cut = cutOutlets(heights, {}, {.fill = 0, .bank = 2});
  EXPECT_GT(cut.deepest, 40);
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(std::isnan(heights(x, y)), isHole(x)) << x << " " << y;
      if (!isHole(x)) {
        ASSERT_LE(heights(x, y), before(x, y));
      }
    }
  }
  EXPECT_LT(heights(27, 17), before(27, 17));
}

TEST(CutOutlets, LeavesLandThatDrainsAsItIs) {
  Grid<float> heights(40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      heights(x, y) = static_cast<float>(100 - std::hypot(x - 20, y - 15));
  const Grid<float> before = heights;
  EXPECT_EQ(cutOutlets(heights, {}).outlets, 0);
  EXPECT_EQ(heights, before);
}

TEST(CutOutlets, CutsOverTheLowestSaddleAndNoDeeperThanThePit) {
  // A bowl with a notch in its rim.
  Grid<float> heights(41, 41);
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      const double r = std::hypot(x - 20, y - 20);
      heights(x, y) = static_cast<float>(r < 15 ? r : 30 - r);
      if (y == 20 && x > 20 && r >= 12 && r <= 17) heights(x, y) -= 3;
    }
  }
  const Grid<float> before = heights;
  const OutletsCut cut = cutOutlets(heights, {}, {.fill = 0, .bank = 100});
  EXPECT_EQ(flooded(heights), 0u);
  EXPECT_LT(cut.deepest, before(35, 20) - before(20, 20) + 0.1);
  // All of the cut lies on the side of the notch, and nothing was raised.
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      EXPECT_LE(heights(x, y), before(x, y));
      if (x < 19) {
        EXPECT_EQ(heights(x, y), before(x, y)) << x << " " << y;
      }
    }
  }
  EXPECT_LT(heights(35, 20), before(35, 20) - 5);
}

TEST(CutOutlets, FillsAtMostUpToWhereItSpills) {
  const Grid<float> before = noise(60, 60, 4);
  const Drainage drainage = drain(before);
  Grid<float> heights = before;
  cutOutlets(heights, {}, {.fill = 1, .bank = 1e9});
  for (std::size_t s = 0; s < heights.count(); ++s)
    ASSERT_LE(heights[s], drainage.levels[s] + 1e-5f);
}

TEST(CutOutlets, LeavesHeldSamples) {
  Grid<float> heights = noise(50, 50, 2);
  const Grid<float> before = heights;
  Grid<std::uint8_t> held(50, 50);
  for (int y = 20; y < 40; ++y)
    for (int x = 10; x < 30; ++x) held(x, y) = 1;
  cutOutlets(heights, held, {.fill = 0.5, .fall = 0.01, .bank = 0.2});
  EXPECT_NE(heights, before);
  for (std::size_t s = 0; s < heights.count(); ++s) {
    if (held[s]) {
      ASSERT_EQ(heights[s], before[s]);
    }
  }
}

/// Land that is held along its border, from whose samples water leaves at some of those alone.
struct HeldBorder {
  Grid<float> heights;
  Grid<std::uint8_t> held{60, 60}, outlets{60, 60};
};
/// A plane that falls to the east, and other land inside of it.
HeldBorder heldBorder() {
  HeldBorder made{ridges(60, 60, 7)};
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const bool inside = x >= 8 && y >= 8 && x < 52 && y < 52;
      made.held(x, y) = !inside;
      if (!inside) made.heights(x, y) = static_cast<float>(900 - 5 * x);
      made.outlets(x, y) = x == 59;
    }
  }
  return made;
}
/// Samples that lie below where water leaves by these outlets alone.
std::size_t floodedBeyond(const Grid<float>& heights, const Grid<std::uint8_t>& outlets) {
  // Walls around, and holes where water leaves.
  Grid<float> walled(heights.width() + 2, heights.height() + 2, 1e6f);
  for (int y = 0; y < heights.height(); ++y) {
    for (int x = 0; x < heights.width(); ++x) {
      walled(x + 1, y + 1) =
          outlets(x, y) ? std::numeric_limits<float>::quiet_NaN() : heights(x, y);
    }
  }
  const Drainage drainage = drain(walled);
  std::size_t count = 0;
  for (std::size_t s = 0; s < walled.count(); ++s)
    count += walled[s] < 1e6f && drainage.levels[s] > walled[s];
  return count;
}

TEST(CutOutlets, LeadsWaterToGivenOutletsThroughWhatIsNotHeld) {
  HeldBorder land = heldBorder();
  const Grid<float> before = land.heights;
  ASSERT_GT(floodedBeyond(land.heights, land.outlets), 500u);
  for (const double fill : {0.0, 0.5}) {
    land.heights = before;
    const OutletsCut cut =
        cutOutlets(land.heights, land.held, {.fill = fill, .outlets = land.outlets});
    EXPECT_EQ(floodedBeyond(land.heights, land.outlets), 0u) << fill;
    EXPECT_EQ(cut.left, 0);
    for (std::size_t s = 0; s < before.count(); ++s)
      ASSERT_TRUE(!land.held[s] || land.heights[s] == before[s]);
  }
}

TEST(CutOutlets, LiftsWhatLiesBelowEveryGivenOutlet) {
  HeldBorder land = heldBorder();
  // Water leaves where the land is highest, which what is held around does not reach.
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      land.outlets(x, y) = x == 0 && y > 20 && y < 40;
      if (land.held(x, y)) land.heights(x, y) = x < 8 ? 700.0f + x : 800.0f;
    }
  }
  cutOutlets(land.heights, land.held, {.outlets = land.outlets});
  for (int y = 8; y < 52; ++y)
    for (int x = 8; x < 52; ++x) ASSERT_GE(land.heights(x, y), 707.0f);
  EXPECT_EQ(floodedBeyond(land.heights, land.outlets), 0u);
}

TEST(CutOutlets, CountsPitsBehindWhatIsHeld) {
  HeldBorder land = heldBorder();
  // A pit in what is held, away from what is not.
  land.heights(3, 30) -= 100;
  EXPECT_GT(cutOutlets(land.heights, land.held, {.outlets = land.outlets}).left, 0);
  EXPECT_GT(floodedBeyond(land.heights, land.outlets), 0u);
}

TEST(CutOutlets, ATorusDrainsToItsLowestSample) {
  Grid<float> heights = ridges(64, 48, 9);
  cutOutlets(heights, {}, {.bank = 20, .wrapsX = true, .wrapsY = true});
  std::size_t lowest = 0;
  for (std::size_t s = 0; s < heights.count(); ++s)
    if (heights[s] < heights[lowest]) lowest = s;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (heights.index(x, y) == lowest) continue;
      bool falls = false;
      for (const Pixel& step : kNeighbors)
        falls = falls || heights[heights.wrapped(x + step.x, y + step.y)] < heights(x, y);
      ASSERT_TRUE(falls) << x << " " << y;
    }
  }
}

TEST(CutOutlets, HolesAreOutletsAndStop) {
  Grid<float> heights(30, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 30; ++x) heights(x, y) = static_cast<float>(std::hypot(x - 15, y - 15));
  heights(15, 15) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(cutOutlets(heights, {}).outlets, 0);
  EXPECT_TRUE(std::isnan(heights(15, 15)));
  std::atomic<bool> cancel = true;
  Grid<float> large = noise(300, 300, 3);
  EXPECT_THROW(cutOutlets(large, {}, {}, nullptr, Progress({}, &cancel)), Cancelled);
}

}  // namespace
}  // namespace exemplar
