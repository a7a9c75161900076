// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/foot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "tests/synth/surface/surfaces.h"

namespace exemplar::surface {
namespace {

TEST(Foot, IsAsHighAsThePointIsOverASphere) {
  // Coarse, so that its facets show in distances and not in normals.
  const Sheet sheet = makeSheet(makeSphere({0, 0, 0}, 1, 8), {.edge = 0.1});
  const FootFinder feet(sheet);
  const Random random(1);
  for (int n = 0; n < 500; ++n) {
    const Vec3d d =
        normalized(Vec3d{random.normal(n, 0), random.normal(n, 2), random.normal(n, 4)});
    const double height = random.uniform(-0.3, 0.3, n, 6);
    std::uint32_t near = TriangleTree::kNone;
    const auto foot = feet.find(d * (1 + height), 1, near);
    ASSERT_TRUE(foot);
    // A facet with edges e lies up to e²/6 below the sphere.
    EXPECT_NEAR(foot->height, height, 0.006);
    EXPECT_NEAR(foot->distance, height, 0.006);
    Vec3d at{};
    for (int c = 0; c < 3; ++c)
      at += sheet.positions[sheet.triangles[foot->triangle][c]] * foot->weights[c];
    EXPECT_GT(dot(normalized(at), d), std::cos(0.01));
  }
}

TEST(Foot, SignsAreRightAtSharpEdgesAndCorners) {
  const Sheet sheet = makeSheet(makeBox({{0, 0, 0}, {1, 1, 1}}), {.edge = 0.3});
  const FootFinder feet(sheet);
  const Random random(2);
  for (int n = 0; n < 1000; ++n) {
    const Vec3d p{random.uniform(-0.5, 1.5, n, 0), random.uniform(-0.5, 1.5, n, 1),
                  random.uniform(-0.5, 1.5, n, 2)};
    std::uint32_t near = TriangleTree::kNone;
    const auto foot = feet.find(p, 9, near);
    ASSERT_TRUE(foot);
    const bool inside = p.x > 0 && p.y > 0 && p.z > 0 && p.x < 1 && p.y < 1 && p.z < 1;
    EXPECT_EQ(foot->distance < 0, inside);
    EXPECT_EQ(foot->beyond, 0);
  }
}

TEST(Foot, SaysHowFarAPointIsPastABorder) {
  const Sheet sheet = makeSheet(planeMesh(1, 4), {.edge = 0.3});
  const FootFinder feet(sheet);
  std::uint32_t near = TriangleTree::kNone;
  const auto past = feet.find({1.3, 0.5, 0.2}, 9, near);
  ASSERT_TRUE(past);
  EXPECT_NEAR(past->beyond, 0.3, 1e-12);
  EXPECT_NEAR(past->height, 0.2, 1e-12);
  const auto below = feet.find({0.4, 0.5, -0.2}, 9, near);
  ASSERT_TRUE(below);
  EXPECT_EQ(below->beyond, 0);
  EXPECT_NEAR(below->height, -0.2, 1e-12);
}

TEST(Foot, IsNowhereBeyondTheLimit) {
  const Sheet sheet = makeSheet(planeMesh(1, 4), {.edge = 0.3});
  const FootFinder feet(sheet);
  std::uint32_t near = TriangleTree::kNone;
  EXPECT_FALSE(feet.find({0.5, 0.5, 2}, 1, near));
}

}  // namespace
}  // namespace exemplar::surface
