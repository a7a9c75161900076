// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/stitch.h"

#include <gtest/gtest.h>

#include "mesh/mesh_health.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

/// Two squares side by side with a gap of `gap` between them, the right one `pieces` times cut
/// along the rim that faces the left one.
TriangleMesh twoSquares(double gap, int pieces, std::vector<std::uint32_t>& part) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  part.assign(4, 0);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int n = 0; n <= pieces; ++n) mesh.positions.push_back({1 + gap, double(n) / pieces, 0});
  mesh.positions.push_back({2 + gap, 0.5, 0});
  const auto hub = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::uint32_t n = 0; n < static_cast<std::uint32_t>(pieces); ++n) {
    mesh.triangles.push_back({first + n, hub, first + n + 1});
  }
  part.resize(mesh.positions.size(), 1);
  return mesh;
}

TEST(WeldVertices, JoinsEqualPositionsOnly) {
  const TriangleMesh ball = makeSphere({}, 1, 4);
  TriangleMesh soup = ball;
  soup.positions.clear();
  for (auto& t : soup.triangles) {
    for (std::uint32_t& v : t) {
      soup.positions.push_back(ball.positions[v]);
      v = static_cast<std::uint32_t>(soup.positions.size() - 1);
    }
  }
  std::vector<std::uint32_t> part(soup.positions.size(), 3);
  weldVertices(soup, 1e-9, part);
  EXPECT_EQ(soup.positions.size(), ball.positions.size());
  EXPECT_EQ(part.size(), ball.positions.size());
  EXPECT_TRUE(meshHealth(soup).closed());
}

TEST(StitchRims, ClosesANarrowGapAndTakesUpVerticesInBetween) {
  std::vector<std::uint32_t> part;
  TriangleMesh mesh = twoSquares(0.05, 4, part);
  ASSERT_EQ(meshHealth(mesh).components, 2);
  stitchRims(mesh, 0.1, part);
  const MeshHealth health = meshHealth(mesh);
  EXPECT_EQ(health.components, 1);
  EXPECT_EQ(health.nonManifoldEdges, 0);
  EXPECT_EQ(health.misorientedEdges, 0);
  // The rim: three sides of the left square, two of the right triangle.
  EXPECT_EQ(health.boundaryEdges, 5);
}

TEST(StitchRims, LeavesAWideGapOpen) {
  std::vector<std::uint32_t> part;
  TriangleMesh mesh = twoSquares(0.2, 4, part);
  const auto before = mesh.positions;
  stitchRims(mesh, 0.1, part);
  EXPECT_EQ(mesh.positions, before);
  EXPECT_EQ(meshHealth(mesh).components, 2);
}

TEST(StitchRims, DoesNotJoinARimToItself) {
  // A thin sheet's own rims are near each other.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {5, 0, 0}, {5, 0.05, 0}, {0, 0.05, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto before = mesh.triangles;
  std::vector<std::uint32_t> part(4, 0);
  stitchRims(mesh, 0.1, part);
  EXPECT_EQ(mesh.triangles, before);
}

TEST(StitchRims, CarriesAttributes) {
  std::vector<std::uint32_t> part;
  TriangleMesh mesh = twoSquares(0.05, 4, part);
  mesh.materials.resize(2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.triangleMaterials.push_back(t >= 2);
    std::array<Vec2f, 3> uvs;
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = mesh.positions[mesh.triangles[t][c]];
      uvs[c] = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
    mesh.uvs.push_back(uvs);
  }
  stitchRims(mesh, 0.1, part);
  validate(mesh, "stitched");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = mesh.positions[mesh.triangles[t][c]];
      EXPECT_NEAR(mesh.uvs[t][c].x, p.x, 0.051);
      EXPECT_NEAR(mesh.uvs[t][c].y, p.y, 0.051);
    }
  }
}

}  // namespace
}  // namespace exemplar
