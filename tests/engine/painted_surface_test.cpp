// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/painted_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/error.h"
#include "mesh/mesh_health.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

double areaOf(const TriangleMesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += length(areaNormal(mesh, t)) / 2;
  return area;
}

TEST(CoveredPart, IsWhatHasTheMaterial) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  setMaterial(mesh, {.name = "plaster"});
  TriangleMesh other = makeBox({{2, 0, 0}, {4, 2, 2}});
  setMaterial(other, {.name = "stone"});
  append(mesh, other);
  EXPECT_DOUBLE_EQ(areaOf(coveredPart(mesh, "plaster", "wall.glb")), 6);
  EXPECT_DOUBLE_EQ(areaOf(coveredPart(mesh, "stone", "wall.glb")), 24);
}

/// A square of 8 x 8 cells whose red rises from 0 at its left to 1 at its right.
TriangleMesh shadedSquare() {
  const std::vector<double> flat(81, 1);
  TriangleMesh mesh = makeHeightFieldSolid({0, 0, -1}, 0.125, 9, 9, flat, 0.5);
  for (const Vec3d& p : mesh.positions)
    mesh.colors.push_back({static_cast<float>(p.x), 0, 1, 0.25f});
  return mesh;
}

TEST(CoveredPart, IsCutWhereAColorPassesOneHalf) {
  TriangleMesh mesh = shadedSquare();
  // Between vertices, so that triangles are cut: red is one half at 0.55.
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.colors[v][0] = static_cast<float>(mesh.positions[v].x - 0.05);
  const TriangleMesh part = coveredPart(mesh, "red", "wall.ply");
  // Top and bottom, the right side, and what is left of the two others.
  EXPECT_NEAR(areaOf(part), 2 * 0.45 + 0.5 + 2 * 0.45 * 0.5, 1e-6);
  EXPECT_NEAR(boundingBox(part).min.x, 0.55, 1e-6);
}

TEST(CoveredPart, HasOneBorderWhereItWasCut) {
  TriangleMesh ball = makeSphere({}, 1, 8);
  for (const Vec3d& p : ball.positions)
    ball.colors.push_back({static_cast<float>(0.5 + 0.45 * (p.z - 0.1)), 0, 0, 1});
  const TriangleMesh part = coveredPart(ball, "red", "ball.ply");
  // Corners of the cut that two triangles share are equal, to the bit: joined by position, only
  // the cut itself is open.
  std::map<std::array<double, 3>, std::uint32_t> numbers;
  TriangleMesh joined;
  for (const auto& triangle : part.triangles) {
    std::array<std::uint32_t, 3> corners{};
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = part.positions[triangle[c]];
      const auto [at, added] =
          numbers.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(joined.positions.size()));
      if (added) joined.positions.push_back(p);
      corners[c] = at->second;
    }
    joined.triangles.push_back(corners);
  }
  const MeshHealth health = meshHealth(joined);
  EXPECT_TRUE(health.manifold());
  EXPECT_EQ(health.components, 1);
  EXPECT_GT(health.boundaryEdges, 0);
  const std::int64_t edges = (3 * health.triangles + health.boundaryEdges) / 2;
  EXPECT_EQ(health.vertices - edges + health.triangles, 1) << "no disc";
}

TEST(CoveredPart, RefusesWhatIsNotThereNamingWhatIs) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  EXPECT_THAT([&] { coveredPart(mesh, "red", "wall.obj"); },
              ThrowsMessage<InputError>(
                  HasSubstr("wall.obj has neither named materials nor vertex colors")));
  setMaterial(mesh, {.name = "plaster"});
  EXPECT_THAT([&] { coveredPart(mesh, "paint", "wall.obj"); },
              ThrowsMessage<InputError>(HasSubstr("wall.obj has 'plaster'")));
  EXPECT_THAT([] { coveredPart(shadedSquare(), "green", "wall.ply"); },
              ThrowsMessage<InputError>(HasSubstr("nothing of wall.ply is in it")));
}

TEST(PaintedSizes, AreHalfToTwice) {
  const TriangleMesh mesh = shadedSquare();
  const std::vector<double> sizes = paintedSizes(mesh, "red", "wall.ply");
  for (std::size_t v = 0; v < sizes.size(); ++v)
    EXPECT_NEAR(sizes[v], std::pow(2, 2 * mesh.positions[v].x - 1), 1e-6);
  EXPECT_THAT([&] { paintedSizes(mesh, "violet", "wall.ply"); },
              ThrowsMessage<InputError>(HasSubstr("expected red, green, blue or alpha")));
  EXPECT_THAT([] { paintedSizes(makeSphere({}, 1, 2), "red", "ball.obj"); },
              ThrowsMessage<InputError>(HasSubstr("ball.obj has no vertex colors")));
}

}  // namespace
}  // namespace exemplar
