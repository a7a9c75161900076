// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace exemplar {
namespace {

double area(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& normal) {
  return dot(cross(b - a, c - a), normal) / 2;
}

/// Cuts a flat polygon and checks that the triangles cover it once: all wind as it does, and their
/// areas add up to its own. Returns whether both hold.
bool coversOnce(const std::vector<Vec3d>& polygon, const Vec3d& normal) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (!triangulate(polygon, triangles) || triangles.size() != polygon.size() - 2) return false;
  double whole = 0, sum = 0, smallest = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    whole += area(polygon[0], polygon[i], polygon[i + 1], normal);
  }
  for (const auto& [a, b, c] : triangles) {
    const double piece = area(polygon[a], polygon[b], polygon[c], normal);
    sum += piece;
    smallest = std::min(smallest, piece);
  }
  // Pieces that lie on each other would have both signs; rounding is below 1e-12 of the whole.
  return smallest >= -1e-12 * whole && std::abs(sum - whole) <= 1e-12 * whole;
}

/// A star-shaped polygon with random radii in a plane across `normal`: mostly concave.
std::vector<Vec3d> randomStar(int corners, const Vec3d& normal, std::uint64_t trial) {
  const Random random(trial);
  const Vec3d helper = std::abs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d u = normalized(cross(helper, normal)), v = cross(normal, u);
  std::vector<Vec3d> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = random.uniform(0.2, 1, static_cast<std::uint64_t>(i));
    polygon.push_back(Vec3d{10, -20, 30} + u * (radius * std::cos(angle)) +
                      v * (radius * std::sin(angle)));
  }
  return polygon;
}

TEST(Triangulate, CoversConcavePolygonsOnce) {
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    const Random random(trial, 1);
    const Vec3d normal = normalized(Vec3d{random.normal(0), random.normal(1), random.normal(2)});
    const int corners = 4 + static_cast<int>(random.below(40, 3));
    EXPECT_TRUE(coversOnce(randomStar(corners, normal, trial), normal)) << trial;
  }
}

TEST(Triangulate, CutsAConcaveQuadrilateralAlongTheDiagonalInside) {
  for (int turn = 0; turn < 4; ++turn) {
    const Vec3d arrow[4] = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
    std::vector<Vec3d> polygon;
    for (int i = 0; i < 4; ++i) polygon.push_back(arrow[(i + turn) % 4]);
    EXPECT_TRUE(coversOnce(polygon, {0, 0, 1})) << turn;
  }
}

TEST(Triangulate, TheCheckerSeesAFanThatLeavesThePolygon) {
  const std::vector<Vec3d> arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  EXPECT_LT(
      area(arrow[0], arrow[2], arrow[3], {0, 0, 1}) * area(arrow[0], arrow[1], arrow[2], {0, 0, 1}),
      0)
      << "a fan from corner 0 would fold over";
}

TEST(Triangulate, CoversAHoleThatABridgeJoins) {
  const std::vector<Vec3d> frame{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                 {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  EXPECT_TRUE(coversOnce(frame, {0, 0, 1}));
}

TEST(Triangulate, CoversAPolygonWithCornersOnStraightSides) {
  std::vector<Vec3d> square;
  for (int i = 0; i < 8; ++i) square.push_back({i / 8.0, 0, 0});
  for (int i = 0; i < 8; ++i) square.push_back({1, i / 8.0, 0});
  square.push_back({1, 1, 0});
  square.push_back({0.5, 0.5, 0});  // concave, so that ears are clipped
  square.push_back({0, 1, 0});
  EXPECT_TRUE(coversOnce(square, {0, 0, 1}));
}

TEST(Triangulate, GivesTrianglesForWhatIsNoPolygon) {
  const std::vector<std::vector<Vec3d>> odd{
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},             // crosses itself
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},  // a point
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}},             // a line
      {{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}};            // not flat
  for (const auto& polygon : odd) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    EXPECT_TRUE(triangulate(polygon, triangles));
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
  }
}

TEST(Triangulate, RefusesAHugeConcavePolygonAndTakesAHugeConvexOne) {
  std::vector<Vec3d> polygon;
  for (std::size_t i = 0; i <= kMostCorners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / (kMostCorners + 1.0);
    polygon.push_back({std::cos(angle), std::sin(angle), 0});
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  EXPECT_TRUE(triangulate(polygon, triangles));
  polygon[5] = {0, 0, 0};
  triangles.clear();
  EXPECT_FALSE(triangulate(polygon, triangles));
  EXPECT_TRUE(triangles.empty());
}

}  // namespace
}  // namespace exemplar
