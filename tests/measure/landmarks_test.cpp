// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/landmarks.h"

#include <gtest/gtest.h>

#include "tests/example_shapes.h"
#include "tests/measure/fields.h"
#include "tests/planted_faults.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::castle;
using testing::makeField;

Landmarks counted(const DistanceField& example, const DistanceField& result) {
  return countLandmarks(Occupancy(example), Occupancy(result));
}

TEST(Landmarks, OfTheExampleItselfOccurOnce) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    const DistanceField example = kind.make(48, 0);
    const Landmarks landmarks = counted(example, example);
    for (const int times : landmarks.occurrences) EXPECT_EQ(times, 1) << kind.name;
    EXPECT_EQ(landmarks.repeated(), 0) << kind.name;
  }
}

TEST(Landmarks, OfADoubledTowerOccurTwice) {
  const DistanceField one = castle(66, {30});
  const Landmarks doubled = counted(one, castle(66, {18, 48}));
  ASSERT_TRUE(doubled.any());
  EXPECT_EQ(doubled.allowed, 1);
  EXPECT_GT(doubled.repeated(), 0.3);
  EXPECT_GE(doubled.most(), 2);
  // The wall goes on and the tower stays one.
  const Landmarks longer = counted(one, castle(132, {90}));
  EXPECT_EQ(longer.allowed, 2);
  EXPECT_EQ(longer.repeated(), 0);
  // Two towers may be, three are doubtful.
  EXPECT_LT(counted(one, castle(132, {30, 96})).repeated(), 0.1);
  EXPECT_GT(counted(one, castle(132, {24, 66, 108})).repeated(), 0.3);
}

TEST(Landmarks, OfATilingOccurInEachTile) {
  const DistanceField example = testing::boulder(48);
  const Vec3i n = example.size();
  const Landmarks tiled =
      counted(example, testing::rolledField(example, {0, 0, 0}, {2 * n.x, 2 * n.y, n.z}));
  ASSERT_TRUE(tiled.any());
  for (const int times : tiled.occurrences) EXPECT_EQ(times, 4);
  EXPECT_EQ(tiled.mean(), 4);
  EXPECT_EQ(tiled.repeated(), 1);
}

TEST(Landmarks, OfAFreshSampleOfTheProcessHardlyOccur) {
  // A copy has 1. Two balls beside each other are found again now and then.
  EXPECT_LT(counted(testing::packing(48, 0), testing::packing(48, 1)).mean(), 0.5);
  EXPECT_LT(counted(testing::porous(48, 0), testing::porous(48, 1)).mean(), 0.5);
}

TEST(Landmarks, AreNoneOfWhatIsAlikeEverywhereOrTooThin) {
  const DistanceField slab = makeField({40, 40, 40}, [](const Vec3d& p) { return p.z - 20; });
  EXPECT_FALSE(counted(slab, slab).any());
  const DistanceField thin = makeField({40, 40, 8}, [](const Vec3d& p) { return p.z - 4; });
  EXPECT_FALSE(counted(thin, thin).any());
  EXPECT_EQ(counted(testing::tree(48), thin).most(), 0);
}

TEST(Landmarks, AreTheSameAtAnyNumberOfThreads) {
  const DistanceField example = testing::village(48), result = testing::village(48, 1);
  testing::expectSameAtAnyThreads([&] { return counted(example, result).occurrences; });
}

}  // namespace
}  // namespace exemplar
