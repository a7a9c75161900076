// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/stationary.h"

#include <gtest/gtest.h>

#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

TEST(StationaryAxes, BallsRepeatAlongAllAxes) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    EXPECT_EQ(findStationaryAxes(balls({40, 40, 40}, 4, seed)), (Axes{true, true, true}));
  }
}

TEST(StationaryAxes, GroundHasItsPlaceAlongZ) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    EXPECT_EQ(findStationaryAxes(ground({40, 40, 24}, seed)), (Axes{true, true, false}));
  }
}

TEST(StationaryAxes, AWallHasItsPlaceAcross) {
  // Solid in the middle third along y.
  DistanceField wall = constant({24, 24, 24}, 2);
  for (std::size_t s = 0; s < wall.values.count(); ++s) {
    const int y = wall.values.ijk(s).y;
    if (y >= 8 && y < 16) wall.values.values()[s] = -2;
  }
  EXPECT_EQ(findStationaryAxes(wall), (Axes{true, false, true}));
}

TEST(StationaryAxes, NothingAndEverythingAreTheSameEverywhere) {
  EXPECT_EQ(findStationaryAxes(constant({9, 3, 1}, 1)), Axes::every());
  EXPECT_EQ(findStationaryAxes(constant({9, 3, 1}, -1)), Axes::every());
}

TEST(StationaryAxes, OfSeveralAreThoseOfAll) {
  const DistanceField all = balls({40, 40, 40}, 4, 0), across = ground({40, 40, 24}, 0);
  const DistanceField* examples[] = {&all, &across};
  EXPECT_EQ(stationaryAxes(examples), (Axes{true, true, false}));
  // Of the first only what is kept counts: here a lower half that is full.
  DistanceField heap = all;
  Array3D<std::uint8_t> kept(heap.size(), 1);
  for (std::size_t s = 0; s < kept.count(); ++s) {
    if (heap.values.ijk(s).z >= 20) continue;
    heap.values.values()[s] = -4;
    kept.values()[s] = 0;
  }
  const DistanceField* one[] = {&heap};
  EXPECT_FALSE(stationaryAxes(one).z);
  EXPECT_TRUE(stationaryAxes(one, &kept).z);
}

}  // namespace
}  // namespace exemplar
