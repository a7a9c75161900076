// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/label_world.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "synth/model/examples.h"
#include "tests/grid_share.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

constexpr int kTile = 24;

/// An example, what a world of it begins with, and its rules.
struct Rules {
  explicit Rules(LabelGrid grid) : example(std::move(grid)), adjacency(findAdjacency(example)) {
    options.size = example.size();
    options.seed = 3;
    options.moves = 2;
    ModelResult made = labelWorldStart({&example, 1}, adjacency, options);
    EXPECT_EQ(made.outcome, Outcome::Complete);
    start = made.grid();
  }
  LabelWorld world(WindowCache& cache, int pitch = 24) const {
    return LabelWorld({example}, adjacency, options, start, {.pitch = pitch}, cache);
  }

  LabelGrid example;
  Adjacency adjacency;
  ModelOptions options;
  LabelGrid start;
};

const Rules& cityRules() {
  static const Rules rules(test::city());
  return rules;
}

using Tiles = std::map<PlanePoint, std::vector<Label>>;

Tiles tilesInOrder(const LabelWorld& world, const std::vector<PlanePoint>& order) {
  Tiles tiles;
  for (const PlanePoint& t : order) {
    const PlaneBox box{{t.x * kTile, t.y * kTile}, {(t.x + 1) * kTile, (t.y + 1) * kTile}};
    const LabelGrid grid = world.region(box);
    tiles[t].assign(grid.cells.values().begin(), grid.cells.values().end());
  }
  return tiles;
}

std::vector<PlanePoint> someTiles() {
  std::vector<PlanePoint> tiles;
  for (int x = -1; x < 2; ++x)
    for (int y = -1; y < 2; ++y) tiles.push_back({x, y});
  return tiles;
}

TEST(LabelWorld, TilesAreTheSameInAnyOrderAndAtAnyNumberOfThreads) {
  const Rules& rules = cityRules();
  std::vector<PlanePoint> order = someTiles();
  WindowCache cache(1);
  const LabelWorld world = rules.world(cache);
  const Tiles expected = tilesInOrder(world, order);

  std::reverse(order.begin(), order.end());
  for (const int threads : {1, 8}) {
    // A memory of nothing makes everything anew.
    WindowCache own(1, {.capacity = threads == 1 ? std::size_t{1} : std::size_t{1} << 30});
    const LabelWorld again = rules.world(own);
    tbb::task_arena arena(threads);
    arena.execute([&] { EXPECT_EQ(tilesInOrder(again, order), expected) << threads; });
    std::swap(order[0], order[4]);
    std::swap(order[1], order[7]);
  }
}

TEST(LabelWorld, APartOfARegionIsTheTileMadeAlone) {
  const Rules& rules = cityRules();
  WindowCache one(1), other(1);
  const LabelGrid region = rules.world(one).region({{-kTile, -kTile}, {2 * kTile, 2 * kTile}});
  const LabelGrid alone = rules.world(other).region({{0, 0}, {kTile, kTile}});
  forEachCell(alone.size(), [&](const Vec3i& p) {
    ASSERT_EQ(alone.cells[p], (region.cells[p + Vec3i{kTile, kTile, 0}]));
  });
}

