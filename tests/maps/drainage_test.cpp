// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/drainage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/random.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Heights of few different values, so that flats and ties abound, with some cells missing.
Grid<float> rubble(int width, int height, std::uint64_t seed, double holes = 0, int values = 7) {
  const Random random(seed);
  Grid<float> heights(width, height);
  for (std::size_t cell = 0; cell < heights.count(); ++cell) {
    heights[cell] = static_cast<float>(random.below(static_cast<std::uint32_t>(values), cell)) - 2;
    if (random.uniform(cell, 1) < holes) heights[cell] = kNan;
  }
  return heights;
}

Grid<float> made(int width, int height, const std::function<double(int, int)>& at) {
  Grid<float> heights(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) heights(x, y) = static_cast<float>(at(x, y));
  return heights;
}

template <class Body>
void forNeighborsOf(const Grid<float>& grid, int x, int y, const Body& body) {
  for (int n = 0; n < 8; ++n) {
    const Pixel at{x + kNeighbors[n].x, y + kNeighbors[n].y};
    if (grid.contains(at.x, at.y)) body(n, at);
  }
}

bool leaves(const Grid<float>& heights, int x, int y) {
  int data = 0;
  forNeighborsOf(heights, x, y, [&](int, Pixel at) { data += !std::isnan(heights(at.x, at.y)); });
  return data < 8;
}

/// Spill levels by lowering them until nothing changes.
Grid<float> loweredLevels(const Grid<float>& heights) {
  Grid<float> levels(heights.width(), heights.height(), kInfinity);
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 0; y < heights.height(); ++y) {
      for (int x = 0; x < heights.width(); ++x) {
        const float h = heights(x, y);
        float level = h;
        if (!std::isnan(h) && !leaves(heights, x, y)) {
          float least = kInfinity;
          forNeighborsOf(heights, x, y,
                         [&](int, Pixel at) { least = std::min(least, levels(at.x, at.y)); });
          level = std::max(h, least);
        }
        if (std::isnan(level) ? !std::isnan(levels(x, y)) : level < levels(x, y)) {
          levels(x, y) = level;
          changed = true;
        }
      }
    }
  }
  return levels;
}

void expectSameLevels(const Grid<float>& a, const Grid<float>& b) {
  ASSERT_TRUE(a.sameSize(b));
  for (std::size_t cell = 0; cell < a.count(); ++cell) {
    if (std::isnan(a[cell]) && std::isnan(b[cell])) continue;
    ASSERT_EQ(a[cell], b[cell]) << "cell " << cell;
  }
}

/// Where a cell drains to; outside of every map where that is nowhere.
Pixel downstream(const Drainage& drainage, Pixel at) {
  const std::uint8_t direction = drainage.directions(at.x, at.y);
  if (direction >= std::size(kNeighbors)) return {-1, -1};
  return {at.x + kNeighbors[direction].x, at.y + kNeighbors[direction].y};
}

TEST(Drainage, LevelsAreThoseOfRelaxation) {
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    const Random random(trial, 1);
    const int width = 1 + static_cast<int>(random.below(14, 0));
    const int height = 1 + static_cast<int>(random.below(14, 1));
    const Grid<float> heights = rubble(width, height, trial, trial % 3 == 0 ? 0.1 : 0);
    SCOPED_TRACE(trial);
    expectSameLevels(drain(heights).levels, loweredLevels(heights));
  }
}

