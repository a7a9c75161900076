// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/occupancy.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/measure/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ball;
using testing::emptyField;
using testing::makeField;
using testing::noise;
using testing::solidField;

bool solidInField(const DistanceField& field, const Vec3i& p) {
  return field.values.contains(p) && field.values[p] < 0;
}

TEST(Occupancy, HoldsEveryCellAndAnEmptyMargin) {
  for (const Vec3i size : {Vec3i{1, 1, 1}, {63, 4, 3}, {64, 3, 4}, {65, 5, 2}, {130, 2, 3}}) {
    const DistanceField field = noise(size, 0.4, 1);
    const Occupancy occupancy(field);
    std::int64_t solid = 0;
    const int m = Occupancy::kMargin;
    for (int z = -m; z < size.z + m; ++z)
      for (int y = -m; y < size.y + m; ++y)
        for (int x = -m; x < size.x + m; ++x) {
          const bool expected = solidInField(field, {x, y, z});
          ASSERT_EQ(occupancy.solid(x, y, z), expected) << x << ' ' << y << ' ' << z;
          solid += expected;
        }
    EXPECT_EQ(occupancy.solidCells(), solid);
    EXPECT_EQ(occupancy.cells(), volume(size));
  }
}

TEST(Occupancy, BitsStartAnywhere) {
  const DistanceField field = noise({100, 3, 2}, 0.5, 2);
  const Occupancy occupancy(field);
  for (int x = -64; x <= 163; ++x) {
    const std::uint64_t bits = occupancy.bits(x, 1, 1);
    for (int b = 0; b < 64; ++b)
      ASSERT_EQ(bits >> b & 1, solidInField(field, {x + b, 1, 1})) << x << ' ' << b;
  }
}

TEST(Occupancy, ZeroAndNanAreNotSolid) {
  const DistanceField field = makeField({4, 1, 1}, [](const Vec3d& p) {
    return p.x < 1 ? -0.0 : p.x < 2 ? std::nan("") : p.x < 3 ? 0.0 : -1e-30;
  });
  EXPECT_EQ(Occupancy(field).solidCells(), 1);
}

TEST(Occupancy, OfADepthBeginsBelowTheSurface) {
  DistanceField field = makeField({30, 1, 1}, [](const Vec3d& p) { return p.x - 20.25; });
  EXPECT_EQ(Occupancy(field).solidCells(), 21);
  EXPECT_EQ(Occupancy(field, 0.5).solidCells(), 20);
  EXPECT_EQ(Occupancy(field, 3).solidCells(), 18);
  for (float& v : field.values.values()) v *= 0.25f;
  field.voxelSize = 0.25;
  EXPECT_EQ(Occupancy(field, 3).solidCells(), 18);
}

// Crofton's formula with 13 directions is exact for isotropic surfaces up to the discretization,
// whose error on a digital ball of radius r falls as 1 / r: 2 % is ample at r = 10 and more.
TEST(SurfaceDensity, IsTheAreaOfABall) {
  for (const double r : {10.0, 15.3, 20.0}) {
    const DistanceField field = ball({48, 48, 48}, {23.6, 23.1, 23.4}, r);
    const double area = surfaceDensity(Occupancy(field)) * 48 * 48 * 48;
    // The density is for each direction over its own pairs, of which there are a little fewer than
    // cells: (47 / 48)^k with k = 1, 2, 3 of the axes; all pairs are inside, so the area is high by
    // the same. Bring it back with the mean of the three, 4 %.
    EXPECT_NEAR(area * 0.96 / (4 * std::numbers::pi * r * r), 1, 0.025) << r;
  }
}

// A plane that faces an axis is 2 (c1 + 4 c2 / sqrt 2 + 4 c3 / sqrt 3) = 0.9266 of its area, and
// the box's own faces are none, so the density is that over the 40 cells across.
TEST(SurfaceDensity, OfAPlaneDoesNotDependOnItsPosition) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double at : {0.5, 7.5, 20.2, 38.5}) {
      const DistanceField field =
          makeField({40, 40, 40}, [&](const Vec3d& p) { return p[axis] - at; });
      // Over 39 pairs of cells.
      EXPECT_NEAR(surfaceDensity(Occupancy(field)) * 39, 0.9266, 0.0001) << axis << ' ' << at;
    }
}

TEST(SurfaceDensity, IsZeroWithoutSurfaceAndLargeInNoise) {
  EXPECT_EQ(surfaceDensity(Occupancy(emptyField({20, 20, 20}))), 0);
  EXPECT_EQ(surfaceDensity(Occupancy(solidField({20, 20, 20}))), 0);
  // Half of all pairs differ: 2 sum c_k (1/2) / |d_k| = sum c_k / |d_k| = 0.75 and more.
  EXPECT_NEAR(surfaceDensity(Occupancy(noise({40, 40, 40}, 0.5, 3))), 0.7510, 0.01);
}

TEST(SurfaceDensity, OfALayerOneCellThinIsThatOfTheDirectionsThatFit) {
  const DistanceField field = makeField({30, 30, 1}, [](const Vec3d& p) { return p.x - 14.5; });
  const double density = surfaceDensity(Occupancy(field));
  EXPECT_GT(density, 0.5 / 29);
  EXPECT_LT(density, 2.0 / 29);
}

TEST(IntersectionOverUnion, CountsCells) {
  const Vec3i n{70, 9, 8};
  const DistanceField a = noise(n, 0.5, 4), b = noise(n, 0.3, 5);
  for (const Vec3i shift : {Vec3i{0, 0, 0}, {1, -2, 3}, {-65, 0, 1}, {66, 4, -4}}) {
    int both = 0, either = 0;
    for (int z = 0; z < n.z; ++z)
      for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x) {
          const Vec3i p{x, y, z}, q = p - shift;
          if (!b.values.contains(q)) continue;
          both += solidInField(a, p) && solidInField(b, q);
          either += solidInField(a, p) || solidInField(b, q);
        }
    EXPECT_DOUBLE_EQ(intersectionOverUnion(Occupancy(a), Occupancy(b), shift),
                     static_cast<double>(both) / either);
    if (shift == Vec3i{0, 0, 0}) {
      EXPECT_DOUBLE_EQ(intersectionOverUnion(Occupancy(a), Occupancy(b)),
                       static_cast<double>(both) / either);
    }
  }
}

TEST(IntersectionOverUnion, OfNothingIsDefined) {
  const Occupancy nothing(emptyField({10, 10, 10}));
  EXPECT_EQ(intersectionOverUnion(nothing, nothing), 1);
  EXPECT_EQ(intersectionOverUnion(nothing, nothing, {1, 0, 0}), 0);
  EXPECT_EQ(intersectionOverUnion(nothing, nothing, {10, 0, 0}), 0);
}

TEST(Occupancy, FiguresAreTheSameAtOneAndEightThreads) {
  const DistanceField field = noise({50, 60, 70}, 0.4, 6), other = noise({50, 60, 70}, 0.4, 7);
  const auto all = [&] {
    const Occupancy a(field), b(other);
    return std::array{surfaceDensity(a), solidFraction(a), intersectionOverUnion(a, b)};
  };
  EXPECT_EQ(testing::onThreads(1, all), testing::onThreads(8, all));
}

}  // namespace
}  // namespace exemplar