TEST(LabelWorld, BreaksNoRuleAnywhere) {
  for (const LabelGrid& example : {test::city(), test::canyon(), test::gadgets()}) {
    const Rules rules(example);
    WindowCache cache(1);
    const LabelGrid region = rules.world(cache).region({{-40, -20}, {20, 40}});
    const AdjacencyViolations found = findViolations(region, example);
    EXPECT_GT(found.pairs, 36'000);
    EXPECT_EQ(found.count, 0);
  }
}

TEST(LabelWorld, DoesNotRepeatWhatItBeginsWith) {
  const Rules rules(test::canyon());
  const int n = rules.start.size().x;
  WindowCache cache(1);
  const LabelGrid all = rules.world(cache, 36).region({{0, 0}, {n + 60, 48}});
  // The share of columns that are alike so far apart.
  const auto alike = [&](int along, int across) {
    int same = 0;
    for (int x = 0; x < 48; ++x) {
      for (int y = 0; y < 40; ++y) {
        bool equal = true;
        for (int z = 0; z < all.size().z; ++z)
          equal = equal && all.cells[{x, y, z}] == all.cells[{x + along, y + across, z}];
        same += equal;
      }
    }
    return same / (48.0 * 40);
  };
  double most = 0;
  for (int along = 40; along < n + 12; along += 5)
    for (int across = 1; across < 8; across += 3) most = std::max(most, alike(along, across));
  // No more than by chance; all of them if no window had been modified.
  EXPECT_LE(alike(n, 0), most);
}

/// Which share of the labels of each column along x the next one does not have.
std::vector<double> changesOf(const LabelGrid& grid) {
  const Vec3i size = grid.size();
  std::vector<double> changes;
  for (int x = 0; x + 1 < size.x; ++x) {
    int different = 0;
    for (int y = 0; y < size.y; ++y)
      for (int z = 0; z < size.z; ++z)
        different += grid.cells[{x, y, z}] != grid.cells[{x + 1, y, z}];
    changes.push_back(static_cast<double>(different) / (size.y * size.z));
  }
  return changes;
}

TEST(LabelWorld, NoGridOfWindowsShows) {
  const Rules& rules = cityRules();
  constexpr int kPitch = 24;
  WindowCache cache(1);
  LabelGrid strip = rules.world(cache, kPitch).region({{0, 0}, {12 * kPitch + 1, 48}});
  EXPECT_LT(testing::gridShare(changesOf(strip), kPitch), 0.1);
  // It does where every window ends with columns that are alike.
  for (int x = kPitch; x < strip.size().x; ++x) {
    if (x % kPitch < kPitch - 4) continue;
    for (int y = 0; y < strip.size().y; ++y)
      for (int z = 0; z < strip.size().z; ++z) strip.cells[{x, y, z}] = strip.cells[{x - 1, y, z}];
  }
  EXPECT_GT(testing::gridShare(changesOf(strip), kPitch), 0.1);
}

TEST(LabelWorld, HoldsWhatTheExampleHolds) {
  const Rules& rules = cityRules();
  WindowCache cache(1);
  const LabelGrid region = rules.world(cache).region({{0, 0}, {96, 96}});
  // As near to the example's shares of labels as what it began with, but for a twentieth.
  EXPECT_LT(shareDifference(region, {&rules.example, 1}),
            shareDifference(rules.start, {&rules.example, 1}) + 0.05);
  const std::set<Label> shown(region.cells.values().begin(), region.cells.values().end());
  const std::set<Label> begun(rules.start.cells.values().begin(), rules.start.cells.values().end());
  EXPECT_GE(shown.size(), begun.size() * 9 / 10);
}

TEST(LabelWorld, RefusesWhatSpeaksOfAWhole) {
  const Rules& rules = cityRules();
  WindowCache cache(1);
  const auto refused = [&](const ModelOptions& options, const std::string& key) {
    try {
      requireLocal(options);
    } catch (const InputError& e) {
      return std::string(e.what()).find("`" + key + "`") != std::string::npos;
    }
    return false;
  };
  ModelOptions options = rules.options;
  EXPECT_NO_THROW(requireLocal(options));
  options.counts.push_back({{1}, 3, {}});
  EXPECT_TRUE(refused(options, "count"));
  options = rules.options;
  options.connected.push_back({1});
  EXPECT_TRUE(refused(options, "connect"));
  options = rules.options;
  options.periodic.x = true;
  EXPECT_TRUE(refused(options, "periodic"));
  options = rules.options;
  options.pins.push_back({{0, 0, 0}, {1}});
  EXPECT_TRUE(refused(options, "pin"));
}

TEST(LabelWorld, AnExampleThatCannotRepeatIsImpossible) {
  // Each label is followed by the next one, and the last one by none.
  LabelGrid rows = test::drawnFlat({"abcd", "efgh"});
  ModelOptions options;
  options.size = {1, 1, 1};
  EXPECT_EQ(labelWorldStart({&rows, 1}, findAdjacency(rows), options).outcome, Outcome::Impossible);
  const LabelGrid row = test::drawnFlat({"abcabc"});
  EXPECT_THROW(labelWorldStart({&row, 1}, findAdjacency(row), options), InputError);
}

}  // namespace
}  // namespace exemplar