TEST(Drainage, FlowsDownhillAndOffTheMap) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    const Grid<float> heights = rubble(23, 17, trial, trial % 2 ? 0.05 : 0, trial % 4 ? 5 : 1000);
    const Drainage drainage = drain(heights);
    std::vector<std::size_t> turn(heights.count(), heights.count());
    for (std::size_t n = 0; n < drainage.order.size(); ++n) turn[drainage.order[n]] = n;
    for (int y = 0; y < heights.height(); ++y) {
      for (int x = 0; x < heights.width(); ++x) {
        const std::uint8_t direction = drainage.directions(x, y);
        const std::size_t cell = heights.index(x, y);
        if (std::isnan(heights(x, y))) {
          EXPECT_EQ(direction, kNoData);
          EXPECT_EQ(turn[cell], heights.count());
          continue;
        }
        // The steepest fall of the level, and the first such neighbor.
        double steepest = 0;
        int to = -1;
        forNeighborsOf(heights, x, y, [&](int n, Pixel at) {
          const double fall = (double{drainage.levels(x, y)} - drainage.levels(at.x, at.y)) /
                              (n % 2 ? std::numbers::sqrt2 : 1);
          if (fall > steepest) {
            steepest = fall;
            to = n;
          }
        });
        if (to >= 0) {
          EXPECT_EQ(direction, to);
        }
        if (direction == kLeavesMap) {
          EXPECT_TRUE(leaves(heights, x, y));
          continue;
        }
        ASSERT_LT(direction, 8);
        const Pixel next = downstream(drainage, {x, y});
        EXPECT_LE(drainage.levels(next.x, next.y), drainage.levels(x, y));
        EXPECT_LT(turn[heights.index(next.x, next.y)], turn[cell]);  // so there is no loop
      }
    }
  }
}

TEST(Drainage, IsTheSameAtAnyNumberOfThreads) {
  const Grid<float> heights = rubble(120, 90, 5, 0.01, 40);
  testing::expectSameAtAnyThreads([&] {
    const Drainage drainage = drain(heights);
    return std::pair(drainage.directions, drainage.order);
  });
}

TEST(Drainage, KeepsToTheBottomOfADepression) {
  // A valley along x, 9 wide, that falls to x = 0 but for a dam; behind it the flow keeps to y = 4.
  const Grid<float> heights =
      made(40, 9, [](int x, int y) { return x + 30.0 * std::abs(y - 4) + (x == 10 ? 8.5 : 0); });
  const Drainage drainage = drain(heights);
  EXPECT_EQ(drainage.levels(12, 4), 18.5f);
  for (int x = 1; x < 39; ++x) EXPECT_EQ(drainage.directions(x, 4), 4) << x;
}

TEST(Drainage, KeepsToTheMiddleOfAFlat) {
  // A flat valley floor of 9 between walls, open at x = 0.
  const Grid<float> heights =
      made(40, 15, [](int x, int y) { return std::abs(y - 7) > 4 || x == 39 ? 50 : 1; });
  const Drainage drainage = drain(heights);
  for (int x = 10; x < 30; ++x) EXPECT_EQ(drainage.directions(x, 7), 4) << x;
  // What is at its edge goes to the middle before it goes on.
  const Grid<std::uint32_t> sum = flowAccumulation(drainage);
  for (int x = 10; x < 25; ++x) {
    for (int y = 3; y <= 11; ++y) {
      if (y != 7) {
        EXPECT_LT(4 * sum(x, y), sum(x, 7)) << x << " " << y;
      }
    }
  }
}

TEST(Drainage, WaterLeavesAtHoles) {
  Grid<float> bowl = made(21, 21, [](int x, int y) { return std::hypot(x - 10, y - 10); });
  EXPECT_EQ(drain(bowl).levels(10, 10), 10);
  bowl(10, 10) = kNan;
  const Drainage drainage = drain(bowl);
  EXPECT_TRUE(depressions(bowl, drainage.levels).empty());
  EXPECT_EQ(drainage.directions(11, 10), kLeavesMap);
}

TEST(Drainage, RefusesWhatIsNoMap) {
  EXPECT_THROW(drain({}), InputError);
  EXPECT_THROW(drain(Grid<float>(3, 3, kInfinity)), InputError);
  const std::atomic<bool> stop = true;
  EXPECT_THROW(drain(Grid<float>(3, 3), Progress({}, &stop)), Cancelled);
}

TEST(Depressions, FindWhatWasDug) {
  // A slope with three pits: 3 x 3 cells 5 deep, 1 cell 2 deep, and a shallow one of 2 cells.
  Grid<float> heights = made(60, 40, [](int x, int y) { return 100 + 0.001 * x + 0.0001 * y; });
  const Grid<float> slope = heights;
  for (int y = 10; y < 13; ++y)
    for (int x = 10; x < 13; ++x) heights(x, y) -= 5;
  heights(30, 20) -= 2;
  heights(50, 30) -= 0.5f;
  heights(51, 30) -= 0.5f;
  const Drainage drainage = drain(heights);
  const std::vector<Depression> found = depressions(heights, drainage.levels);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].cells, 9u);
  EXPECT_EQ(found[0].lowest, heights.index(10, 10));
  // It spills over its lowest neighbor, the northwest one.
  EXPECT_EQ(found[0].level, slope(9, 9));
  EXPECT_EQ(found[0].depth, slope(9, 9) - heights(10, 10));
  EXPECT_EQ(found[1].cells, 1u);
  EXPECT_EQ(found[2].cells, 2u);
  EXPECT_EQ(depressions(heights, drainage.levels, 1).size(), 2u);
  EXPECT_TRUE(depressions(slope, drain(slope).levels).empty());
}

