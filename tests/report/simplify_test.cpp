// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/simplify_soup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

TEST(SimplifySoup, KeepsTheShapeWithinACell) {
  const TriangleMesh ball = makeSphere({5, 5, 5}, 3, 60);  // 20 * 60² triangles
  for (const int most : {200, 2000, 20000}) {
    SCOPED_TRACE(most);
    const TriangleMesh coarse = simplifySoup(ball, most);
    EXPECT_LE(coarse.triangles.size(), static_cast<std::size_t>(most));
    EXPECT_GT(coarse.triangles.size(), static_cast<std::size_t>(most) / 4);
    // A cell holds about one vertex, two triangles: its side follows from the ball's area, and a
    // mean of points in it lies off the ball by no more than its diagonal.
    const double side = std::sqrt(4 * 3.1416 * 9 / (0.25 * most / 2));
    for (const Vec3d& p : coarse.positions)
      EXPECT_NEAR(length(p - Vec3d{5, 5, 5}), 3, side * std::sqrt(3.0));
  }
}

TEST(SimplifySoup, TakesTrianglesThatShareNothing) {
  TriangleMesh soup;
  const Random random(1);
  for (std::uint32_t n = 0; n < 9000; ++n)
    soup.positions.push_back({random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)});
  for (std::uint32_t n = 0; n < 3000; ++n) soup.triangles.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  const TriangleMesh coarse = simplifySoup(soup, 1000);
  EXPECT_LE(coarse.triangles.size(), 1000u);
  EXPECT_GT(coarse.triangles.size(), 0u);
  EXPECT_EQ(coarse.triangles, simplifySoup(soup, 1000).triangles);
}

TEST(SimplifySoup, GivesSomethingEvenForOneTriangle) {
  EXPECT_EQ(simplifySoup(makeSphere({0, 0, 0}, 1), 1).triangles.size(), 1u);
}

}  // namespace
}  // namespace exemplar
