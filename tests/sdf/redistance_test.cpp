// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/redistance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/sdf/cancellation.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::inputError;
using test::Shape;
using test::withThreads;
using testing::HasSubstr;

// A field that is right in sign and far from a distance: a true one, warped monotonically by a
// factor that changes from place to place.
DistanceField warped(const Shape& shape, int n) {
  DistanceField field =
      test::sampled(shape, {n, n, n}, 2.0 / n, Vec3d{-1, -1, -1} + Vec3d{1, 1, 1} / n, 10);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
    float& v = field.values.values()[s];
    v *= static_cast<float>(2 + std::sin(3 * p.x) + 0.5 * std::cos(4 * p.y + p.z));
  }
  return field;
}

// The samples next to the surface, where both sides are known; calls visit(inside, outside).
template <class Visit>
void forCrossings(const DistanceField& field, const Visit& visit) {
  const Vec3i n = field.size();
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3i a = field.values.ijk(s);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i b = a;
      if (++b[axis] >= n[axis]) continue;
      if ((field.values[a] < 0) != (field.values[b] < 0))
        visit(field.values[a] < 0 ? a : b, field.values[a] < 0 ? b : a);
    }
  }
}

double crossingShare(const DistanceField& field, const Vec3i& inside, const Vec3i& outside) {
  const double a = field.values[inside], b = field.values[outside];
  return a / (a - b);
}

// Mean and worst | |grad| - 1 | by central differences where the field is not clamped.
std::pair<double, double> gradientError(const DistanceField& field) {
  const Vec3i n = field.size();
  double sum = 0, worst = 0;
  int count = 0;
  for (int k = 1; k + 1 < n.z; ++k)
    for (int j = 1; j + 1 < n.y; ++j)
      for (int i = 1; i + 1 < n.x; ++i) {
        const auto& v = field.values;
        const double limit = field.truncation - 1.5 * field.voxelSize;
        if (std::abs(v(i, j, k)) > limit) continue;
        const Vec3d g{v(i + 1, j, k) - v(i - 1, j, k), v(i, j + 1, k) - v(i, j - 1, k),
                      v(i, j, k + 1) - v(i, j, k - 1)};
        const double error = std::abs(length(g) / (2 * field.voxelSize) - 1);
        sum += error;
        worst = std::max(worst, error);
        ++count;
      }
  return {sum / count, worst};
}

TEST(Redistance, MakesTheGradientOneInTheBand) {
  const DistanceField before = warped(test::torus({0.02, -0.03, 0.01}, 0.55, 0.25), 48);
  const auto [meanBefore, worstBefore] = gradientError(before);
  EXPECT_GT(meanBefore, 0.3);  // the checker sees a field that is no distance
  const auto [mean, worst] = gradientError(redistance(before));
  // Curvature 1 / 0.25 = 6 voxels: facets of the zero set differ in direction by up to a sixth, so
  // single gradients are off by the square of that; the mean is far below.
  EXPECT_LT(mean, 0.01);
  EXPECT_LT(worst, 0.15);
}

TEST(Redistance, AgreesWithTheTrueDistance) {
  for (const double halfWidth : {2.0, 5.0, std::numeric_limits<double>::infinity()}) {
    const Shape shape = test::sphere({0.01, 0.02, 0.03}, 0.6);
    const DistanceField field = redistance(warped(shape, 40), {.halfWidth = halfWidth});
    // The zero set of the warped field is linear between samples: off by up to about
    // (relative change of the warp over a voxel) / 4 voxels, below 0.1.
    EXPECT_LT(test::worstError(field, shape), 0.15);
  }
}

TEST(Redistance, KeepsEverySignAndNearlyEveryCrossing) {
  const DistanceField before = warped(test::torus({0, 0, 0}, 0.5, 0.2), 40);
  const DistanceField after = redistance(before);
  for (std::size_t s = 0; s < before.values.count(); ++s)
    ASSERT_EQ(before.values.values()[s] < 0, after.values.values()[s] < 0);
  double worst = 0, sum = 0;
  int count = 0;
  forCrossings(before, [&](const Vec3i& a, const Vec3i& b) {
    const double moved = std::abs(crossingShare(before, a, b) - crossingShare(after, a, b));
    worst = std::max(worst, moved);
    sum += moved;
    ++count;
  });
  ASSERT_GT(count, 1000);
  EXPECT_LT(sum / count, 0.02);
  EXPECT_LT(worst, 0.25);
}

