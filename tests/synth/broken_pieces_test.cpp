// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/broken_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

/// Balls of radius 4 in the middle of a 32 x 16 x 16 box: one at x = 8, one at x = 24.
DistanceField twoBalls() {
  DistanceField field = constant({32, 16, 16}, 0);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3d p = cast<double>(field.values.ijk(s));
    const double a = length(p - Vec3d{8, 8, 8}), b = length(p - Vec3d{24, 8, 8});
    field.values.values()[s] = static_cast<float>(std::min(a, b)) - 4;
  }
  return field;
}

Origins asItIs(const Vec3i& size) {
  Origins origins(size);
  for (std::size_t s = 0; s < origins.count(); ++s) origins.values()[s] = Origin(origins.ijk(s));
  return origins;
}

bool solid(const DistanceField& example, const Origins& origins, const Vec3i& p) {
  return example.values[origins[p].cell()] < 0;
}

std::int64_t solidSamples(const DistanceField& example, const Origins& origins) {
  std::int64_t count = 0;
  for (const Origin& origin : origins.values()) count += example.values[origin.cell()] < 0;
  return count;
}

TEST(BrokenPieces, WhatIsWholeStays) {
  const DistanceField example = twoBalls();
  Origins origins = asItIs(example.size());
  EXPECT_EQ(dropBrokenPieces(example, origins), 0);
  EXPECT_EQ(origins, asItIs(example.size()));
}

TEST(BrokenPieces, ThePartOfABallIsClearedAway) {
  // Of the second ball only what lies beyond x = 26 is left: the cap's samples come from the ball,
  // those before it from the air at the box's end.
  const DistanceField example = twoBalls();
  Origins origins = asItIs(example.size());
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const Vec3i p = origins.ijk(s);
    if (p.x >= 16 && p.x < 26) origins[p] = Origin(Vec3i{p.x - 16, 0, p.z});
  }
  const std::int64_t whole = solidSamples(example, asItIs(example.size())) / 2;
  const std::int64_t before = solidSamples(example, origins);
  ASSERT_GT(before, whole);
  EXPECT_EQ(dropBrokenPieces(example, origins), before - whole);
  EXPECT_EQ(solidSamples(example, origins), whole);
  EXPECT_TRUE(solid(example, origins, {8, 8, 8}));
  EXPECT_FALSE(solid(example, origins, {27, 8, 8}));
  for (const Origin& origin : origins.values()) {
    ASSERT_TRUE(example.values.contains(origin.cell()));
  }
  EXPECT_EQ(dropBrokenPieces(example, origins), 0);
}

TEST(BrokenPieces, ASpeckWithoutAirAmongItsNeighborsOffsetsGoesToo) {
  // All samples around show solid where the speck is: their offsets lead into the ball.
  const DistanceField example = twoBalls();
  Origins origins(Vec3i{9, 9, 9}, Origin({0, 0, 0}));
  origins(4, 4, 4) = Origin({8, 8, 8});
  for (const Vec3i& step : {Vec3i{1, 0, 0}, Vec3i{-1, 0, 0}, Vec3i{0, 1, 0}, Vec3i{0, -1, 0},
                            Vec3i{0, 0, 1}, Vec3i{0, 0, -1}}) {
    // Just outside the ball, on the side away from it: one step back lies in it.
    origins[Vec3i{4, 4, 4} + step] = Origin(Vec3i{8, 8, 8} + step * 4);
  }
  ASSERT_EQ(solidSamples(example, origins), 1);
  EXPECT_EQ(dropBrokenPieces(example, origins), 1);
  EXPECT_EQ(solidSamples(example, origins), 0);
}

