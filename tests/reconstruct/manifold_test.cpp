// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/manifold.h"

#include <gtest/gtest.h>

#include <map>

#include "core/random.h"
#include "mesh/primitives.h"
#include "tests/reconstruct/fields.h"

namespace exemplar {
namespace {

/// Joins vertices at equal positions, by which touching solids become one non-manifold mesh.
TriangleMesh joined(const TriangleMesh& mesh) {
  TriangleMesh result = mesh;
  std::map<std::array<double, 3>, std::uint32_t> known;
  result.positions.clear();
  for (auto& t : result.triangles) {
    for (std::uint32_t& v : t) {
      const Vec3d p = mesh.positions[v];
      const auto [found, added] =
          known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(result.positions.size()));
      if (added) result.positions.push_back(p);
      v = found->second;
    }
  }
  return result;
}

TriangleMesh boxes(const std::vector<Vec3d>& corners) {
  TriangleMesh mesh;
  for (const Vec3d& c : corners) append(mesh, makeBox({c, c + Vec3d{1, 1, 1}}));
  return joined(mesh);
}

TEST(MakeManifold, LeavesASoundMeshAsItIs) {
  const TriangleMesh torus = makeTorus({}, {0, 0, 1}, 2, 1, 12, 8);
  TriangleMesh mesh = torus;
  const ManifoldReport report = makeManifold(mesh, {.separation = 0.1});
  EXPECT_EQ(mesh.positions, torus.positions);
  EXPECT_EQ(mesh.triangles, torus.triangles);
  EXPECT_EQ(report.splitVertices + report.splitEdges + report.removedTriangles, 0);
}

TEST(MakeManifold, TakesApartBoxesThatTouchInAVertex) {
  TriangleMesh mesh = boxes({{0, 0, 0}, {1, 1, 1}});
  ASSERT_GT(meshHealth(mesh).nonManifoldVertices, 0);
  const ManifoldReport report = makeManifold(mesh);
  expectSound(mesh);
  EXPECT_EQ(report.splitVertices, 1);
  EXPECT_EQ(meshHealth(mesh).components, 2);
}

TEST(MakeManifold, TakesApartBoxesThatTouchAlongAnEdge) {
  TriangleMesh mesh = boxes({{0, 0, 0}, {1, 1, 0}});
  ASSERT_EQ(meshHealth(mesh).nonManifoldEdges, 1);
  makeManifold(mesh);
  expectSound(mesh);
  // The solids are parted, not the hollows beside them: each box is whole again.
  EXPECT_EQ(meshHealth(mesh).components, 2);
  EXPECT_NEAR(meshHealth(mesh).signedVolume, 2, 1e-12);
}

TEST(MakeManifold, SeparationMakesCopiesDifferEvenWhenJoinedAgain) {
  TriangleMesh mesh = boxes({{0, 0, 0}, {1, 1, 0}});
  makeManifold(mesh, {.separation = 0.1});
  expectSound(joined(mesh));
}

TEST(MakeManifold, PartsSheetsThatShareAnEdgeAndAreJoinedAroundIt) {
  // A ring of boxes whose first and last touch along an edge: both of its ends belong to one fan on
  // each side, so parting vertices alone leaves four triangles on the edge.
  TriangleMesh mesh = boxes({{0, 0, 0},
                             {1, 1, 0},
                             {0, 0, 1},
                             {1, 1, 1},
                             {0, 1, -1},
                             {1, 0, 2},
                             {0, 0, 2},
                             {1, 1, 2},
                             {0, 0, -1},
                             {1, 1, -1},
                             {1, 0, -1},
                             {0, 1, 2}});
  ASSERT_GT(meshHealth(mesh).nonManifoldEdges, 0);
  makeManifold(mesh, {.separation = 0.05});
  expectSound(mesh);
}

TEST(MakeManifold, RemovesTrianglesThatLieBackToBack) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  const auto count = mesh.triangles.size();
  mesh.positions.push_back({5, 5, 5});
  const auto v = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  mesh.triangles.push_back({0, 1, v});
  mesh.triangles.push_back({1, 0, v});
  mesh.triangles.push_back({0, 0, v});
  const ManifoldReport report = makeManifold(mesh);
  EXPECT_EQ(report.removedTriangles, 3);
  EXPECT_EQ(mesh.triangles.size(), count);
  expectSound(mesh);
}

