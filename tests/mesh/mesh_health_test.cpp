// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mesh_health.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <numbers>

#include "core/random.h"
#include "mesh/predicates.h"
#include "mesh/self_intersection.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

MeshHealth healthOf(const TriangleMesh& mesh) {
  return meshHealth(mesh, {.selfIntersections = true});
}

TriangleMesh box(const Vec3d& low, const Vec3d& high) {
  TriangleMesh mesh;
  for (int v = 0; v < 8; ++v) {
    mesh.positions.push_back(
        {v & 1 ? high.x : low.x, v & 2 ? high.y : low.y, v & 4 ? high.z : low.z});
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TEST(MeshHealth, PassesASoundTorus) {
  const MeshHealth h = healthOf(plainTorus(64, 32));
  EXPECT_EQ(h.vertices, 64 * 32);
  EXPECT_EQ(h.triangles, 2 * 64 * 32);
  EXPECT_TRUE(h.closed() && h.manifold() && h.oriented());
  EXPECT_EQ(h.degenerateTriangles, 0);
  EXPECT_EQ(h.selfIntersections, 0);
  EXPECT_EQ(h.components, 1);
  // 2 pi² R r², less what the chords cut off: about (2 pi²/3) (1/64² + 1/32²), below one per cent.
  const double exact = 2 * std::numbers::pi * std::numbers::pi * 2 * 0.7 * 0.7;
  EXPECT_LT(h.signedVolume, exact);
  EXPECT_GT(h.signedVolume, 0.99 * exact);
}

TEST(MeshHealth, VolumeDoesNotDependOnWhereTheMeshStands) {
  TriangleMesh far = plainTorus();
  const double here = meshHealth(far).signedVolume;
  for (Vec3d& p : far.positions) p += Vec3d{1e5, -1e5, 1e5};
  // Coordinates of 1e5 are rounded to 1e-11; the volume of this size to about that.
  EXPECT_NEAR(meshHealth(far).signedVolume, here, 1e-8);
}

TEST(MeshHealth, SeesAHole) {
  TriangleMesh mesh = plainTorus();
  mesh.triangles.pop_back();
  const MeshHealth h = healthOf(mesh);
  EXPECT_EQ(h.boundaryEdges, 3);
  EXPECT_FALSE(h.closed());
  EXPECT_TRUE(h.manifold());
}

TEST(MeshHealth, UnjoinedVerticesAreOpen) {
  TriangleMesh soup;
  for (const auto& triangle : plainTorus().triangles) {
    const std::uint32_t n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : triangle) soup.positions.push_back(plainTorus().positions[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const MeshHealth h = healthOf(soup);
  EXPECT_EQ(h.boundaryEdges, 3 * h.triangles);
  EXPECT_EQ(h.components, h.triangles);
  EXPECT_EQ(h.selfIntersections, 0) << "neighbors only touch";
}

TEST(MeshHealth, SeesAFin) {
  TriangleMesh mesh = plainTorus();
  mesh.positions.push_back({0, 0, 5});
  const auto [a, b, c] = mesh.triangles[0];
  mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(mesh.positions.size() - 1)});
  const MeshHealth h = healthOf(mesh);
  EXPECT_EQ(h.nonManifoldEdges, 1);
  EXPECT_EQ(h.boundaryEdges, 2);
  EXPECT_EQ(h.nonManifoldVertices, 0);
  EXPECT_FALSE(h.manifold());
}

TEST(MeshHealth, SeesTwoSolidsThatMeetInAVertex) {
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  append(mesh, box({1, 1, 1}, {2, 2, 2}));
  EXPECT_EQ(healthOf(mesh).nonManifoldVertices, 0);
  EXPECT_EQ(healthOf(mesh).components, 2);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) {
      if (v == 8) v = 7;  // the corner at (1, 1, 1)
    }
  }
  const MeshHealth h = healthOf(mesh);
  EXPECT_EQ(h.nonManifoldVertices, 1);
  EXPECT_EQ(h.nonManifoldEdges, 0);
  EXPECT_EQ(h.components, 1);
  EXPECT_TRUE(h.closed());
  EXPECT_FALSE(h.manifold());
}

TEST(MeshHealth, SeesAFlippedTriangle) {
  TriangleMesh mesh = plainTorus();
  std::swap(mesh.triangles[10][0], mesh.triangles[10][1]);
  const MeshHealth h = healthOf(mesh);
  EXPECT_EQ(h.misorientedEdges, 3);
  EXPECT_TRUE(h.closed());
  EXPECT_FALSE(h.oriented());
}

