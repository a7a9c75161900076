// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/solid_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "mesh/primitives.h"
#include "sdf/opening_caps.h"
#include "sdf/ray_parity.h"
#include "sdf/sample_distances.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

double area(const std::vector<Corners>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += length(cross(b - a, c - a)) / 2;
  return sum;
}

template <class Test>
bool inside(const Test& test, const Vec3d& p) {
  std::uint8_t in = 0;
  test.inside({&p, 1}, {&in, 1});
  return in != 0;
}

std::shared_ptr<const TriangleTree> treeOf(const TriangleSoup& soup) {
  return std::make_shared<const TriangleTree>(cornersOf(soup));
}

SolidTest solidOf(const TriangleSoup& soup) { return SolidTest(soup, treeOf(soup)); }

std::vector<Corners> surfaceOf(const TriangleMesh& mesh, double reach = 1e9) {
  const TriangleSoup soup = makeSoup(mesh, {}, 1);
  return boundingTriangles(soup, *treeOf(soup), solidOf(soup), {20, 20, 20}, reach).triangles;
}

TEST(BoundingTriangles, OfASimpleSolidAreItsOwn) {
  const TriangleMesh box = makeBox({{2, 2, 2}, {12, 12, 12}});
  EXPECT_EQ(surfaceOf(box).size(), 12u);
}

TEST(BoundingTriangles, LeaveOutWhatIsBuried) {
  TriangleMesh mesh = makeBox({{2, 2, 2}, {12, 12, 12}});
  append(mesh, makeSphere({7, 7, 7}, 3, 6));
  EXPECT_EQ(surfaceOf(mesh).size(), 12u);
  // Turned inside out, the sphere is the wall of a hollow.
  TriangleMesh hollow = makeSphere({7, 7, 7}, 3, 6);
  for (auto& t : hollow.triangles) std::swap(t[0], t[1]);
  append(hollow, makeBox({{2, 2, 2}, {12, 12, 12}}));
  EXPECT_EQ(surfaceOf(hollow).size(), 12u + 720u);
}

TEST(BoundingTriangles, OfCrossingSolidsHaveTheAreaOfTheUnion) {
  TriangleMesh mesh = makeBox({{2, 2, 2}, {12, 12, 12}});
  append(mesh, makeBox({{7, 7, 7}, {17, 17, 17}}));
  // Each box loses a corner of three squares of 25. Pieces of 0.4 along the crossing's 60 voxels of
  // length.
  EXPECT_NEAR(area(surfaceOf(mesh)), 2 * (600 - 75), 0.4 * 60);
}

TEST(BoundingTriangles, OfStackedBoxesHaveNoWallBetween) {
  TriangleMesh mesh = makeBox({{2, 2, 2}, {12, 12, 12}});
  append(mesh, makeBox({{4, 4, 12}, {10, 10, 17}}));
  EXPECT_NEAR(area(surfaceOf(mesh)), 600 + 4 * 30, 0.4 * 24);
}

TEST(BoundingTriangles, StopAtTheReach) {
  TriangleMesh mesh = makeBox({{2, 2, 2}, {12, 12, 12}});
  append(mesh, makeBox({{100, 100, 100}, {110, 110, 110}}));
  EXPECT_EQ(surfaceOf(mesh).size(), 24u);
  EXPECT_EQ(surfaceOf(mesh, 10).size(), 12u);
}

TEST(BoundingTriangles, AreTheSameAtAnyNumberOfThreads) {
  TriangleMesh mesh = makeSphere({8, 8, 8}, 6, 12);
  append(mesh, makeSphere({12, 9, 8}, 5, 12));
  const auto run = [&] { return surfaceOf(mesh); };
  EXPECT_EQ(test::withThreads(1, run), test::withThreads(8, run));
}

// A box without the side on which an axis is at its end.
TriangleMesh without(const Box3d& box, int axis, double end) {
  TriangleMesh mesh = makeBox(box);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    for (const std::uint32_t v : t)
      if (mesh.positions[v][axis] != end) return false;
    return true;
  });
  return mesh;
}

