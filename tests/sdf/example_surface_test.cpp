// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/example_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

Vec3d randomPoint(const Random& random, std::uint64_t n, double size) {
  return {random.uniform(-size, size, n, 0), random.uniform(-size, size, n, 1),
          random.uniform(-size, size, n, 2)};
}

/// The nearest of many points spread over a triangle: never nearer than the true nearest, and no
/// farther from it than the spacing.
double sampledDistance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c, int n) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const double u = double(i) / n, v = double(j) / n;
      best = std::min(best, length(a * (1 - u - v) + b * u + c * v - p));
    }
  }
  return best;
}

TEST(ExampleSurface, FindsTheNearestOfRandomTriangles) {
  const Random random(1);
  TriangleMesh mesh;
  for (int t = 0; t < 12; ++t) {
    for (int c = 0; c < 3; ++c) mesh.positions.push_back(randomPoint(random, 3 * t + c, 1));
    const auto v = static_cast<std::uint32_t>(3 * t);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  const ExampleSurface surface(mesh);
  constexpr int n = 60;
  const double spacing = 2 * std::sqrt(3.0) / n;
  for (int q = 0; q < 60; ++q) {
    const Vec3d p = randomPoint(random, 1000 + q, 1.5);
    const auto found = surface.closest(p);
    ASSERT_TRUE(found);
    double sampled = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
      sampled = std::min(
          sampled, sampledDistance(p, mesh.positions[a], mesh.positions[b], mesh.positions[c], n));
    }
    EXPECT_LE(found->distance, sampled + 1e-12);
    EXPECT_GE(found->distance, sampled - spacing);
    // The answer agrees with itself.
    const auto& [a, b, c] = mesh.triangles[found->triangle];
    const auto& w = found->weights;
    EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-12);
    const Vec3d at = mesh.positions[a] * w[0] + mesh.positions[b] * w[1] + mesh.positions[c] * w[2];
    EXPECT_NEAR(length(at - found->position), 0, 1e-12);
    EXPECT_NEAR(length(p - found->position), found->distance, 1e-12);
    for (const double weight : w) EXPECT_GE(weight, -1e-12);
  }
}

TEST(ExampleSurface, RadiusLimitsTheSearch) {
  const ExampleSurface surface(makeSphere({}, 1, 6));
  EXPECT_FALSE(surface.closest({3, 0, 0}, {.radius = 1.9}));
  EXPECT_TRUE(surface.closest({3, 0, 0}, {.radius = 2.1}));
}

TEST(ExampleSurface, FacingTellsTheSidesOfAThinWallApart) {
  const ExampleSurface surface(makeBox({{0, 0, 0}, {10, 10, 0.2}}));
  const Vec3d p{5, 5, 0.12};  // nearer to the top
  EXPECT_NEAR(surface.closest(p)->position.z, 0.2, 1e-12);
  EXPECT_NEAR(surface.closest(p, {.facing = {0, 0, -1}, .facingCost = 1})->position.z, 0, 1e-12);
}

TEST(ExampleSurface, GroupsLimitTheSearch) {
  const TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  std::vector<std::uint32_t> groups;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    groups.push_back(normalized(areaNormal(mesh, t)).z < -0.5 ? 1 : 0);
  }
  const ExampleSurface surface(mesh);
  const auto found = surface.closest({0.5, 0.5, 0.9}, {.groups = groups, .group = 1});
  EXPECT_NEAR(found->position.z, 0, 1e-12);
  EXPECT_FALSE(surface.closest({0.5, 0.5, 0.9}, {.groups = groups, .group = 2}));
}

TEST(ExampleSurface, TiesGoToTheLowestTriangle) {
  // The same triangle three times.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{1, 2, 0}, {0, 1, 2}, {0, 1, 2}};
  EXPECT_EQ(ExampleSurface(mesh).closest({0.2, 0.2, 0.5})->triangle, 0u);
}

TEST(ExampleSurface, FarFromTheOriginItIsAsExact) {
  const Vec3d far{1e6, -2e6, 5e5};
  const ExampleSurface surface(makeSphere(far, 1, 8));
  const auto found = surface.closest(far + Vec3d{0, 0, 1});
  ASSERT_TRUE(found);
  // The sphere's polygon lies up to 0.62 x (1.26 / 8)² / 6 below the sphere; doubles carry 1e-10
  // there.
  EXPECT_LT(found->distance, 0.005);
}

TEST(ExampleSurface, TrianglesWithoutAreaDoNoHarm) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 3, 3}};
  const ExampleSurface surface(mesh);
  EXPECT_NEAR(surface.closest({1.5, 1, 0})->distance, 1, 1e-12);
  EXPECT_NEAR(surface.closest({5, 5, 6})->distance, 1, 1e-12);
  EXPECT_EQ(surface.normal(0), (Vec3d{0, 0, 0}));
}

}  // namespace
}  // namespace exemplar
