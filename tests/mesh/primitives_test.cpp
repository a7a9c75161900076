// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/mesh_health.h"

namespace exemplar {
namespace {

TEST(RoundedBox, IsTheBoxWithinTheRadiusOfItsEdges) {
  const Box3d box{{-1, 2, 0}, {4, 3, 1.5}};
  const double radius = 0.3;
  const TriangleMesh mesh = makeRoundedBox(box, radius);
  const MeshHealth health = meshHealth(mesh, {.selfIntersections = true});
  EXPECT_TRUE(health.closed());
  EXPECT_TRUE(health.manifold());
  EXPECT_TRUE(health.oriented());
  EXPECT_EQ(health.components, 1);
  EXPECT_EQ(health.selfIntersections, 0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(boundingBox(mesh).min[axis], box.min[axis], 1e-12);
    EXPECT_NEAR(boundingBox(mesh).max[axis], box.max[axis], 1e-12);
  }
  // Each vertex is a radius away from the box that is smaller by it.
  for (const Vec3d& p : mesh.positions) {
    Vec3d off;
    for (int axis = 0; axis < 3; ++axis)
      off[axis] = p[axis] - std::clamp(p[axis], box.min[axis] + radius, box.max[axis] - radius);
    EXPECT_NEAR(length(off), radius, 1e-12);
  }
  // The sum of box, slabs on its sides, quarters of cylinders along its edges, and a ball.
  const Vec3d s = box.size() - Vec3d{2 * radius, 2 * radius, 2 * radius};
  const double pi = 3.14159265358979;
  const double volume = s.x * s.y * s.z + 2 * radius * (s.x * s.y + s.y * s.z + s.z * s.x) +
                        pi * radius * radius * (s.x + s.y + s.z) + 4 * pi / 3 * std::pow(radius, 3);
  EXPECT_NEAR(health.signedVolume, volume, 0.01 * volume);
}

}  // namespace
}  // namespace exemplar