TEST(SolidTest, OpenComponentsNeitherTakeFromOthersNorAddToThem) {
  // A slab without its bottom that contains a box without its bottom.
  TriangleMesh mesh = without({{0, 0, 0}, {40, 40, 2}}, 2, 0);
  append(mesh, without({{15, 15, 1}, {25, 25, 12}}, 2, 1));
  const TriangleSoup soup = makeSoup(mesh, {}, 1);
  const TriangleTree sum(cornersOf(soup));
  const Vec3d beside{14.5, 20, 1.5}, below{20, 20, -1};
  EXPECT_LT(sum.windingNumber(beside), 0.45);
  EXPECT_GT(sum.windingNumber(below), 0.55);
  const SolidTest solid = solidOf(soup);
  EXPECT_TRUE(inside(solid, beside));
  EXPECT_FALSE(inside(solid, below));
  EXPECT_TRUE(inside(solid, {20, 20, 6}));
  EXPECT_TRUE(inside(solid, {3, 3, 1}));
  EXPECT_FALSE(inside(solid, {14, 20, 3}));
}

TEST(SolidTest, OpenComponentsMayBeInsideOut) {
  TriangleMesh mesh = without({{0, 0, 0}, {10, 10, 10}}, 2, 0);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const SolidTest solid = solidOf(makeSoup(mesh, {}, 1));
  EXPECT_TRUE(inside(solid, {5, 5, 5}));
  EXPECT_FALSE(inside(solid, {5, 5, 11}));
  EXPECT_FALSE(inside(solid, {5, 5, -1}));
}

TEST(SolidTest, PartsWithRimsSideBySideCountTogether) {
  // A tube and its two ends, a tenth of a voxel apart. Alone, the tube's ends bulge inwards.
  TriangleMesh tube = makeCylinder({10, 10, 2}, {10, 10, 12}, 5, 48), ends = tube;
  const auto isEnd = [&](const auto& t) {
    return tube.positions[t[0]].z == tube.positions[t[1]].z &&
           tube.positions[t[0]].z == tube.positions[t[2]].z;
  };
  std::erase_if(ends.triangles, [&](const auto& t) { return !isEnd(t); });
  std::erase_if(tube.triangles, isEnd);
  for (Vec3d& p : ends.positions) p.z += p.z > 7 ? 0.1 : -0.1;
  EXPECT_FALSE(inside(solidOf(makeSoup(tube, {}, 1)), {10, 10, 2.3}));
  append(tube, ends);
  const SolidTest solid = solidOf(makeSoup(tube, {}, 1));
  EXPECT_TRUE(inside(solid, {10, 10, 2.3}));
  EXPECT_TRUE(inside(solid, {10, 10, 11.7}));
  EXPECT_FALSE(inside(solid, {10, 10, 1.5}));
}

TEST(SolidTest, PartsThatWereNeverJoinedEncloseTogether) {
  // The six faces of a box, slightly apart: each is flat and encloses nothing alone.
  TriangleMesh mesh;
  const TriangleMesh box = makeBox({{2, 2, 2}, {12, 12, 12}});
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    TriangleMesh face;
    for (const std::uint32_t v : box.triangles[t]) face.positions.push_back(box.positions[v]);
    face.triangles = {{0, 1, 2}};
    const Vec3d middle = (face.positions[0] + face.positions[1] + face.positions[2]) / 3.0;
    for (Vec3d& p : face.positions) p = middle + (p - middle) * 0.99;
    append(mesh, face);
  }
  const SolidTest solid = solidOf(makeSoup(mesh, {}, 1));
  EXPECT_TRUE(inside(solid, {7, 7, 7}));
  EXPECT_TRUE(inside(solid, {3, 3, 3}));
  EXPECT_FALSE(inside(solid, {1, 7, 7}));
}

TEST(ParityTest, AgreesWithTheWindingNumberOnClosedMeshes) {
  const TriangleSoup soup = makeSoup(makeTorus({10, 10, 10}, {1, 2, 3}, 6, 2), {}, 1);
  const SolidTest solid = solidOf(soup);
  const ParityTest parity(soup);
  const Random random(6);
  int in = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3d p{random.uniform(0, 20, trial, 0), random.uniform(0, 20, trial, 1),
                  random.uniform(0, 20, trial, 2)};
    ASSERT_EQ(inside(parity, p), inside(solid, p));
    in += inside(solid, p);
  }
  EXPECT_GT(in, 100);
}

