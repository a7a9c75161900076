// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/multiscale_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/error.h"
#include "tests/example_shapes.h"
#include "tests/measure/fields.h"
#include "tests/planted_faults.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

/// Fewer projections than usual: whole kinds are compared, at a tenth of the cost.
constexpr MultiscaleOptions kFew{.patches = 1500, .projections = 16};

double ratio(const DistanceField& example, const DistanceField& result) {
  return multiscaleDistance(example, result, kFew)->ratio;
}

TEST(MultiscaleDistance, OfTheExampleItselfIsBelowItsFloor) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    const DistanceField example = kind.make(48, 0);
    EXPECT_LT(ratio(example, example), 1) << kind.name;
  }
}

TEST(MultiscaleDistance, OfAFreshSampleIsNearTheFloorAndOfFaultsAboveIt) {
  for (const testing::ShapeKind& kind : testing::shapeKinds()) {
    const DistanceField example = kind.make(kind.side, 0);
    const double fresh = ratio(example, kind.make(kind.side, 1));
    EXPECT_LT(fresh, 2) << kind.name;
    // Two of it fused, and nothing of it but a ball in the same box.
    if (std::string(kind.name) != "terrain") {
      EXPECT_GT(ratio(example, testing::doubled(example)), 1.15 * fresh) << kind.name;
    }
    const Vec3i n = example.size();
    const DistanceField ball =
        testing::ball(n, cast<double>(n) * 0.5, 0.4 * std::min({n.x, n.y, n.z}));
    EXPECT_GT(ratio(example, ball), 2 * std::max(1.0, fresh)) << kind.name;
  }
}

TEST(MultiscaleDistance, SeesShardsAndALostFloor) {
  for (const char* name : {"vase", "village", "temple", "boulder"})
    for (const testing::ShapeKind& kind : testing::shapeKinds()) {
      if (kind.name != std::string(name)) continue;
      const DistanceField example = kind.make(kind.side, 0);
      const double itself = ratio(example, example);
      EXPECT_GT(ratio(example, testing::shards(example)), 2 * itself) << name;
      if (kind.name == std::string("boulder")) continue;
      EXPECT_GT(ratio(example, testing::lostFloor(example)), 1.5 * itself) << name;
    }
}

TEST(MultiscaleDistance, DoesNotAskForCopies) {
  // The same process, sampled again: far from every copy, and as near as halves are.
  const DistanceField example = testing::packing(64, 1);
  EXPECT_LT(ratio(example, testing::packing(64, 2)), 1.5);
  // Larger balls are not.
  EXPECT_GT(ratio(example, testing::shapeField(
                               {64, 64, 64},
                               [&](const Vec3d& p) { return example.values[cast<int>(p)] - 1.5; })),
            2.5);
}

TEST(MultiscaleDistance, LeavesOutScalesThatDoNotFit) {
  const auto scales = [](const DistanceField& field) {
    std::vector<int> all;
    const MultiscaleDistance found = *multiscaleDistance(field, field, kFew);
    for (const ScaleDistance& at : found.scales) all.push_back(at.scale);
    return all;
  };
  // Patches of 56 voxels in a box of 64 that cuts what it holds; beyond an object there is air.
  EXPECT_EQ(scales(testing::packing(64)), (std::vector{1, 2, 4}));
  EXPECT_EQ(scales(testing::vase(48)), (std::vector{1, 2, 4, 8}));
}

TEST(MultiscaleDistance, OfNothingIsNone) {
  const DistanceField empty = testing::emptyField({32, 32, 32}), example = testing::vase(32);
  EXPECT_FALSE(multiscaleDistance(example, empty));
  EXPECT_FALSE(multiscaleDistance(empty, example));
  DistanceField other = example;
  other.voxelSize = 2;
  EXPECT_THROW(multiscaleDistance(example, other), InputError);
}

TEST(MultiscaleDistance, IsTheSameAtOneAndEightThreads) {
  const DistanceField a = testing::village(40, 1), b = testing::village(48, 2);
  const auto measure = [&] {
    const MultiscaleDistance m = *multiscaleDistance(a, b, kFew);
    return std::array{m.ratio, m.scales[0].floor, m.scales[2].distance};
  };
  EXPECT_EQ(testing::onThreads(1, measure), testing::onThreads(8, measure));
}

}  // namespace
}  // namespace exemplar
