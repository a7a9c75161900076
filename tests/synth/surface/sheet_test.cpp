// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "tests/synth/surface/surfaces.h"

namespace exemplar::surface {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Sheet, CutsEdgesAndKeepsTheShape) {
  const TriangleMesh box = makeBox({{0, 0, 0}, {3, 2, 1}});
  const Sheet sheet = makeSheet(box, {.edge = 0.2});
  for (const Sheet::Edge& e : sheet.edges) EXPECT_LE(e.length, 0.2);
  EXPECT_NEAR(sheet.area, 22, 1e-12);
  for (const Vec3d& p : sheet.positions) {
    const bool onFace = p.x == 0 || p.x == 3 || p.y == 0 || p.y == 2 || p.z == 0 || p.z == 1;
    EXPECT_TRUE(onFace);
  }
  EXPECT_TRUE(sheet.closed());
  EXPECT_EQ(sheet.eulerCharacteristic(), 2);
}

TEST(Sheet, NormalsGoOnWhereItIsSmoothAndBreakAtCreases) {
  const Sheet box = makeSheet(makeBox({{0, 0, 0}, {1, 1, 1}}), {.edge = 0.2});
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    for (const Vec3d& n : box.normals[t])
      EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-12);
  }
  const Sheet ball = makeSheet(makeSphere({0, 0, 0}, 1, 6), {.edge = 0.05});
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      EXPECT_GT(dot(ball.normals[t][c], normalized(ball.positions[ball.triangles[t][c]])), 0.995);
}

TEST(Sheet, AnglesAroundANodeAreOnceAroundAndMatchSpace) {
  const Sheet sheet = makeSheet(makeTorus({0, 0, 0}, {0, 0, 1}, 1, 0.4, 40, 20), {.edge = 0.1});
  for (std::uint32_t v = 0; v < sheet.positions.size(); v += 7) {
    double last = 0;
    for (const std::uint32_t t : sheet.trianglesAt(v)) {
      const auto& nodes = sheet.triangles[t];
      const int c = nodes[0] == v ? 0 : nodes[1] == v ? 1 : 2;
      const Sheet::Edge& e = sheet.edges[sheet.sides[t][c]];
      const double angle = e.a == v ? e.angleA : e.angleB;
      EXPECT_GE(angle, last);
      EXPECT_LT(angle, 2 * kPi + 1e-9);
      last = angle;
      const Vec3d along = sheet.positions[e.a == v ? e.b : e.a] - sheet.positions[v];
      // The defect of a triangle's corner is about its area over the curvature radii.
      EXPECT_NEAR(std::remainder(sheet.angleOf(v, along) - angle, 2 * kPi), 0, 0.06);
    }
  }
}

TEST(Sheet, EulerCharacteristicsAreThoseOfTheSurfaces) {
  EXPECT_EQ(makeSheet(makeSphere({0, 0, 0}, 1, 6), {.edge = 1}).eulerCharacteristic(), 2);
  EXPECT_EQ(makeSheet(makeTorus({0, 0, 0}, {0, 0, 1}, 1, 0.4), {.edge = 1}).eulerCharacteristic(),
            0);
  EXPECT_EQ(makeSheet(genusThreeMesh(), {.edge = 1}).eulerCharacteristic(), -4);
}

TEST(Sheet, IsFinerWhereTheExampleIsSmaller) {
  const TriangleMesh plane = planeMesh(2, 4);
  std::vector<double> sizes;
  for (const Vec3d& p : plane.positions) sizes.push_back(p.x < 1 ? 0.5 : 2);
  Sheet sheet = makeSheet(plane, {.edge = 0.2, .sizes = sizes});
  double left = 0, right = 0;
  for (const Sheet::Edge& edge : sheet.edges) {
    EXPECT_LE(edge.length, 0.2 * sheet.sizeOf(edge) + 1e-12);
    (sheet.positions[edge.a].x < 1 ? left : right) += 1;
  }
  EXPECT_GT(left, 4 * right);
  // Steps become slopes, and nothing becomes larger.
  const std::vector<double> before = sheet.sizes;
  evenSizes(sheet, 0.7);
  for (std::size_t v = 0; v < before.size(); ++v) {
    EXPECT_LE(sheet.sizes[v], before[v]);
    if (sheet.positions[v].x < 0.5) {
      EXPECT_EQ(sheet.sizes[v], before[v]);
    }
  }
  for (const Sheet::Edge& edge : sheet.edges)
    EXPECT_LE(std::abs(std::log(sheet.sizes[edge.a] / sheet.sizes[edge.b])),
              0.7 * edge.length + 1e-12);
}

TEST(Sheet, RefusesWhatIsNoManifold) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_THROW(makeSheet(mesh, {.edge = 1}), InputError);
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};  // turned against each other
  EXPECT_THROW(makeSheet(mesh, {.edge = 1}), InputError);
  mesh.triangles = {{0, 1, 2}, {0, 4, 3}};  // touch in a point
  EXPECT_THROW(makeSheet(mesh, {.edge = 1}), InputError);
  mesh.triangles = {{0, 1, 1}};
  EXPECT_THROW(makeSheet(mesh, {.edge = 1}), InputError);
}

}  // namespace
}  // namespace exemplar::surface
