// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/simplify.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

TEST(Simplified, KeepsTheShape) {
  const TriangleMesh ball = makeSphere({5, 5, 5}, 3, 60);  // 20 * 60² triangles
  for (const int most : {200, 2000, 20000}) {
    SCOPED_TRACE(most);
    const TriangleMesh coarse = simplified(ball, most);
    EXPECT_LE(coarse.triangles.size(), static_cast<std::size_t>(most));
    EXPECT_GT(coarse.triangles.size(), static_cast<std::size_t>(most) * 9 / 10);
    // Corners are the ball's own. A triangle's middle lies off the ball by its circumradius squared
    // over the diameter; edges are up to three times as long as in equilateral triangles of one
    // size.
    const double edge = 3 * std::sqrt(4 * 3.1416 * 9 / most * 4 / std::sqrt(3.0));
    for (const Vec3d& p : coarse.positions) EXPECT_NEAR(length(p - Vec3d{5, 5, 5}), 3, 1e-9);
    for (const auto& t : coarse.triangles) {
      const Vec3d middle =
          (coarse.positions[t[0]] + coarse.positions[t[1]] + coarse.positions[t[2]]) / 3.0;
      EXPECT_NEAR(length(middle - Vec3d{5, 5, 5}), 3, edge * edge / 3 / 6);
    }
  }
}

TEST(Simplified, KeepsWhatIsSmallEnough) {
  const TriangleMesh ball = makeSphere({5, 5, 5}, 3, 10);  // 20 * 10²
  EXPECT_EQ(simplified(ball, 2000).triangles.size(), 2000u);
  EXPECT_EQ(simplified(ball, 50000).triangles.size(), 2000u);
}

TEST(Simplified, JoinsVerticesAtOnePlace) {
  // Each triangle with vertices of its own: a surface all the same.
  const TriangleMesh ball = makeSphere({5, 5, 5}, 3, 30);
  TriangleMesh loose;
  for (const auto& t : ball.triangles) {
    const auto n = static_cast<std::uint32_t>(loose.positions.size());
    for (const std::uint32_t v : t) loose.positions.push_back(ball.positions[v]);
    loose.triangles.push_back({n, n + 1, n + 2});
  }
  const TriangleMesh coarse = simplified(loose, 2000);
  // A closed surface of F triangles has F / 2 + 2 vertices.
  EXPECT_EQ(coarse.positions.size(), coarse.triangles.size() / 2 + 2);
  EXPECT_GT(coarse.triangles.size(), 1900u);
  for (const Vec3d& p : coarse.positions) EXPECT_NEAR(length(p - Vec3d{5, 5, 5}), 3, 1e-9);
}

TEST(Simplified, OfASoupTheSurfaceIsLeft) {
  // A ball whose triangles have vertices of their own, a little apart.
  const TriangleMesh ball = makeSphere({0, 0, 0}, 1, 60);
  TriangleMesh soup;
  const Random random(2);
  for (const auto& t : ball.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t)
      soup.positions.push_back(ball.positions[v] * random.uniform(0.9999, 1, n + v));
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const TriangleMesh coarse = simplified(soup, 8000);
  EXPECT_LE(coarse.triangles.size(), 8000u);
  double area = 0;
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t)
    area += length(areaNormal(coarse, t)) / 2;
  // Not the ninth of it that 8,000 of the 72,000 triangles would be.
  EXPECT_NEAR(area, 4 * 3.1416, 0.15 * 4 * 3.1416);
}

TEST(Simplified, TakesTrianglesThatShareNothing) {
  TriangleMesh soup;
  const Random random(1);
  for (std::uint32_t n = 0; n < 9000; ++n)
    soup.positions.push_back({random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)});
  for (std::uint32_t n = 0; n < 3000; ++n) soup.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  const TriangleMesh coarse = simplified(soup, 1000);
  EXPECT_LE(coarse.triangles.size(), 1000u);
  EXPECT_GT(coarse.triangles.size(), 0u);
  EXPECT_EQ(coarse.triangles, simplified(soup, 1000).triangles);
}

TEST(Simplified, GivesSomethingEvenForOneTriangle) {
  EXPECT_EQ(simplified(makeSphere({0, 0, 0}, 1), 1).triangles.size(), 1u);
}

}  // namespace
}  // namespace exemplar
