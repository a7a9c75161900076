// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/touching.h"

#include <gtest/gtest.h>

#include "mesh/mesh_health.h"
#include "mesh/primitives.h"
#include "mesh/shading_normals.h"

namespace exemplar::continuous {
namespace {

/// Boxes with shared vertices where these are at the same place.
TriangleMesh boxesAt(const std::vector<Vec3d>& corners) {
  TriangleMesh mesh;
  for (const Vec3d& c : corners) append(mesh, makeBox({c, c + Vec3d{1, 1, 1}}));
  const std::vector<std::uint32_t> first = firstOfEqual(mesh.positions);
  for (auto& t : mesh.triangles)
    for (std::uint32_t& v : t) v = first[v];
  return mesh;
}

TEST(SeparateTouching, MakesSolidsThatTouchManifold) {
  struct Case {
    std::vector<Vec3d> boxes;
    std::size_t copies;
  };
  for (const Case& c : {Case{{{0, 0, 0}, {1, 1, 1}}, 1},             // in a point
                        Case{{{0, 0, 0}, {1, 1, 0}}, 2},             // along an edge
                        Case{{{0, 0, 0}, {1, 1, 0}, {0, 1, 1}}, 5},  // one of two edges, a point
                        Case{{{0, 0, 0}, {3, 0, 0}}, 0}}) {          // not at all
    TriangleMesh mesh = boxesAt(c.boxes);
    EXPECT_EQ(meshHealth(mesh).manifold(), c.copies == 0);
    const double volume = meshHealth(mesh).signedVolume;
    EXPECT_EQ(separateTouching(mesh), c.copies);
    const MeshHealth health = meshHealth(mesh);
    EXPECT_TRUE(health.manifold());
    EXPECT_TRUE(health.closed());
    EXPECT_TRUE(health.oriented());
    EXPECT_EQ(health.components, static_cast<std::int64_t>(c.boxes.size()));
    EXPECT_NEAR(health.signedVolume, volume, 1e-12);
  }
}

TEST(SeparateTouching, LeavesAManifoldAsItIs) {
  TriangleMesh box = makeBox({{0, 0, 0}, {1, 2, 3}});
  const TriangleMesh before = box;
  EXPECT_EQ(separateTouching(box), 0u);
  EXPECT_EQ(box.positions, before.positions);
  EXPECT_EQ(box.triangles, before.triangles);
}

}  // namespace
}  // namespace exemplar::continuous
