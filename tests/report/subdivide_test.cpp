// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/subdivide.h"

#include <gtest/gtest.h>

#include "mesh/mesh_health.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

TEST(Subdivide, LeavesNoLongEdgeAndNoGap) {
  const TriangleMesh box = makeBox({{0, 0, 0}, {4, 2, 1}});
  const auto parts = subdivide(box, 0.3, 100000);
  ASSERT_TRUE(parts);
  for (const auto& t : parts->mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LE(length(parts->mesh.positions[t[c]] - parts->mesh.positions[t[(c + 1) % 3]]), 0.3);
  // It is as closed as it was, and encloses the same.
  const MeshHealth before = meshHealth(box), after = meshHealth(parts->mesh);
  EXPECT_EQ(after.boundaryEdges, before.boundaryEdges);
  EXPECT_TRUE(after.manifold() && after.oriented());
  EXPECT_NEAR(after.signedVolume, 8, 1e-9);
}

TEST(Subdivide, TellsWhereEachPartLies) {
  const TriangleMesh ball = makeSphere({0, 0, 0}, 3, 4);
  const auto parts = subdivide(ball, 0.4, 100000);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->parents.size(), parts->mesh.triangles.size());
  for (std::size_t t = 0; t < parts->parents.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3d p{};
      for (std::size_t w = 0; w < 3; ++w)
        p += ball.positions[ball.triangles[parts->parents[t]][w]] * parts->weights[t][c][w];
      EXPECT_LT(length(p - parts->mesh.positions[parts->mesh.triangles[t][c]]), 1e-12);
    }
}

TEST(Subdivide, GivesUpWhereItWouldBeTooMany) {
  EXPECT_FALSE(subdivide(makeBox({{0, 0, 0}, {1, 1, 1}}), 0.01, 1000));
  EXPECT_EQ(subdivide(makeBox({{0, 0, 0}, {1, 1, 1}}), 10, 1000)->parents.size(), 12u);
}

}  // namespace
}  // namespace exemplar
