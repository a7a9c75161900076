// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/tile_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/error.h"

namespace exemplar {
namespace {

TEST(TileRange, ReadsTilesAndRegions) {
  EXPECT_EQ(parseTile("3,-2"), (PlanePoint{3, -2}));
  EXPECT_EQ(parseTileRange("0:16,-4:4"), (PlaneBox{{0, -4}, {16, 4}}));
  EXPECT_EQ(tileRangeText(parseTileRange("0:16,-4:4")), "0:16,-4:4");
  EXPECT_EQ(parseTile("-1048576,1048575"), (PlanePoint{-kMostTiles, kMostTiles - 1}));
}

TEST(TileRange, RefusesEverythingElse) {
  for (const char* text : {"", "3", "3,", "3,4,5", "a,b", "1.5,2", "3 ,4", "1048576,0",
                           "0,-1048577", "99999999999999999999,0"})
    EXPECT_THROW(parseTile(text), InputError) << text;
  for (const char* text : {"", "0:4", "0:4,0:0", "4:0,0:4", "0:4,0:4,0:4", "0-4,0-4", "0:4,0:4 ",
                           "0:1048577,0:1", "-1048577:0,0:1"})
    EXPECT_THROW(parseTileRange(text), InputError) << text;
}

TEST(TileRange, JobsCoverARegionOnceAndNearOnesFollowEachOther) {
  const PlaneBox region{{-5, 3}, {9, 12}};
  std::set<PlanePoint> seen;
  for (const PlaneBox& job : jobsOf(region, 4)) {
    EXPECT_LE(job.size(0), 4);
    EXPECT_LE(job.size(1), 4);
    for (const PlanePoint& tile : tilesOf(job)) {
      EXPECT_TRUE(region.contains(tile));
      EXPECT_TRUE(seen.insert(tile).second);
    }
  }
  EXPECT_EQ(static_cast<std::int64_t>(seen.size()), region.columns());

  // In Morton order each quarter of a square is done before the next begins.
  const std::vector<PlaneBox> jobs = jobsOf({{0, 0}, {8, 8}}, 1);
  for (std::size_t n = 0; n < 16; ++n) {
    EXPECT_LT(jobs[n].begin.x, 4);
    EXPECT_LT(jobs[n].begin.y, 4);
  }
}

}  // namespace
}  // namespace exemplar
