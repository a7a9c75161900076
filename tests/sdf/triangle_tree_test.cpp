// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "mesh/primitives.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Corners> cornersOf(const TriangleMesh& mesh) {
  std::vector<Corners> corners;
  for (const auto& [a, b, c] : mesh.triangles)
    corners.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
  return corners;
}

std::vector<Corners> randomTriangles(int count, std::uint64_t seed) {
  const Random random(seed);
  std::vector<Corners> triangles(count);
  for (int t = 0; t < count; ++t)
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis)
        triangles[t][c][axis] =
            random.uniform(t, axis) + random.uniform(-0.15, 0.15, t, 3 + 3 * c + axis);
  return triangles;
}

Vec3d randomPoint(int trial, double low = -0.5, double high = 1.5) {
  const Random random(99);
  return {random.uniform(low, high, trial, 0), random.uniform(low, high, trial, 1),
          random.uniform(low, high, trial, 2)};
}

// The solid angles one by one, each with an arc tangent of its own.
double exactWinding(const std::vector<Corners>& triangles, const Vec3d& p) {
  double sum = 0;
  for (const Corners& t : triangles) {
    const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += std::atan2(dot(a, cross(b, c)),
                      la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

TEST(TriangleTree, FindsTheNearestTriangleExactly) {
  for (const int count : {1, 2, 4, 5, 9, 300}) {
    const auto triangles = randomTriangles(count, count);
    const TriangleTree tree(triangles);
    ASSERT_EQ(tree.count(), triangles.size());
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3d p = randomPoint(trial);
      double nearest = kInfinity;
      for (const Corners& t : triangles) nearest = std::min(nearest, squaredDistance(p, t));
      ASSERT_EQ(tree.distance(p, kInfinity), std::sqrt(nearest));
      ASSERT_EQ(tree.distance(p, 0.1), std::min(0.1, std::sqrt(nearest)));
    }
  }
}

TEST(TriangleTree, MissesNoTriangleOfASurfaceSeenFromNearOrFar) {
  // Discs are tight on surfaces, and degenerate on sheets, on needles and at a single place.
  const Box3d sheet{{-1, -1, 0}, {1, 1, 0}}, needle{{-1e-7, -1e-7, -1}, {1e-7, 1e-7, 1}};
  const std::vector<TriangleMesh> meshes{
      makeSphere({}, 1, 12), makeTorus({}, {1, 2, 3}, 0.7, 0.25, 40, 20), makeBox(sheet),
      makeBox(needle), makeBox({{0.3, 0.3, 0.3}, {0.3, 0.3, 0.3}})};
  for (const TriangleMesh& mesh : meshes) {
    const std::vector<Corners> triangles = cornersOf(mesh);
    const TriangleTree tree(triangles);
    std::uint32_t near = TriangleTree::kNone;
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3d p = randomPoint(trial, -1.5, 1.5) * (trial % 4 == 0 ? 100 : 1);
      double nearest = kInfinity;
      for (const Corners& t : triangles) nearest = std::min(nearest, squaredDistance(p, t));
      ASSERT_EQ(tree.distance(p, kInfinity), std::sqrt(nearest));
      // From the triangle that was nearest to another point.
      ASSERT_EQ(tree.distance(p, kInfinity, near), std::sqrt(nearest));
      ASSERT_EQ(squaredDistance(p, triangles[near]), nearest);
    }
    std::uint32_t none = 0;
    EXPECT_EQ(tree.distance({9, 9, 9}, 1, none), 1);
    EXPECT_EQ(none, TriangleTree::kNone);
  }
}

TEST(TriangleTree, WindsOnceInsideClosedSurfacesAndNotOutside) {
  for (const TriangleMesh& mesh :
       {makeSphere({}, 1, 20), makeTorus({}, {0, 0, 1}, 0.7, 0.25, 80, 40)}) {
    const TriangleTree tree(cornersOf(mesh));
    const test::Shape shape =
        mesh.triangles.size() == 8000 ? test::sphere({}, 1) : test::torus({}, 0.7, 0.25);
    for (int trial = 0; trial < 1000; ++trial) {
      const Vec3d p = randomPoint(trial, -1.3, 1.3);
      const double d = shape(p);
      if (std::abs(d) > 0.01) {
        ASSERT_NEAR(tree.windingNumber(p), d < 0 ? 1 : 0, 0.01);
      }
    }
  }
}

TEST(TriangleTree, ApproximatesOpenSurfacesWithinAHundredth) {
  auto triangles = cornersOf(makeTorus({}, {0, 0, 1}, 0.7, 0.3, 100, 50));
  std::size_t n = 0;
  std::erase_if(triangles, [&](const Corners&) { return n++ % 3 == 0; });
  const TriangleTree tree(triangles);
  double worst = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3d p = randomPoint(trial, -1.3, 1.3);
    worst = std::max(worst, std::abs(tree.windingNumber(p) - exactWinding(triangles, p)));
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_GT(worst, 1e-6);  // it is an approximation that is being tested
}

TEST(TriangleTree, IsSureOfTheSideRightBesideTheSurface) {
  const auto triangles = cornersOf(makeSphere({}, 1, 12));
  const TriangleTree tree(triangles);
  for (const Corners& t : triangles) {
    const Vec3d middle = (t[0] + t[1] + t[2]) / 3.0,
                normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
    ASSERT_NEAR(tree.windingNumber(middle + normal * 1e-9), 0, 0.01);
    ASSERT_NEAR(tree.windingNumber(middle - normal * 1e-9), 1, 0.01);
  }
}

TEST(TriangleTree, CountsTurnsOfOverlappingSurfaces) {
  // Forty nested spheres: products of many solid angles go round many times.
  std::vector<Corners> triangles;
  for (int shell = 0; shell < 40; ++shell)
    for (const Corners& t : cornersOf(makeSphere({}, 1 + 0.01 * shell, 2))) triangles.push_back(t);
  const TriangleTree tree(triangles);
  // The expansion's error adds up over the shells.
  EXPECT_NEAR(tree.windingNumber({0.1, 0.05, 0}), 40, 0.4);
  for (Corners& t : triangles) std::swap(t[0], t[1]);
  EXPECT_NEAR(TriangleTree(triangles).windingNumber({0.1, 0.05, 0}), -40, 0.4);
}

TEST(TriangleTree, BatchesAgreeWithSinglePoints) {
  const auto triangles = randomTriangles(500, 8);
  const TriangleTree tree(triangles);
  std::vector<Vec3d> points;
  for (int p = 0; p < 150; ++p) points.push_back(randomPoint(p, 0.4, 0.6));
  std::vector<double> batch(points.size());
  tree.windingNumbers(points, batch);
  for (std::size_t p = 0; p < points.size(); ++p) {
    // Batches use the expansion less, so that they differ by its error.
    ASSERT_NEAR(batch[p], tree.windingNumber(points[p]), 0.02);
    ASSERT_NEAR(batch[p], exactWinding(triangles, points[p]), 0.02);
  }
}

TEST(TriangleTree, VisitsExactlyTheTrianglesThatMeetABox) {
  const auto triangles = randomTriangles(200, 3);
  const TriangleTree tree(triangles);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3d low = randomPoint(trial), high = low + Vec3d{0.1, 0.3, 0.2};
    std::vector<std::uint32_t> visited, expected;
    tree.visitBox(low, high, [&](std::uint32_t t) { visited.push_back(t); });
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      const Vec3d l = min(min(a, b), c), h = max(max(a, b), c);
      if (l.x <= high.x && l.y <= high.y && l.z <= high.z && h.x >= low.x && h.y >= low.y &&
          h.z >= low.z)
        expected.push_back(t);
    }
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(visited, expected);
  }
}

TEST(TriangleTree, WithoutTrianglesIsFarFromEverything) {
  const TriangleTree tree({});
  EXPECT_EQ(tree.distance({1, 2, 3}, 7), 7);
  EXPECT_EQ(tree.windingNumber({1, 2, 3}), 0);
  tree.visitBox({-9, -9, -9}, {9, 9, 9}, [](std::uint32_t) { FAIL(); });
}

TEST(TriangleTree, KeepsManyTrianglesAtOnePlaceApart) {
  const TriangleTree tree(
      std::vector<Corners>(5000, Corners{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}));
  EXPECT_DOUBLE_EQ(tree.distance({0.2, 0.2, 3}, kInfinity), 3);
}

TEST(TriangleTree, StopsBuildingWhereItIsCancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_THROW(TriangleTree(randomTriangles(20, 1), Progress({}, &cancel)), Cancelled);
}

}  // namespace
}  // namespace exemplar