TEST(BrokenPieces, WhatLeavesTheBoxStays) {
  const DistanceField example = twoBalls();
  Origins origins(Vec3i{4, 4, 4}, Origin({0, 0, 0}));
  origins(0, 2, 2) = Origin({8, 8, 8});
  EXPECT_EQ(dropBrokenPieces(example, origins), 0);
  origins(1, 2, 2) = origins(2, 1, 1) = Origin({8, 8, 8});
  EXPECT_EQ(dropBrokenPieces(example, origins), 1);  // (2, 1, 1) alone
}

TEST(BrokenPieces, WithoutWholePiecesTheLargestIsTheMeasure) {
  const DistanceField example = ground({24, 24, 16}, 1);
  Origins origins = asItIs(example.size());
  origins(12, 12, 14) = Origin({12, 12, 0});
  EXPECT_EQ(dropBrokenPieces(example, origins), 1);
  EXPECT_FALSE(solid(example, origins, {12, 12, 14}));
}

/// A heap: balls of radius 5.2 on a grid of 10, which pass into each other by thin necks.
DistanceField heap(const Vec3i& size) {
  DistanceField field = constant(size, 0);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3d p = cast<double>(field.values.ijk(s));
    double nearest = 1e9;
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 5; ++i)
          nearest = std::min(nearest, length(p - Vec3d{10.0 * i, 10.0 * j, 10.0 * k}));
    // The contacts are 0.2 deep.
    field.values.values()[s] = static_cast<float>(nearest - 5.2);
  }
  return field;
}

TEST(BrokenPieces, ASliverThatRestsOnABallGoesWithItsSkin) {
  const DistanceField example = heap({41, 41, 41});
  Origins origins = asItIs(example.size());
  Array3D<float> values = example.values;
  ASSERT_EQ(dropBrokenPieces(example, origins, {.values = &values}), 0);
  // Against a ball: 0.6 deep, but for its outer side.
  const std::array<Vec3i, 4> sliver{{{14, 14, 9}, {14, 14, 10}, {14, 14, 11}, {15, 14, 10}}};
  ASSERT_LT(values(13, 14, 10), 0);
  for (const Vec3i& p : sliver) {
    ASSERT_GT(values[p], 0);
    values[p] = p.x == 14 ? -0.6f : -0.3f;
    origins[p] = Origin({20, 20, 20});
  }
  EXPECT_EQ(dropBrokenPieces(example, origins), 0);  // seen from the surface all is one
  Origins cleared = origins;
  EXPECT_EQ(dropBrokenPieces(example, cleared, {.values = &values}), 4);
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const bool gone = std::ranges::count(sliver, origins.ijk(s)) > 0;
    ASSERT_EQ(cleared.values()[s] != origins.values()[s], gone);
    if (gone) {
      EXPECT_GE(example.values[cleared.values()[s].cell()], 0);
    }
  }
}

TEST(BrokenPieces, ABubbleIsFilled) {
  const DistanceField example = ground({24, 24, 16}, 1);
  Origins origins = asItIs(example.size());
  Vec3i deep{12, 12, 3};
  ASSERT_TRUE(solid(example, origins, deep));
  origins[deep] = Origin({12, 12, 15});
  ASSERT_FALSE(solid(example, origins, deep));
  EXPECT_EQ(dropBrokenPieces(example, origins), 1);
  EXPECT_TRUE(solid(example, origins, deep));
}

TEST(BrokenPieces, WhatIsFixedStays) {
  const DistanceField example = ground({24, 24, 16}, 1);
  Origins origins = asItIs(example.size());
  origins(12, 12, 14) = Origin({12, 12, 0});
  origins(12, 12, 3) = Origin({12, 12, 15});
  const Array3D<std::uint8_t> fixed(origins.size(), 1);
  EXPECT_EQ(dropBrokenPieces(example, origins, {.fixed = &fixed}), 0);
}

TEST(BrokenPieces, WithoutAirNothingChanges) {
  const DistanceField example = constant({8, 8, 8}, -2);
  Origins origins = asItIs(example.size());
  EXPECT_EQ(dropBrokenPieces(example, origins), 0);
}

}  // namespace
}  // namespace exemplar