TEST(MakeManifold, GivesFlatTrianglesAreaByTurningEdges) {
  // A box with a vertex in the middle of one side of one face: a triangle without area.
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  const auto [a, b, c] = mesh.triangles[0];
  const auto m = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5);
  mesh.triangles[0] = {a, m, c};
  mesh.triangles.push_back({m, b, c});
  mesh.triangles.push_back({a, b, m});
  ASSERT_EQ(meshHealth(mesh).degenerateTriangles, 1);
  const ManifoldReport report = makeManifold(mesh);
  EXPECT_EQ(report.repairedTriangles, 1);
  expectSound(mesh);
  EXPECT_NEAR(meshHealth(mesh).signedVolume, 1, 1e-12);  // nothing had to move
}

TEST(MakeManifold, GivesCoincidentVerticesPlacesOfTheirOwn) {
  TriangleMesh mesh = makeSphere({}, 1, 3);
  const auto [a, b, c] = mesh.triangles[10];
  mesh.positions[a] = mesh.positions[b];
  ASSERT_GT(meshHealth(mesh).degenerateTriangles, 0);
  EXPECT_EQ(makeManifold(mesh).degenerateTriangles, 0);
  expectSound(mesh);
}

// Any soup: what was balanced closes, and every promise but closedness holds for the rest.
TEST(MakeManifold, MakesAnySoupManifoldAndOriented) {
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    const Random random(trial);
    TriangleMesh mesh;
    for (int v = 0; v < 15; ++v) {
      mesh.positions.push_back({random.uniform(v, 0), random.uniform(v, 1), random.uniform(v, 2)});
    }
    for (int t = 0; t < 60; ++t) {
      mesh.triangles.push_back({random.below(15, 100 + t, 0), random.below(15, 100 + t, 1),
                                random.below(15, 100 + t, 2)});
    }
    const ManifoldReport report = makeManifold(mesh, {.separation = 0.1});
    expectSound(mesh, false);
    EXPECT_EQ(meshHealth(mesh).boundaryEdges, report.boundaryEdges);
  }
}

TEST(MakeManifold, ClosesAnyBalancedSoup) {
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    // Random tetrahedra on few vertices: every edge has as many triangles each way.
    const Random random(trial);
    TriangleMesh mesh;
    for (int v = 0; v < 9; ++v) {
      mesh.positions.push_back({random.uniform(v, 0), random.uniform(v, 1), random.uniform(v, 2)});
    }
    for (int t = 0; t < 20; ++t) {
      std::array<std::uint32_t, 4> q;
      for (int c = 0; c < 4; ++c) q[c] = random.below(9, 50 + t, c);
      mesh.triangles.insert(
          mesh.triangles.end(),
          {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}, {q[0], q[3], q[1]}, {q[1], q[3], q[2]}});
    }
    makeManifold(mesh, {.separation = 0.1});
    if (!mesh.triangles.empty()) expectSound(mesh);
  }
}

TEST(MakeManifold, CarriesAttributesThroughSplits) {
  TriangleMesh mesh = boxes({{0, 0, 0}, {1, 1, 0}});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    mesh.triangleMaterials.push_back(t < 12 ? 0 : 1);
    std::array<Vec2f, 3> uvs;
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = mesh.positions[mesh.triangles[t][c]];
      uvs[c] = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
    mesh.uvs.push_back(uvs);
  }
  for (const Vec3d& p : mesh.positions) {
    mesh.colors.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 0, 1});
  }
  mesh.materials.resize(2);
  makeManifold(mesh);
  validate(mesh, "split");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[t][c];
      const Vec3d& p = mesh.positions[v];
      EXPECT_EQ(mesh.uvs[t][c], (Vec2f{static_cast<float>(p.x), static_cast<float>(p.y)}));
      EXPECT_EQ(mesh.colors[v][0], static_cast<float>(p.x));
      EXPECT_EQ(mesh.triangleMaterials[t], p.x + p.y > 2.001 ? 1u : mesh.triangleMaterials[t]);
    }
  }
}

}  // namespace
}  // namespace exemplar
