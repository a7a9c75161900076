// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/repetition.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

TEST(Repetition, FindsTheStepsOfALatticeBetweenSamples) {
  const std::array<Vec3d, 3> steps{{{8.4, 0, 0}, {0, 7.3, 0}, {0, 0, 6.5}}};
  const Repetition found = findRepetition(lattice({30, 28, 26}, steps, 2.2, 0).values);
  ASSERT_EQ(found.basis.size(), 3u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(found.periodAlong(axis), steps[static_cast<std::size_t>(axis)][axis], 0.15);
  }
}

TEST(Repetition, FindsItWherePartsAreALittleOutOfPlace) {
  const std::array<Vec3d, 3> steps{{{8, 0, 0}, {0, 8, 0}, {0, 0, 8}}};
  const Repetition found = findRepetition(lattice({32, 32, 32}, steps, 2.5, 0.4).values);
  ASSERT_EQ(found.basis.size(), 3u);
  EXPECT_TRUE(found.holds({16, -8, 24}, 0.5));
  EXPECT_FALSE(found.holds({12, 0, 0}, 0.5));
}

TEST(Repetition, FindsStepsThatAreNotAlongTheAxes) {
  // Every other row is moved on by half a step, as bricks are.
  const std::array<Vec3d, 3> steps{{{9, 0, 0}, {4.5, 6, 0}, {0, 0, 7}}};
  const Repetition found = findRepetition(lattice({36, 30, 24}, steps, 2.2, 0).values);
  ASSERT_EQ(found.basis.size(), 3u);
  EXPECT_TRUE(found.holds({9, 12, 7}, 1));
  EXPECT_TRUE(found.holds({-9, 0, 14}, 1));
  EXPECT_FALSE(found.holds({0, 6, 0}, 1));
  EXPECT_EQ(found.periodAlong(1), 0);
}

TEST(Repetition, StepsInOtherDirectionsAreFreeWhereOnlySomeRepeat) {
  // Ribs along y: nothing along y distinguishes one step from another, nor along z.
  Array3D<float> ribs({36, 20, 12});
  for (std::size_t s = 0; s < ribs.count(); ++s) {
    const Vec3i p = ribs.ijk(s);
    ribs.values()[s] = static_cast<float>(p.z - 5 - 2 * std::cos(2 * std::numbers::pi * p.x / 7.2));
  }
  const Repetition found = findRepetition(ribs);
  ASSERT_EQ(found.basis.size(), 1u);
  EXPECT_NEAR(found.periodAlong(0), 7.2, 0.1);
  EXPECT_TRUE(found.holds({36, 5, 0}, 0.5));
  EXPECT_EQ(found.nearest({37, 5, -3}), (Vec3i{36, 5, -3}));
}

TEST(Repetition, NearestStepsAreAtMostHalfASampleOff) {
  Repetition steps;
  steps.basis = {{10.66, 0, 0}, {0.3, 5.97, 0}};
  const Random random(3, 3);
  for (int n = 0; n < 200; ++n) {
    const auto draw = [&](int d) { return static_cast<int>(random.below(81, n, d)) - 40; };
    const Vec3i nearest = steps.nearest({draw(0), draw(1), draw(2)});
    EXPECT_TRUE(steps.holds(nearest, 0.501));
    EXPECT_EQ(nearest.z, draw(2));
    EXPECT_EQ(steps.nearest(nearest), nearest);
  }
}

TEST(Repetition, IsStretchedToAWholeNumberOfPeriodsWhereThatIsLittle) {
  Repetition steps;
  steps.basis = {{10.66, 0.02, 0}, {0, 5.97, 0}};
  EXPECT_TRUE(steps.stretch(0, 64, 32, 0.75));
  EXPECT_NEAR(steps.periodAlong(0), 64 / 6.0, 1e-9);
  EXPECT_FALSE(steps.stretch(0, 70, 32, 0.75));  // 6.56 periods
  EXPECT_NEAR(steps.periodAlong(0), 64 / 6.0, 1e-9);
  EXPECT_FALSE(steps.stretch(2, 16, 8, 0.75));  // no period there
}

TEST(Repetition, IsNotSeenInWhatOnlyGoesOnOrIsRandom) {
  EXPECT_FALSE(findRepetition(balls({32, 32, 32}, 4, 1).values).any());
  EXPECT_FALSE(findRepetition(Array3D<float>({20, 20, 20}, 3.0f)).any());
  EXPECT_FALSE(findRepetition(Array3D<float>({1, 1, 1}, -1.0f)).any());
  // A bar, the same all along; and one step, seen once.
  Array3D<float> bar({32, 16, 16}), two({32, 16, 16});
  for (std::size_t s = 0; s < bar.count(); ++s) {
    const Vec3i p = bar.ijk(s);
    const double across = std::hypot(p.y - 7.6, p.z - 7.3);
    bar.values()[s] = static_cast<float>(across - 4);
    const double ball = std::hypot(across, std::min(std::abs(p.x - 8), std::abs(p.x - 24)));
    two.values()[s] = static_cast<float>(ball - 4);
  }
  EXPECT_FALSE(findRepetition(bar).any());
  EXPECT_FALSE(findRepetition(two).any());
}

TEST(Repetition, IsTheSameAtAnyNumberOfThreads) {
  const std::array<Vec3d, 3> steps{{{8, 0, 0}, {0, 8, 0}, {0, 0, 8}}};
  const Array3D<float> values = lattice({26, 26, 26}, steps, 2.5, 0.5).values;
  Repetition one, eight;
  withThreads(1, [&] { one = findRepetition(values); });
  withThreads(8, [&] { eight = findRepetition(values); });
  EXPECT_EQ(one.basis, eight.basis);
  EXPECT_TRUE(one.any());
}

}  // namespace
}  // namespace exemplar
