// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/random.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

Triangles randomTriangles(std::uint64_t seed, std::uint32_t vertices, int count) {
  const Random random(seed);
  Triangles triangles;
  for (int t = 0; static_cast<int>(triangles.size()) < count; ++t) {
    const std::array<std::uint32_t, 3> v{random.below(vertices, t, 0), random.below(vertices, t, 1),
                                         random.below(vertices, t, 2)};
    if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) triangles.push_back(v);
  }
  return triangles;
}

TEST(EdgeGroups, HoldEveryHalfedgeOnceByEdge) {
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const Triangles triangles = randomTriangles(trial, 12, 40);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> expected;
    for (std::uint32_t h = 0; h < 3 * triangles.size(); ++h) {
      const auto [low, high] =
          std::pair(std::min(fromVertex(triangles, h), toVertex(triangles, h)),
                    std::max(fromVertex(triangles, h), toVertex(triangles, h)));
      expected[{low, high}].push_back(h);
    }
    const EdgeGroups groups = edgeGroups(triangles, 12);
    ASSERT_EQ(groups.count(), expected.size());
    std::size_t e = 0;
    for (const auto& [edge, halfedges] : expected) {
      EXPECT_TRUE(std::ranges::equal(groups.group(e++), halfedges));
    }
  }
}

TEST(MateHalfedges, PairAllOfAClosedSurfaceBothWays) {
  const TriangleMesh torus = makeTorus({}, {0, 0, 1}, 2, 1, 12, 8);
  const auto mates = mateHalfedges(torus.triangles, torus.positions.size());
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    ASSERT_NE(mates[h], kNone);
    EXPECT_EQ(mates[mates[h]], h);
    EXPECT_EQ(fromVertex(torus.triangles, h), toVertex(torus.triangles, mates[h]));
  }
}

TEST(MateHalfedges, LeaveRimsAndEdgesOfThreeAlone) {
  // Three triangles on the edge 0-1, one of them alone elsewhere.
  const Triangles triangles{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  for (const std::uint32_t mate : mateHalfedges(triangles, 5)) EXPECT_EQ(mate, kNone);
}

TEST(VertexComponents, AreNumberedByTheirLowestVertex) {
  const Triangles triangles{{5, 6, 7}, {0, 3, 4}, {4, 8, 1}};
  std::uint32_t count = 0;
  const auto part = vertexComponents(triangles, 9, &count);
  EXPECT_EQ(part, (std::vector<std::uint32_t>{0, 0, 1, 0, 0, 2, 2, 2, 0}));
  EXPECT_EQ(count, 3u);  // vertex 2 is alone
}

TEST(KeepTriangles, CarriesEveryAttributeOfWhatStays) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {2, 3, 4}};
  mesh.colors = {{0, 0, 0, 1}, {0.1f, 0, 0, 1}, {0.2f, 0, 0, 1}, {0.3f, 0, 0, 1}, {0.4f, 0, 0, 1}};
  mesh.uvs = {{Vec2f{1, 1}, {}, {}}, {Vec2f{2, 2}, {}, {}}};
  mesh.triangleMaterials = {7, 9};
  keepTriangles(mesh, std::vector<std::uint8_t>{0, 1});
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[0], (Vec3d{2, 0, 0}));
  EXPECT_EQ(mesh.colors[2][0], 0.4f);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(mesh.uvs[0][0], (Vec2f{2, 2}));
  EXPECT_EQ(mesh.triangleMaterials, (std::vector<std::uint32_t>{9}));
}

}  // namespace
}  // namespace exemplar