TEST(FlowAccumulation, CountsWhatPassesThrough) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const Grid<float> heights = rubble(16, 19, trial, 0.03);
    const Drainage drainage = drain(heights);
    Grid<std::uint32_t> walked(16, 19);
    for (int y = 0; y < 19; ++y) {
      for (int x = 0; x < 16; ++x) {
        if (std::isnan(heights(x, y))) continue;
        Pixel at{x, y};
        for (;; at = downstream(drainage, at)) {
          ++walked(at.x, at.y);
          if (drainage.directions(at.x, at.y) == kLeavesMap) break;
        }
      }
    }
    EXPECT_EQ(flowAccumulation(drainage), walked);
  }
}

/// A binary tree of channels in a map without other data: a trunk from the bottom, which forks into
/// two every `reach` rows; heights rise along it. `depth` forks.
Grid<float> channelTree(int depth, int reach) {
  const int width = 4 << depth;
  Grid<float> heights(width, reach * (depth + 1), kNan);
  const std::function<void(int, int, int)> grow = [&](int x, int y, int forks) {
    const auto rise = [&](int from, int row) {
      return static_cast<float>(heights.height() - row + 0.001 * std::abs(from));
    };
    for (int row = y; row > y - reach; --row) heights(x, row) = rise(0, row);
    if (forks == 0) return;
    // Two arms to the sides along the topmost row, and on upwards from their ends.
    const int arm = 1 << forks;
    // They meet the trunk diagonally: a cell between them would be a source of its own.
    for (int dx = -arm; dx <= arm; ++dx) heights(x + dx, y - reach + 1) = rise(dx, y - reach + 1);
    heights(x, y - reach + 1) = kNan;
    grow(x - arm, y - reach, forks - 1);
    grow(x + arm, y - reach, forks - 1);
  };
  grow(width / 2, heights.height() - 1, depth);
  return heights;
}

TEST(StreamNetwork, NumbersAForkingTree) {
  const Drainage drainage = drain(channelTree(4, 4));
  const StreamNetwork network = streamNetwork(drainage, flowAccumulation(drainage), 1);
  EXPECT_EQ(network.streams, (std::vector<std::size_t>{16, 8, 4, 2, 1}));
  ASSERT_TRUE(network.bifurcationRatio());
  EXPECT_DOUBLE_EQ(*network.bifurcationRatio(), 2);
  EXPECT_EQ(network.orders(32, 19), 5);  // at its mouth
  EXPECT_GT(network.length(), network.lengths[0]);
}

TEST(StreamNetwork, AShortStreamDoesNotRaiseALongOne) {
  // A trunk with tributaries of one cell on alternate sides: order 1 flows into order 2 without
  // raising it.
  Grid<float> heights(5, 31, kNan);
  for (int y = 0; y < 31; ++y) heights(2, y) = static_cast<float>(31 - y);
  for (int y = 3; y < 28; y += 6) {
    heights(1, y) = heights(2, y) + 0.5f;
    heights(3, y + 3) = heights(2, y + 3) + 0.5f;
  }
  const Drainage drainage = drain(heights);
  const StreamNetwork network = streamNetwork(drainage, flowAccumulation(drainage), 1);
  EXPECT_EQ(network.streams, (std::vector<std::size_t>{11, 1}));
  EXPECT_DOUBLE_EQ(*network.bifurcationRatio(), 11);
}

