// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/origin.h"

#include <gtest/gtest.h>

namespace exemplar {
namespace {

TEST(Turned, TurnsAnticlockwiseSeenFromAboveAndBack) {
  EXPECT_EQ(turned(Vec3i{1, 0, 5}, 1), (Vec3i{0, 1, 5}));
  EXPECT_EQ(turned(Vec3i{1, 0, 5}, 2), (Vec3i{-1, 0, 5}));
  EXPECT_EQ(turned(Vec3i{1, 0, 5}, 3), (Vec3i{0, -1, 5}));
  for (int turns = 0; turns < 4; ++turns) {
    EXPECT_EQ(turned(turned(Vec3i{3, -7, 2}, turns), -turns), (Vec3i{3, -7, 2}));
  }
}

TEST(OriginMotion, TakesItsCellToTheOriginAndBack) {
  for (int turns = 0; turns < 4; ++turns) {
    const Vec3i cell{4, 9, 2}, source{30, 5, 17};
    const OriginMotion motion(Origin(source, 3, turns), cell);
    EXPECT_EQ(motion.toExample(cell), source);
    EXPECT_EQ(motion.toResult(cast<double>(source)), cast<double>(cell));
    EXPECT_EQ(motion.example, 3);
    // A step in the result is the same step turned back in the example.
    EXPECT_EQ(motion.toExample(cell + Vec3i{1, 0, 0}) - source, turned(Vec3i{1, 0, 0}, -turns));
    EXPECT_EQ(motion.directionToResult(motion.directionToExample(Vec3d{1, 2, 3})),
              (Vec3d{1, 2, 3}));
  }
}

TEST(OriginMotion, IsTheSameForAllCellsOfOneCopiedPartOnly) {
  for (int turns = 0; turns < 4; ++turns) {
    const OriginMotion whole(Origin(Vec3i{20, 20, 20}, 0, turns), {0, 0, 0});
    for (const Vec3i& cell : {Vec3i{1, 0, 0}, Vec3i{0, 1, 0}, Vec3i{5, 3, 2}}) {
      EXPECT_EQ(OriginMotion(Origin(whole.toExample(cell), 0, turns), cell), whole);
      EXPECT_FALSE(OriginMotion(Origin(whole.toExample(cell) + Vec3i{0, 0, 1}, 0, turns), cell) ==
                   whole);
    }
  }
}

}  // namespace
}  // namespace exemplar
