// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/seams.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/measure/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ball;
using testing::ballPacking;
using testing::emptyField;
using testing::gathered;
using testing::makeField;
using testing::makeOrigins;
using testing::noise;

TEST(EikonalResidual, IsZeroForADistanceAndNotForNoise) {
  const Vec3i n{32, 32, 32};
  const Vec3d normal = normalized(Vec3d{1, 2, 2});
  const DistanceField plane = makeField(n, [&](const Vec3d& p) {
    return dot(p - Vec3d{16, 16, 16}, normal);
  });
  // Central differences of a linear field, in floats of size 30: 30 * 2^-24 * 2.
  EXPECT_LT(*measureSeams(plane, plane).eikonalResidual, 1e-5);
  // At distance d from the center of a ball the central difference is short by about 1 / (3 d²).
  const DistanceField round = ball(n, {16, 16, 16}, 9);
  EXPECT_LT(*measureSeams(round, round).eikonalResidual, 1.0 / (3 * 6 * 6));

  DistanceField doubled = plane;
  for (float& v : doubled.values.values()) v *= 2;
  EXPECT_NEAR(*measureSeams(plane, doubled).eikonalResidual, 1, 1e-5);
  EXPECT_LT(*measureSeams(plane, doubled).exampleEikonalResidual, 1e-5);
  EXPECT_GT(*measureSeams(plane, noise(n, 0.5, 1)).eikonalResidual, 0.3);
}

TEST(EikonalResidual, IsNotSpoiltByTruncation) {
  DistanceField plane =
      makeField({32, 32, 32}, [](const Vec3d& p) { return std::clamp(p.z - 15.5, -3.0, 3.0); });
  plane.truncation = 3;
  EXPECT_LT(*measureSeams(plane, plane).eikonalResidual, 1e-5);
  plane.truncation = std::numeric_limits<float>::infinity();  // claimed exact, and is not
  EXPECT_GT(*measureSeams(plane, plane).eikonalResidual, 0.05);
}

TEST(EikonalResidual, IsAbsentWithoutASurface) {
  const DistanceField nothing = emptyField({8, 8, 8});
  EXPECT_FALSE(measureSeams(nothing, nothing).eikonalResidual);
}

TEST(SeamJump, IsAbsentWithoutOriginsAndZeroWithoutSeams) {
  const DistanceField example = ballPacking({24, 24, 24}, 1);
  EXPECT_FALSE(measureSeams(example, example).jump);
  const Origins origins = makeOrigins(example.size(), [](const Vec3i& p) { return Origin(p); });
  const Seams seams = measureSeams(example, example, &origins);
  EXPECT_EQ(seams.jump, 0);
  EXPECT_EQ(seams.jumpRatio, 0);
  EXPECT_EQ(seams.seamShare, 0);
}

TEST(SeamJump, IsTheStepBetweenWhatBothSourcesSay) {
  // Layers at z in the example; the result's right half is two voxels higher: at the seam a says
  // that b equals it and the result says that b is 2 less, wherever b is inside the band.
  const DistanceField example = makeField({16, 8, 40}, [](const Vec3d& p) { return p.z - 20; });
  const Origins origins = makeOrigins({16, 8, 30}, [](const Vec3i& p) {
    return Origin({p.x, p.y, p.x < 8 ? p.z + 5 : p.z + 3});
  });
  const DistanceField result = gathered(example, origins);
  const Seams seams = measureSeams(example, result, &origins);
  EXPECT_DOUBLE_EQ(*seams.jump, 2);
  EXPECT_DOUBLE_EQ(*seams.nearJump, 2);
  // One plane of 8 * 30 faces of all.
  EXPECT_DOUBLE_EQ(*seams.seamShare, 240.0 / (15 * 8 * 30 + 16 * 7 * 30 + 16 * 8 * 29));
  // The example is linear: there is nothing to compare with.
  EXPECT_FALSE(seams.jumpRatio);
}

TEST(SeamJump, OfASeamWhereBothSidesAgreeIsZero) {
  // A result whose right half comes from elsewhere in an example that is the same there.
  const DistanceField example = makeField({40, 8, 20}, [](const Vec3d& p) { return p.z - 10; });
  const Origins origins = makeOrigins({20, 8, 20}, [](const Vec3i& p) {
    return Origin({p.x < 10 ? p.x + 4 : p.x + 17, p.y, p.z});
  });
  const Seams seams = measureSeams(example, gathered(example, origins), &origins);
  EXPECT_EQ(seams.jump, 0);
  EXPECT_GT(seams.seamShare, 0);
}