TEST(ParityTest, CountsAnOverlapAsOutside) {
  TriangleMesh mesh = makeBox({{2, 2, 2}, {12, 12, 12}});
  append(mesh, makeBox({{7, 7, 7}, {17, 17, 17}}));
  const ParityTest parity(makeSoup(mesh, {}, 1));
  EXPECT_TRUE(inside(parity, {4.1, 4.2, 4.3}));
  EXPECT_TRUE(inside(parity, {14.1, 14.2, 14.3}));
  EXPECT_FALSE(inside(parity, {9.1, 9.2, 9.3}));
  EXPECT_FALSE(inside(parity, {1.1, 1.2, 1.3}));
}

TEST(OpeningCaps, CloseTheOpeningOfACylinder) {
  // Without its ends, and three times as long as wide: the ends are nearly flat.
  TriangleMesh tube = makeCylinder({10, 10, 2}, {10, 10, 32}, 5, 48);
  std::erase_if(tube.triangles, [&](const auto& t) {
    const double z = tube.positions[t[0]].z;
    return tube.positions[t[1]].z == z && tube.positions[t[2]].z == z;
  });
  const TriangleSoup soup = makeSoup(tube, {}, 1);
  ASSERT_FALSE(soup.closed);
  const SolidTest solid = solidOf(soup);
  const Vec3i size{21, 21, 36};
  Array3D<std::uint8_t> in(size);
  for (std::size_t s = 0; s < in.count(); ++s)
    in.values()[s] = inside(solid, cast<double>(in.ijk(s)));
  Array3D<float> distances(size);
  const auto bounding = boundingTriangles(soup, *treeOf(soup), solid, size, 9).triangles;
  sampleDistances(TriangleTree(bounding), 2, {}, distances);
  const auto caps = openingCaps(solid, {}, in, distances);
  // Two discs, which bulge inwards and end somewhere within the rim's cells.
  EXPECT_NEAR(area(caps), 2 * 3.14159 * 25, 40);
  for (const Corners& t : caps)
    for (const Vec3d& p : t) {
      EXPECT_LT(std::hypot(p.x - 10, p.y - 10), 6.5);
      EXPECT_LT(std::min(std::abs(p.z - 2), std::abs(p.z - 32)), 3.5);
    }
  // Nothing is missing between caps and wall: the union is nowhere farther than a voxel from where
  // the sign changes.
  auto all = bounding;
  all.insert(all.end(), caps.begin(), caps.end());
  const TriangleTree surface(all);
  for (std::size_t s = 0; s < in.count(); ++s)
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3i a = in.ijk(s);
      Vec3i b = a;
      if (++b[axis] >= size[axis] || in[a] == in[b]) continue;
      EXPECT_LT(surface.distance((cast<double>(a) + cast<double>(b)) * 0.5, 9), 1);
    }
}

TEST(SampleDistances, AreThoseOfTheSamplesUpToTheLimit) {
  const TriangleMesh sphere = makeSphere({3, 4, 5}, 4, 5);
  std::vector<Corners> corners;
  for (const auto& [a, b, c] : sphere.triangles)
    corners.push_back({sphere.positions[a], sphere.positions[b], sphere.positions[c]});
  const TriangleTree tree(corners);
  const Vec3i low{-7, -3, 1};
  for (const double limit : {0.5, 3.0, std::numeric_limits<double>::infinity()}) {
    Array3D<float> distances({33, 21, 19});
    sampleDistances(tree, limit, low, distances);
    for (std::size_t s = 0; s < distances.count(); ++s) {
      const Vec3d p = cast<double>(low + distances.ijk(s));
      ASSERT_EQ(distances.values()[s], static_cast<float>(tree.distance(p, limit)));
    }
  }
}

TEST(ForBlocks, CoversEachSampleOnceAndSerpentinesStepByStep) {
  for (const int side : {1, 4, 8}) {
    Array3D<int> seen({13, 9, 17});
    forBlocks(seen.size(), side, {}, "", [&](const Vec3i& low, const Vec3i& high) {
      Vec3i before = low - Vec3i{1, 0, 0};
      serpentine(low, high, [&](const Vec3i& ijk) {
        const Vec3i step = ijk - before;
        EXPECT_EQ(std::abs(step.x) + std::abs(step.y) + std::abs(step.z), 1);
        before = ijk;
        ++seen[ijk];
      });
    });
    for (const int n : seen.values()) ASSERT_EQ(n, 1);
  }
}

}  // namespace
}  // namespace exemplar
