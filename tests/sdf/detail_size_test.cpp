// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/detail_size.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "mesh/primitives.h"
#include "tests/sdf/cancellation.h"

namespace exemplar {
namespace {

/// Bricks with joints of some width, half as deep as they are, on a core.
TriangleMesh bricks(double joint) {
  TriangleMesh mesh = makeBox({{0, 0.1, 0}, {4, 0.4, 2}});
  for (int row = 0; row < 8; ++row)
    for (int n = 0; n < 8; ++n)
      append(mesh, makeBox({{0.5 * n + joint / 2, 0, 0.25 * row + joint / 2},
                            {0.5 * (n + 1) - joint / 2, 0.5, 0.25 * (row + 1) - joint / 2}}));
  return mesh;
}

TEST(DetailSize, IsTheThicknessOfAWallAndTheWidthOfItsJoints) {
  for (const double thickness : {0.02, 0.3}) {
    const DetailSize wall = detailSize(makeBox({{0, 0, 0}, {4, thickness, 2}}));
    EXPECT_NEAR(wall.thickness, thickness, 1e-5);
    EXPECT_TRUE(std::isinf(wall.gap));
  }
  for (const double joint : {0.02, 0.06}) {
    const DetailSize wall = detailSize(bricks(joint));
    EXPECT_NEAR(wall.gap, joint, 1e-5);
    // Through bricks and core, not to faces that are buried in them.
    EXPECT_GT(wall.thickness, 0.15);
  }
}

TEST(DetailSize, GoesWithTheMesh) {
  TriangleMesh large = bricks(0.06);
  for (Vec3d& p : large.positions) p = p * 1000 + Vec3d{5e5, 5e6, 0};
  EXPECT_NEAR(detailSize(large).gap, 60, 0.01);
}

TEST(DetailSize, OfWedgesAndOfRoundThingsThatTouchIsNone) {
  // Wedges and contacts are infinitely fine, at any resolution.
  TriangleMesh balls;
  for (int n = 0; n < 4; ++n) append(balls, makeSphere({2.0 * n, 0, 0}, 0.999, 16));
  EXPECT_GT(detailSize(balls).gap, 0.02);
  EXPECT_GT(detailSize(balls).thickness, 1.5);
  TriangleMesh wedge;
  wedge.positions = {{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 3, 0}, {4, 3, 0}, {4, 3, 2}};
  wedge.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                     {1, 2, 5}, {1, 5, 4}, {0, 5, 2}, {0, 3, 5}};
  EXPECT_GT(detailSize(wedge).thickness, 1);
}

TEST(DetailSize, OfSheetsAndOfNothingIsInfinite) {
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}};
  EXPECT_TRUE(std::isinf(detailSize(sheet).thickness));
  EXPECT_TRUE(std::isinf(detailSize(sheet).gap));
}

TEST(DetailSize, IsTheSameAtAnyNumberOfThreads) {
  const TriangleMesh mesh = bricks(0.04);
  const auto at = [&](int threads) {
    tbb::task_arena arena(threads);
    DetailSize size{};
    arena.execute([&] { size = detailSize(mesh); });
    return size;
  };
  const DetailSize one = at(1), eight = at(8);
  EXPECT_EQ(one.thickness, eight.thickness);
  EXPECT_EQ(one.gap, eight.gap);
}

TEST(DetailSize, StopsWhenCancelled) {
  std::atomic<bool> cancel = true;
  EXPECT_THROW(detailSize(bricks(0.04), Progress({}, &cancel)), Cancelled);
}

}  // namespace
}  // namespace exemplar
