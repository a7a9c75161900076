// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TriangleMesh turned(TriangleMesh mesh, double degrees) {
  turn(mesh, Turn(degrees * kDegree, {3, -7, 0}));
  return mesh;
}

/// A wall whose points are moved at random: no two faces look the same way.
TriangleMesh roughWall() {
  TriangleMesh mesh;
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 10; ++k)
      append(mesh, makeBox({{0.1 * i, 0, 0.1 * k}, {0.1 * (i + 1), 0.5, 0.1 * (k + 1)}}));
  const Random random(3);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    for (int axis = 0; axis < 3; ++axis)
      mesh.positions[v][axis] += random.uniform(-0.06, 0.06, v, static_cast<std::uint32_t>(axis));
  return mesh;
}

TriangleMesh ell() {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {4, 0.3, 2}});
  append(mesh, makeBox({{0, 0, 0}, {0.3, 3, 2}}));
  return mesh;
}

TEST(Turn, GoesBackToWhereItCameFromAndLeavesAllAsItIsAtNoAngle) {
  const Turn turn(0.7, {1, 2, 3});
  const Vec3d p{4.1, -2.3, 0.7};
  EXPECT_LT(length(turn.back()(turn(p)) - p), 1e-14);
  EXPECT_EQ(turn(p).z, p.z);
  EXPECT_EQ(Turn()(p), p);
  EXPECT_EQ(turn(turn.about()), turn.about());
}

TEST(Footprint, FindsByHowMuchWallsAreTurned) {
  for (const double thickness : {0.1, 0.4, 2.5}) {
    const TriangleMesh wall = makeBox({{0, 0, 0}, {4, thickness, 2}});
    for (const double degrees : {1.5, 17.0, 30.0, -40.0, 44.0}) {
      const Footprint found = footprintOf(turned(wall, degrees));
      EXPECT_FALSE(found.straight) << degrees;
      EXPECT_NEAR(found.angle, degrees * kDegree, 1e-9);
      EXPECT_NEAR(found.along, 4, 1e-9);
      EXPECT_NEAR(found.across, thickness, 1e-9);
    }
    // Beyond half a quarter turn, its axes are nearer to the other ones.
    const Footprint found = footprintOf(turned(wall, 133));
    EXPECT_NEAR(found.angle, 43 * kDegree, 1e-9);
    EXPECT_NEAR(found.across, 4, 1e-9);
  }
}

TEST(Footprint, TakesTheRectangleOfWhatHasNoFlatFaces) {
  const Footprint straight = footprintOf(roughWall());
  EXPECT_TRUE(straight.straight);
  const Footprint found = footprintOf(turned(roughWall(), 20));
  EXPECT_FALSE(found.straight);
  // The roughness is 0.06 at both ends of 4.
  EXPECT_NEAR(found.angle, 20 * kDegree, std::atan(0.12 / 4));
}

TEST(Footprint, LeavesStraightAndRoundThingsAsTheyAre) {
  for (const double degrees : {0.0, 90.0, 180.0, 0.5})
    EXPECT_TRUE(footprintOf(turned(makeBox({{0, 0, 0}, {4, 1, 2}}), degrees)).straight) << degrees;
  for (const double degrees : {0.0, 11.0, 30.0}) {
    EXPECT_TRUE(footprintOf(turned(makeSphere({}, 1, 8), degrees)).straight) << degrees;
    EXPECT_TRUE(footprintOf(turned(makeTorus({}, {0, 0, 1}, 2, 0.5, 48, 16), degrees)).straight);
  }
}

TEST(Footprint, DoesNotLayAnEllAlongItsDiagonal) {
  EXPECT_TRUE(footprintOf(ell()).straight);
  EXPECT_NEAR(footprintOf(turned(ell(), 25)).angle, 25 * kDegree, 1e-9);
}

TEST(Footprint, IsThatOfTheMeshFarFromTheOriginToo) {
  TriangleMesh wall = turned(makeBox({{0, 0, 0}, {4, 0.4, 2}}), 17);
  for (Vec3d& p : wall.positions) p += Vec3d{448262, 5411932, 300};
  // Positions are exact to 1e-9 there.
  EXPECT_NEAR(footprintOf(wall).angle, 17 * kDegree, 1e-7);
}

}  // namespace
}  // namespace exemplar
