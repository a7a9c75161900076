// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/triangle_soup.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/primitives.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

// Each triangle with vertices of its own.
TriangleMesh split(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    for (const std::uint32_t v : t) result.positions.push_back(mesh.positions[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

double volume(const TriangleSoup& soup) {
  double sum = 0;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const auto [a, b, c] = cornersOf(soup, t);
    sum += dot(a, cross(b, c)) / 6;
  }
  return sum;
}

TEST(TriangleSoup, JoinsEqualPositionsAlsoZerosOfBothSigns) {
  TriangleMesh mesh = split(makeBox({{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(mesh.positions.size(), 36u);
  for (std::size_t p = 0; p < mesh.positions.size(); p += 2)
    if (mesh.positions[p].x == 0) mesh.positions[p].x = -0.0;
  const TriangleSoup soup = makeSoup(mesh, {}, 1);
  EXPECT_EQ(soup.points.size(), 8u);
  EXPECT_EQ(soup.triangles.size(), 12u);
  EXPECT_TRUE(soup.closed);
  EXPECT_TRUE(soup.even);
  EXPECT_EQ(soup.componentClosed, std::vector<std::uint8_t>{1});
  for (const auto& n : soup.neighbors)
    for (const std::uint32_t u : n) EXPECT_NE(u, TriangleSoup::kNone);
}

TEST(TriangleSoup, MovesAndScalesPositions) {
  const TriangleSoup soup = makeSoup(makeBox({{1, 2, 3}, {3, 4, 5}}), {1, 2, 3}, 0.5);
  Box3d box;
  for (const Vec3d& p : soup.points) box.add(p);
  EXPECT_EQ(box.min, (Vec3d{0, 0, 0}));
  EXPECT_EQ(box.max, (Vec3d{4, 4, 4}));
}

TEST(TriangleSoup, LeavesOutTrianglesWithoutArea) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.positions.push_back({0.5, 0, 0});
  mesh.triangles.push_back({0, 0, 1});
  mesh.positions.push_back({1, 1, 1});
  mesh.positions.push_back({2, 2, 2});
  mesh.positions.push_back({3, 3, 3});
  mesh.triangles.push_back({9, 10, 11});
  EXPECT_EQ(makeSoup(mesh, {}, 1).triangles.size(), 12u);
}

TEST(TriangleSoup, CountsEqualTrianglesOnceAndOppositeOnesNotAtAll) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  append(mesh, split(mesh));
  EXPECT_EQ(makeSoup(mesh, {}, 1).triangles.size(), 12u);
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {2, 1, 0}};
  EXPECT_TRUE(makeSoup(sheet, {}, 1).triangles.empty());
  sheet.triangles.push_back({1, 2, 0});
  const TriangleSoup one = makeSoup(sheet, {}, 1);
  ASSERT_EQ(one.triangles.size(), 1u);
  const auto [a, b, c] = cornersOf(one, 0);
  EXPECT_GT(cross(b - a, c - a).z, 0);
}

TEST(TriangleSoup, TurnsFlippedTrianglesLikeTheirNeighbors) {
  TriangleMesh mesh = split(makeTorus({}, {0, 0, 1}, 0.7, 0.25));
  const double before = volume(makeSoup(mesh, {}, 1));
  const Random random(1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (random.uniform(t) < 0.3) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const TriangleSoup soup = makeSoup(mesh, {}, 1);
  EXPECT_TRUE(soup.closed);
  EXPECT_NEAR(volume(soup), before, 1e-9);
}

TEST(TriangleSoup, LeavesOneSidedSurfacesAsTheyAre) {
  // A Moebius band of six quads.
  TriangleMesh band;
  constexpr int n = 6;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * 3.14159265358979 * i / n;
    const Vec3d out{std::cos(a), std::sin(a), 0};
    const Vec3d across = out * (0.3 * std::cos(a / 2)) + Vec3d{0, 0, 0.3 * std::sin(a / 2)};
    band.positions.push_back(out - across);
    band.positions.push_back(out + across);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    std::uint32_t c = 2 * (i + 1), d = c + 1;
    if (i + 1 == n) {
      c = 1;
      d = 0;
    }
    band.triangles.push_back({a, c, d});
    band.triangles.push_back({a, d, b});
  }
  const TriangleSoup soup = makeSoup(band, {}, 1);
  EXPECT_EQ(soup.triangles.size(), 12u);
  EXPECT_FALSE(soup.closed);
  EXPECT_FALSE(soup.even);
}

TEST(TriangleSoup, TellsOpenFromClosedComponents) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.triangles.pop_back();
  append(mesh, makeSphere({5, 0, 0}, 1, 2));
  const TriangleSoup soup = makeSoup(mesh, {}, 1);
  EXPECT_FALSE(soup.closed);
  EXPECT_FALSE(soup.even);
  EXPECT_EQ(soup.componentClosed, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(std::count(soup.component.begin(), soup.component.end(), 0u), 11);
}

TEST(TriangleSoup, BoxesThatShareAnEdgeAreClosed) {
  // Four triangles meet at the common edge, two each way.
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  append(mesh, makeBox({{1, 1, 0}, {2, 2, 1}}));
  const TriangleSoup soup = makeSoup(mesh, {}, 1);
  EXPECT_TRUE(soup.closed);
  EXPECT_EQ(soup.points.size(), 14u);
  int without = 0;
  for (const auto& n : soup.neighbors)
    for (const std::uint32_t u : n) without += u == TriangleSoup::kNone;
  EXPECT_EQ(without, 4);
}

}  // namespace
}  // namespace exemplar
