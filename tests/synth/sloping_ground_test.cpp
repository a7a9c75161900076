// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/sloping_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

TEST(IsSlopingGround, SaysSoOfASlopeNotOfLevelGroundOrAnObject) {
  DistanceField slope = constant({24, 24, 20}, 0), level = slope;
  for (std::size_t s = 0; s < slope.values.count(); ++s) {
    const Vec3i p = slope.values.ijk(s);
    slope.values.values()[s] = static_cast<float>(p.z - 5.0 - p.x / 4.0);
    level.values.values()[s] = static_cast<float>(p.z - 8.0 - std::sin(p.x * 1.3));
  }
  EXPECT_TRUE(isSlopingGround(slope));
  EXPECT_FALSE(isSlopingGround(level));
  EXPECT_FALSE(isSlopingGround(balls({24, 24, 20}, 4, 1)));
}

}  // namespace
}  // namespace exemplar