TEST(StreamNetwork, AgreesWithTheRecursiveDefinition) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    const Grid<float> heights = rubble(40, 40, trial, 0.01, 1000);
    const Drainage drainage = drain(heights);
    const Grid<std::uint32_t> sum = flowAccumulation(drainage);
    constexpr std::uint32_t kThreshold = 4;
    const StreamNetwork network = streamNetwork(drainage, sum, kThreshold);
    std::vector<std::size_t> streams(network.streams.size());
    double length = 0;
    // The orders of the stream cells that flow into this one say its order.
    const std::function<int(Pixel)> orderOf = [&](Pixel at) {
      int highest = 0, times = 0;
      forNeighborsOf(heights, at.x, at.y, [&](int, Pixel from) {
        if (sum(from.x, from.y) < kThreshold) return;
        if (drainage.directions(from.x, from.y) >= 8 || downstream(drainage, from) != at) return;
        const int order = orderOf(from);
        if (order > highest) times = 0;
        highest = std::max(highest, order);
        times += order == highest;
      });
      return highest == 0 ? 1 : highest + (times > 1);
    };
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        const bool stream = sum(x, y) >= kThreshold;
        ASSERT_EQ(network.orders(x, y), stream ? orderOf({x, y}) : 0);
        if (!stream) continue;
        const std::uint8_t direction = drainage.directions(x, y);
        length += direction < 8 && direction % 2 ? std::numbers::sqrt2 : 1;
        const std::uint8_t order = network.orders(x, y);
        bool begins = true;
        forNeighborsOf(heights, x, y, [&](int, Pixel from) {
          if (network.orders(from.x, from.y) == order && downstream(drainage, from) == Pixel{x, y})
            begins = false;
        });
        streams[order - 1u] += begins;
      }
    }
    EXPECT_EQ(network.streams, streams);
    EXPECT_NEAR(network.length(), length, 1e-9 * length);
  }
}

TEST(FlowLines, CoverTheNetworkOnce) {
  const Grid<float> heights = rubble(50, 40, 3, 0.01, 1000);
  const Drainage drainage = drain(heights);
  const Grid<std::uint32_t> sum = flowAccumulation(drainage);
  // Every step of the network is in one line; what leaves the map is the length's other part.
  const StreamNetwork network = streamNetwork(drainage, sum, 3);
  double steps = 0, mouths = 0;
  for (const FlowLine& line : flowLines(drainage, sum, 3)) {
    steps += lengthOf(line, 50);
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
      const Pixel at{static_cast<int>(line[n] % 50), static_cast<int>(line[n] / 50)};
      const Pixel to = downstream(drainage, at);
      EXPECT_EQ(heights.index(to.x, to.y), line[n + 1]);
    }
  }
  for (std::size_t cell = 0; cell < heights.count(); ++cell)
    mouths += drainage.directions[cell] == kLeavesMap && sum[cell] >= 3;
  EXPECT_NEAR(steps + mouths, network.length(), 1e-9 * steps);
}

TEST(FlowLines, EndAtDepressions) {
  const auto valley = [](int x, int y) { return 0.1 * x + std::abs(y - 10); };
  Grid<float> heights = made(100, 21, valley);
  const auto longest = [](const Grid<float>& map, bool cut) {
    const Drainage drainage = drain(map);
    double most = 0;
    for (const FlowLine& line :
         flowLines(drainage, flowAccumulation(drainage), 40, cut ? &map : nullptr))
      most = std::max(most, lengthOf(line, map.width()));
    return most;
  };
  const double whole = longest(heights, true);
  EXPECT_GT(whole, 90);
  EXPECT_EQ(longest(heights, false), whole);
  heights(50, 10) -= 3;  // a pit in the middle of the bed
  EXPECT_LE(longest(heights, true), 52);
  EXPECT_EQ(longest(heights, false), whole);
}

TEST(FlowLines, OfTheNegatedMapFollowRidges) {
  const Grid<float> roof = made(80, 31, [](int x, int y) { return 0.05 * x - std::abs(y - 15); });
  const Drainage drainage = drain(negated(roof));
  const std::vector<FlowLine> lines = flowLines(drainage, flowAccumulation(drainage), 60);
  const auto longest =
      std::ranges::max_element(lines, {}, [](const FlowLine& line) { return line.size(); });
  ASSERT_NE(longest, lines.end());
  EXPECT_GT(longest->size(), 70u);
  for (const std::uint32_t cell : *longest) EXPECT_EQ(cell / 80, 15u);
}

}  // namespace
}  // namespace exemplar
