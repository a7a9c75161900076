// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/row_crossing.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "core/random.h"
#include "mesh/primitives.h"
#include "sdf/triangle_soup.h"

namespace exemplar {
namespace {

TriangleTree treeOf(const TriangleMesh& mesh, double scale = 1) {
  return TriangleTree(cornersOf(makeSoup(mesh, {}, scale)));
}

/// Overlapping balls and boxes, one of them inside out; corners, edges and faces at whole numbers.
TriangleMesh solids() {
  TriangleMesh mesh = makeBox({{1, 1, 1}, {9, 5, 6}});
  append(mesh, makeBox({{4, 2, 3}, {12, 8, 8}}));
  TriangleMesh hollow = makeBox({{2, 2, 2}, {4, 4, 4}});
  for (auto& t : hollow.triangles) std::swap(t[1], t[2]);
  append(mesh, hollow);
  append(mesh, makeSphere({7, 7, 7}, 3.3, 6));
  append(mesh, makeTorus({5, 5, 9}, {0, 0.6, 0.8}, 3, 1, 24, 12));
  return mesh;
}

TEST(RowCrossing, CountsTrianglesByTheWayTheyFace) {
  const Corners t{Vec3d{5, 0, 0}, Vec3d{6, 4, 0}, Vec3d{7, 0, 4}};
  EXPECT_EQ(crossesRow(t, 1, 1), 1);
  EXPECT_EQ(crossesRow({t[0], t[2], t[1]}, 1, 1), -1);
  EXPECT_EQ(crossesRow(t, 3, 3), 0);
  EXPECT_EQ(crossesRow(t, -1, 1), 0);
  // Seen edge on, it is crossed nowhere.
  EXPECT_EQ(crossesRow({Vec3d{0, 1, 1}, Vec3d{5, 1, 1}, Vec3d{0, 3, 3}}, 2, 2), 0);
}

TEST(RowCrossing, ALineThroughAnEdgeOrACornerCrossesAsManyAsOneBesideIt) {
  // A fan around (2, 2): lines through the middle, along its edges and beside.
  const Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Corners> fan;
    const int n = 4 + static_cast<int>(random.below(6, trial));
    std::vector<Vec3d> rim;
    for (int k = 0; k < n; ++k) {
      const double angle = 6.283185307179586 * (k + random.uniform(trial, k + 1) * 0.7) / n;
      rim.push_back({random.uniform(trial, 50 + k), std::round(20 * std::cos(angle)) / 4 + 2,
                     std::round(20 * std::sin(angle)) / 4 + 2});
    }
    for (int k = 0; k < n; ++k) fan.push_back({Vec3d{0.3, 2, 2}, rim[k], rim[(k + 1) % n]});
    int hits = 0;
    for (const Corners& t : fan) hits += crossesRow(t, 2, 2);
    // Triangles of a fan whose rim turns around the middle once.
    EXPECT_EQ(hits, 1) << trial;
    for (int k = 0; k < n; ++k) {
      const Vec3d p = (rim[k] + Vec3d{0.3, 2, 2}) * 0.5;  // exact: quarters
      hits = 0;
      for (const Corners& t : fan) hits += crossesRow(t, p.y, p.z);
      EXPECT_EQ(hits, 1) << trial << " " << k;
    }
  }
}

TEST(RowCrossing, AgreesWithTheWindingNumberOfClosedTriangles) {
  const TriangleMesh mesh = solids();
  ASSERT_TRUE(makeSoup(mesh, {}, 1).closed);
  const TriangleTree tree = treeOf(mesh);
  const Random random(8);
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    Vec3d p{random.uniform(-1, 14, trial, 0), random.uniform(-1, 10, trial, 1),
            random.uniform(-1, 14, trial, 2)};
    // Half of them in rows through corners, edges and faces.
    if (trial % 2 == 0) p = {p.x, std::round(p.y), std::round(p.z)};
    const double winding = tree.windingNumber(p);
    // On the surface either answer is right.
    if (tree.distance(p, 1) < 1e-9) continue;
    ASSERT_NEAR(winding, windingAlongRow(tree, p), 0.011) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(RowCrossing, MarksWhatIsInsideAtAnyNumberOfThreads) {
  const TriangleTree tree = treeOf(solids(), 0.7);
  const Vec3i low{-3, 2, -1};
  const auto at = [&](int threads) {
    Array3D<std::uint8_t> inside({22, 9, 21});
    tbb::task_arena arena(threads);
    arena.execute([&] { markInside(tree, low, inside); });
    return inside;
  };
  const Array3D<std::uint8_t> marks = at(1);
  EXPECT_EQ(marks, at(8));
  for (std::size_t s = 0; s < marks.count(); ++s) {
    const Vec3d p = cast<double>(low + marks.ijk(s));
    if (tree.distance(p, 1) < 1e-9) continue;
    ASSERT_EQ(marks.values()[s] != 0, std::abs(tree.windingNumber(p)) > 0.5);
  }
}

}  // namespace
}  // namespace exemplar