TEST(SeamJump, RatioIsToTheExamplesOwnSecondDifference) {
  const DistanceField example = ballPacking({32, 32, 32}, 1);
  // Blocks of 8³ in disorder: jumps far beyond the example's own curvature.
  const Origins blocks = makeOrigins({32, 32, 32}, [](const Vec3i& p) {
    return Origin({(p.x + 8) % 32, (p.y + 16) % 32, (p.z / 8 * 3 + 1) % 4 * 8 + p.z % 8});
  });
  const Seams seams = measureSeams(example, gathered(example, blocks), &blocks);
  EXPECT_GT(*seams.jumpRatio, 3);
  EXPECT_GT(*seams.nearJumpRatio, 3);
  EXPECT_NEAR(*seams.jumpRatio * *measureSeams(example, example, &blocks).jump,
              *seams.jump * *measureSeams(example, example, &blocks).jumpRatio, 1e-9);
}

TEST(SeamJump, SeamsInEmptySpaceDoNotDiluteWhatIsNearTheSurface) {
  DistanceField example =
      makeField({48, 12, 48}, [](const Vec3d& p) { return std::clamp(p.z - 8.2, -3.0, 3.0); });
  example.truncation = 3;
  // Steps of one voxel between columns of 8 cells, below; above, every cell from anywhere empty.
  const auto scattered = [](bool scatter) {
    return [=](const Vec3i& p) {
      if (scatter && p.z > 20) return Origin({(p.x * 7) % 48, p.y, 20 + (p.z * 5 + p.x) % 28});
      return Origin({p.x, p.y, std::max(0, p.z - p.x / 8 % 2)});
    };
  };
  const Origins tidy = makeOrigins(example.size(), scattered(false));
  const Origins untidy = makeOrigins(example.size(), scattered(true));
  const Seams a = measureSeams(example, gathered(example, tidy), &tidy);
  const Seams b = measureSeams(example, gathered(example, untidy), &untidy);
  EXPECT_LT(*b.jump, 0.5 * *a.jump);
  EXPECT_DOUBLE_EQ(*b.nearJump, *a.nearJump);
}

TEST(SeamJump, FollowsTurns) {
  const DistanceField example = ballPacking({16, 16, 16}, 1);
  for (int turns = 1; turns < 4; ++turns) {
    // The left half turned, the right half too: one seam through a result that is otherwise whole.
    const Origins origins = makeOrigins({16, 16, 16}, [&](const Vec3i& p) {
      Vec3i c = p;
      for (int t = 0; t < turns; ++t) c = {c.y, 15 - c.x, c.z};
      return Origin(c, 0, turns);
    });
    EXPECT_EQ(measureSeams(example, gathered(example, origins), &origins).seamShare, 0) << turns;
  }
}

TEST(SeamJumps, AreWhereTheSourceChangesAndNowhereElse) {
  // The two halves of above: a step of two voxels where they meet, at x = 7 and 8.
  const DistanceField example = makeField({16, 8, 40}, [](const Vec3d& p) { return p.z - 20; });
  const Origins origins = makeOrigins({16, 8, 30}, [](const Vec3i& p) {
    return Origin({p.x, p.y, p.x < 8 ? p.z + 5 : p.z + 3});
  });
  const DistanceField result = gathered(example, origins);
  const Array3D<float> jumps = seamJumps(example, result, origins);
  ASSERT_EQ(jumps.size(), result.size());
  for (std::size_t n = 0; n < jumps.count(); ++n) {
    const Vec3i p = jumps.ijk(n);
    ASSERT_EQ(jumps.values()[n], p.x == 7 || p.x == 8 ? 2.0f : 0.0f) << p.x << " " << p.y;
  }
  EXPECT_THROW(seamJumps(example, example, origins), InputError);
}

TEST(Seams, RefuseOriginsThatDoNotFit) {
  const DistanceField example = ball({16, 16, 16}, {8, 8, 8}, 5);
  Origins origins(Vec3i{16, 16, 15});
  EXPECT_THROW(measureSeams(example, example, &origins), InputError);
  origins = Origins(Vec3i{16, 16, 16}, Origin({16, 0, 0}));
  EXPECT_THROW(measureSeams(example, example, &origins), InputError);
}

TEST(Seams, AreTheSameAtOneAndEightThreads) {
  const DistanceField example = ballPacking({32, 32, 32}, 1);
  const Origins origins = makeOrigins({40, 40, 33}, [](const Vec3i& p) {
    return Origin({p.x * 7 % 32, p.y % 32, p.z * 3 % 32});
  });
  const DistanceField result = gathered(example, origins);
  const auto measure = [&] {
    const Seams s = measureSeams(example, result, &origins);
    return std::array{*s.jump, *s.nearJumpRatio, *s.eikonalResidual, *s.seamShare};
  };
  EXPECT_EQ(testing::onThreads(1, measure), testing::onThreads(8, measure));
}

}  // namespace
}  // namespace exemplar
