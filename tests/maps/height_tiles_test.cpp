// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/height_tiles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "tests/maps/made_maps.h"

namespace exemplar {
namespace {

using test::hills;
using test::makeMap;

constexpr double kCell = 0.25;

HeightMap land() { return makeMap(64, 48, kCell, hills); }

/// A part of the land, from a column and a row on, where it lies.
HeightMap tile(int column, int row, int width, int height) {
  const HeightMap whole = land();
  HeightMap part{Grid<float>(width, height), kCell, true};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) part.heights(x, y) = whole.at(column + x, row + y);
  part.corner = MapCorner{1000 + column * kCell, 2000 + (48 - row - height) * kCell};
  return part;
}

TEST(HeightTiles, SideBySideFitOnWholeCells) {
  const HeightMap west = tile(0, 0, 32, 48), east = tile(32, 0, 32, 48);
  const TilePlace place = placeOf(east, west);
  EXPECT_EQ(place.fit, TileFit::Fits);
  EXPECT_DOUBLE_EQ(place.east, 32);
  EXPECT_DOUBLE_EQ(place.north, 0);
  EXPECT_EQ(placeOf(west, east).fit, TileFit::Fits);
  // Along y, and where they overlap.
  EXPECT_EQ(placeOf(tile(0, 20, 64, 28), tile(0, 0, 64, 20)).fit, TileFit::Fits);
  EXPECT_EQ(placeOf(tile(30, 0, 34, 48), west).fit, TileFit::Fits);
  EXPECT_EQ(placeOf(tile(30, 0, 34, 48), west).across, 0);
}

TEST(HeightTiles, OthersAreApartOffTheGridOrDisagree) {
  const HeightMap west = tile(0, 0, 32, 48), east = tile(32, 0, 32, 48);
  HeightMap moved = east;
  moved.corner->south += 0.4 * kCell;
  EXPECT_EQ(placeOf(moved, west).fit, TileFit::OffGrid);
  moved = east;
  moved.corner->west += 3 * kCell;
  EXPECT_EQ(placeOf(moved, west).fit, TileFit::Apart);
  moved = east;
  moved.corner = west.corner;  // maps whose corners say nothing
  EXPECT_EQ(placeOf(moved, west).fit, TileFit::Apart);
  moved.corner.reset();
  EXPECT_EQ(placeOf(moved, west).fit, TileFit::Apart);
  // In feet.
  HeightMap feet = east;
  for (float& h : feet.heights.values()) h *= 3.28f;
  const TilePlace place = placeOf(feet, west);
  EXPECT_EQ(place.fit, TileFit::Disagrees);
  EXPECT_GT(place.across, 4 * place.usual);
}

TEST(HeightTiles, JoinedAreTheMapThatTheyArePartsOf) {
  const HeightMap whole = land();
  const HeightMap tiles[] = {tile(0, 0, 32, 30), tile(30, 0, 34, 30), tile(0, 29, 64, 19)};
  const HeightMap joined = joinedTiles(tiles);
  EXPECT_EQ(joined.heights, whole.heights);
  EXPECT_EQ(joined.corner, (MapCorner{1000, 2000}));
  EXPECT_EQ(joined.cellSize, kCell);
  // Where no tile lies there is no data.
  const HeightMap cornerless = joinedTiles(std::span(tiles).subspan(1));
  ASSERT_EQ(cornerless.height(), 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool missing = y < 29 && x < 30;
      ASSERT_EQ(std::isnan(cornerless.at(x, y)), missing) << x << " " << y;
    }
  }
}

TEST(HeightTiles, WithTooMuchBetweenThemAreRefused) {
  HeightMap far = tile(0, 0, 32, 30);
  far.corner = MapCorner{1000 + 1e6 * kCell, 2000 + 1e6 * kCell};
  const HeightMap tiles[] = {tile(0, 0, 32, 30), far};
  EXPECT_THROW(joinedTiles(tiles), InputError);
}

}  // namespace
}  // namespace exemplar
