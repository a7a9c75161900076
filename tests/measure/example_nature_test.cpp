// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/example_nature.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/example_shapes.h"
#include "tests/measure/fields.h"

namespace exemplar {
namespace {

TEST(ExampleNature, DistinguishesObjectsMaterialsAndGround) {
  for (const testing::ShapeKind& kind : testing::shapeKinds())
    for (const std::uint64_t seed : {0, 1, 2}) {
      const ExampleNature nature = natureOf(Occupancy(kind.make(kind.side, seed)));
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(seed));
      EXPECT_EQ(nature.freeStanding(), kind.freeStanding);
      const bool ground = std::string(kind.name) == "terrain";
      EXPECT_EQ(nature.fillsEvenly.x, !kind.freeStanding);
      EXPECT_EQ(nature.fillsEvenly.y, !kind.freeStanding);
      EXPECT_EQ(nature.fillsEvenly.z, !kind.freeStanding && !ground);
      for (int side = 0; side < 6; ++side) {
        const BoxSide expected = kind.freeStanding     ? BoxSide::Air
                                 : ground && side == 4 ? BoxSide::Solid
                                 : ground && side == 5 ? BoxSide::Air
                                                       : BoxSide::Cut;
        EXPECT_EQ(nature.sides[static_cast<std::size_t>(side)], expected) << side;
      }
    }
}

TEST(ExampleNature, OfABoxIsExact) {
  // Solid cells 5..14, 0..9 and 3..4 of 20 x 10 x 8.
  const ExampleNature nature =
      natureOf(Occupancy(testing::box({20, 10, 8}, {4.5, -5, 2.5}, {14.5, 15, 4.5})));
  EXPECT_EQ(nature.solid, (CellBox{{5, 0, 3}, {15, 10, 5}}));
  EXPECT_DOUBLE_EQ(nature.solidShare, 0.5 * 0.25);
  EXPECT_EQ(nature.sides[2], BoxSide::Cut);
  EXPECT_DOUBLE_EQ(nature.atSides[3], 0.125);
  EXPECT_DOUBLE_EQ(nature.quarters[0][1], 0.25);
  EXPECT_DOUBLE_EQ(nature.quarters[0][0], 0);
  EXPECT_TRUE(nature.fillsEvenly.y);
  EXPECT_FALSE(nature.fillsEvenly.x || nature.fillsEvenly.z || nature.freeStanding());
}

TEST(ExampleNature, OfNothing) {
  const ExampleNature nature = natureOf(Occupancy(testing::emptyField({8, 8, 8})));
  EXPECT_TRUE(nature.solid.empty());
  EXPECT_FALSE(nature.freeStanding() || nature.fillsEvenly.any());
}

}  // namespace
}  // namespace exemplar