TEST(Redistance, LeavesAPlaneWhereItIs) {
  const Vec3d normal = normalized(Vec3d{1, 2, 3});
  const Shape plane = [&](const Vec3d& p) { return dot(p, normal); };
  DistanceField field = test::sampled(plane, {24, 24, 24}, 0.1, {-1.15, -1.15, -1.15}, 10);
  for (float& v : field.values.values()) v *= 5;
  // Far from the box's sides, where the surface ends, only float rounding is left.
  const DistanceField after = redistance(field, {.halfWidth = 3});
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3i p = field.values.ijk(s);
    if (std::min({p.x, p.y, p.z}) < 5 || std::max({p.x, p.y, p.z}) > 18) continue;
    const double d = std::clamp(plane(field.position(cast<double>(p))), -0.3, 0.3);
    ASSERT_NEAR(after.values.values()[s], d, 1e-5);
  }
}

TEST(Redistance, HealsJumpsWithoutInventingCrossings) {
  // Two halves of different spheres, as synthesis leaves them: no distance across the seam.
  DistanceField field = test::sampled(test::sphere({0, 0, 0}, 0.6), {40, 40, 40}, 0.05,
                                      {-0.975, -0.975, -0.975}, 0.15);
  const DistanceField other =
      test::sampled(test::sphere({0.1, 0, 0.1}, 0.5), {40, 40, 40}, 0.05, field.origin, 0.15);
  for (int k = 20; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) field.values(i, j, k) = other.values(i, j, k);
  const auto crossings = [](const DistanceField& f) {
    int count = 0;
    forCrossings(f, [&](const Vec3i&, const Vec3i&) { ++count; });
    return count;
  };
  const DistanceField after = redistance(field);
  EXPECT_EQ(crossings(after), crossings(field));
  // A distance never changes by more than a step's length, whatever it was made from.
  const Vec3i n = after.size();
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i + 1 < n.x; ++i)
        ASSERT_LE(
            std::abs(after.values(i + 1, j, k) - after.values(i, j, k)),
            0.05 * (1 + 1e-5) + (after.values(i, j, k) * after.values(i + 1, j, k) < 0 ? 0.05 : 0));
}

TEST(Redistance, WithoutASurfaceIsConstant) {
  DistanceField field{Array3D<float>({5, 6, 7}, 0.01f), 0.5, {}, 1};
  DistanceField after = redistance(field, {.halfWidth = 4});
  for (const float v : after.values.values()) EXPECT_EQ(v, 2.0f);
  for (float& v : field.values.values()) v = -v;
  after = redistance(field, {.halfWidth = std::numeric_limits<double>::infinity()});
  for (const float v : after.values.values())
    EXPECT_FLOAT_EQ(v, static_cast<float>(-0.5 * std::sqrt(25 + 36 + 49)));
}

TEST(Redistance, IsTheSameAtAnyNumberOfThreads) {
  const DistanceField field = warped(test::torus({0, 0, 0}, 0.5, 0.2), 40);
  const auto run = [&] { return redistance(field).values; };
  EXPECT_EQ(withThreads(1, run), withThreads(8, run));
}

TEST(Redistance, RefusesABandOfNoWidth) {
  const DistanceField field{Array3D<float>({2, 2, 2}, 1), 1, {}, 1};
  EXPECT_THAT(inputError([&] { redistance(field, {.halfWidth = 0}); }), HasSubstr("halfWidth"));
}

TEST(Redistance, ReportsItsProgressAndStopsWhereItIsCancelled) {
  const DistanceField field = warped(test::sphere({0, 0, 0}, 0.7), 32);
  expectReportsAndStops([&](const Progress& progress) { redistance(field, {}, progress); }, 10);
}

// A ball whose halves are three voxels apart, and the shape that each half has.
struct SteppedBall {
  Shape left = test::sphere({0, 0, 0}, 0.6), right = test::sphere({0, 0.2, 0}, 0.6);
  DistanceField field =
      test::sampled([this](const Vec3d& p) { return p.x < 0 ? left(p) : right(p); }, {30, 30, 30},
                    2.0 / 30, Vec3d{-1, -1, -1} + Vec3d{1, 1, 1} / 30, 10);
};