TEST(MeshHealth, SeesAMeshTurnedInsideOut) {
  TriangleMesh mesh = plainTorus();
  const double outside = healthOf(mesh).signedVolume;
  for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_TRUE(healthOf(mesh).oriented());
  // The same terms with the other sign; their rounding differs in the last bits.
  EXPECT_NEAR(healthOf(mesh).signedVolume, -outside, 1e-12);
}

TEST(MeshHealth, SeesDegenerateTriangles) {
  TriangleMesh mesh = plainTorus();
  mesh.positions.push_back({0, 0, 0});
  mesh.positions.push_back({0.1, 0.2, 0.3});
  mesh.positions.push_back({0.3, 0.6, 0.9});
  const std::uint32_t n = static_cast<std::uint32_t>(mesh.positions.size()) - 3;
  mesh.triangles.push_back({0, 0, 1});          // two equal corners
  mesh.triangles.push_back({n, n + 1, n + 2});  // on a line, up to rounding
  const MeshHealth h = healthOf(mesh);
  EXPECT_EQ(h.degenerateTriangles, 2);
  EXPECT_EQ(h.nonManifoldEdges, 0) << "a triangle that is an edge is not another one at it";
}

TEST(MeshHealth, ANeedleIsNotDegenerate) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(healthOf(mesh).degenerateTriangles, 0);
}

TEST(MeshHealth, SeesOneCrossingPair) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {2, 1, -1}, {1, 1, 3}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(healthOf(mesh).selfIntersections, 1);
  EXPECT_EQ(meshHealth(mesh).selfIntersections, 0) << "not asked for";
  for (int v = 3; v < 6; ++v) mesh.positions[v].z += 1;
  EXPECT_EQ(healthOf(mesh).selfIntersections, 0) << "it rests on the other one now";
}

TEST(MeshHealth, SeesBoxesThatOverlapOnTheirDiagonals) {
  // Every point where an edge meets a face lies on an edge of that face's triangles.
  TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
  append(mesh, box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}));
  EXPECT_GT(healthOf(mesh).selfIntersections, 0);
  TriangleMesh apart = box({0, 0, 0}, {1, 1, 1});
  append(apart, box({1, 0, 0}, {2, 1, 1}));
  EXPECT_EQ(healthOf(apart).selfIntersections, 0) << "boxes side by side only touch";
}

TEST(CountSelfIntersections, AgreesWithTestingAllPairs) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const Random random(trial);
    TriangleMesh mesh;
    for (std::uint32_t t = 0; t < 200; ++t) {
      const Vec3d center{random.uniform(t, 0), random.uniform(t, 1), random.uniform(t, 2)};
      for (std::uint32_t c = 0; c < 3; ++c) {
        mesh.positions.push_back(center + Vec3d{random.uniform(-0.2, 0.2, t, 9 * c + 3),
                                                random.uniform(-0.2, 0.2, t, 9 * c + 4),
                                                random.uniform(-0.2, 0.2, t, 9 * c + 5)});
      }
      mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    std::int64_t pairs = 0;
    for (std::size_t t = 0; t < 200; ++t) {
      for (std::size_t u = t + 1; u < 200; ++u) {
        const Vec3d a[3] = {mesh.positions[3 * t], mesh.positions[3 * t + 1],
                            mesh.positions[3 * t + 2]};
        const Vec3d b[3] = {mesh.positions[3 * u], mesh.positions[3 * u + 1],
                            mesh.positions[3 * u + 2]};
        pairs += trianglesCross(a, b);
      }
    }
    EXPECT_GT(pairs, 10);
    EXPECT_EQ(countSelfIntersections(mesh), pairs);
  }
}

TEST(MeshHealth, IsTheSameAtAnyNumberOfThreads) {
  TriangleMesh mesh = plainTorus(100, 60);
  append(mesh, plainTorus(60, 100));
  for (std::size_t v = 6000; v < mesh.positions.size(); ++v)
    mesh.positions[v] += Vec3d{0.31, 0.17, 0.05};
  MeshHealth one, eight;
  tbb::task_arena(1).execute([&] { one = healthOf(mesh); });
  tbb::task_arena(8).execute([&] { eight = healthOf(mesh); });
  EXPECT_GT(one.selfIntersections, 0);
  EXPECT_EQ(one.selfIntersections, eight.selfIntersections);
  EXPECT_EQ(one.signedVolume, eight.signedVolume);
  EXPECT_EQ(one.components, 2);
}

}  // namespace
}  // namespace exemplar