TEST(RedistanceJumps, ChangesOnlyWhatIsNearAJumpAndKeepsEverySign) {
  const SteppedBall ball;
  const DistanceField result = redistanceJumps(ball.field);
  int changed = 0;
  for (std::size_t s = 0; s < result.values.count(); ++s) {
    const float before = ball.field.values.values()[s], after = result.values.values()[s];
    ASSERT_EQ(before < 0, after < 0);
    if (before == after) continue;
    ++changed;
    // Two samples around the step between the halves, and no farther from a crossing.
    EXPECT_LE(std::abs(result.values.ijk(s).x - 14.5), 2.5);
  }
  EXPECT_GT(changed, 50);
  // A distance has no jumps to correct.
  const DistanceField whole = redistance(ball.field);
  EXPECT_EQ(redistanceJumps(whole).values, whole.values);
}

TEST(RedistanceJumps, MeasuresToTheZeroSet) {
  const SteppedBall ball;
  const DistanceField jumps = redistanceJumps(ball.field);
  const DistanceField whole = redistance(ball.field, {.halfWidth = 4});
  for (std::size_t s = 0; s < jumps.values.count(); ++s) {
    const float v = jumps.values.values()[s];
    if (v == ball.field.values.values()[s]) continue;
    EXPECT_FLOAT_EQ(v, whole.values.values()[s]);
  }
}

TEST(RedistanceJumps, SeesAcrossTheFacesOfAPeriodicField) {
  // The same field moved around by half its size along x and y: the same values, moved.
  const SteppedBall ball;
  const auto moved = [](const DistanceField& field) {
    DistanceField result = field;
    const Vec3i n = field.size();
    for (std::size_t s = 0; s < field.values.count(); ++s) {
      const Vec3i p = field.values.ijk(s);
      result.values((p.x + n.x / 2) % n.x, (p.y + n.y / 2) % n.y, p.z) = field.values.values()[s];
    }
    return result;
  };
  const Axes wraps{true, true, false};
  const Array3D<float> expected = moved(redistanceJumps(ball.field, wraps)).values;
  const Array3D<float> actual = redistanceJumps(moved(ball.field), wraps).values;
  // Positions are other numbers, so that roundings differ.
  for (std::size_t s = 0; s < actual.count(); ++s)
    ASSERT_NEAR(actual.values()[s], expected.values()[s], 1e-6);
  EXPECT_NE(redistanceJumps(moved(ball.field)).values, actual);
}

TEST(RedistanceJumps, IsTheSameAtAnyNumberOfThreads) {
  const SteppedBall ball;
  const auto run = [&] { return redistanceJumps(ball.field, Axes::every()).values; };
  EXPECT_EQ(withThreads(1, run), withThreads(8, run));
}

TEST(RedistanceJumps, ReportsItsProgressAndStopsWhereItIsCancelled) {
  const SteppedBall ball;
  const auto run = [&](const Progress& progress) { redistanceJumps(ball.field, {}, progress); };
  expectReportsAndStops(run, 10);
}

TEST(ZeroSet, IsClosedAndFacesOutside) {
  const auto field = warped(test::sphere({0, 0, 0}, 0.7), 20);
  const auto triangles = zeroSet(field.values);
  ASSERT_GT(triangles.size(), 100u);
  // Closed and outward: the winding number is 1 inside and 0 outside.
  const TriangleTree tree(triangles);
  EXPECT_NEAR(tree.windingNumber({9.5, 9.5, 9.5}), 1, 0.01);
  EXPECT_NEAR(tree.windingNumber({0, 0, 0}), 0, 0.01);
  Vec3d total{};
  for (const Corners& t : triangles) total += cross(t[1] - t[0], t[2] - t[0]);
  EXPECT_NEAR(length(total), 0, 1e-9);
}

TEST(ZeroSet, LeavesOutCellsWithoutAMark) {
  const auto field = warped(test::sphere({0, 0, 0}, 0.7), 20);
  const auto all = zeroSet(field.values);
  Array3D<std::uint8_t> marks(field.size(), 1);
  EXPECT_EQ(zeroSet(field.values, &marks), all);
  // Marks at one end: of what is near it all, in the same order, of what is far nothing.
  for (std::size_t s = 0; s < marks.count(); ++s) marks.values()[s] = marks.ijk(s).x < 8;
  const auto some = zeroSet(field.values, &marks);
  const auto lowest = [](const Corners& t) { return std::min({t[0].x, t[1].x, t[2].x}); };
  const auto near = [&](std::vector<Corners> triangles) {
    std::erase_if(triangles, [&](const Corners& t) { return lowest(t) >= 7; });
    return triangles;
  };
  EXPECT_EQ(near(some), near(all));
  EXPECT_LT(some.size(), all.size());
  for (const Corners& t : some) EXPECT_LE(lowest(t), 8);
}

}  // namespace
}  // namespace exemplar
