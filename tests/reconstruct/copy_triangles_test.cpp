// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/copy_triangles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/origin.h"
#include "core/random.h"
#include "mesh/primitives.h"
#include "sdf/mesh_to_sdf.h"
#include "tests/reconstruct/fields.h"
#include "tests/sdf/cancellation.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

double surfaceArea(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += length(areaNormal(mesh, t)) / 2;
  return sum;
}

/// The corner positions of every triangle in multiples of 1e-7, sorted: equal for equal surfaces
/// but for rounding at the seventh place, which the examples' coordinates stay clear of.
std::vector<std::array<Vec3d, 3>> sortedTriangles(const TriangleMesh& mesh) {
  const auto less = [](const Vec3d& a, const Vec3d& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::vector<std::array<Vec3d, 3>> result;
  for (const auto& t : mesh.triangles) {
    std::array<Vec3d, 3> corners;
    for (int c = 0; c < 3; ++c) {
      for (int a = 0; a < 3; ++a) corners[c][a] = std::round(mesh.positions[t[c]][a] * 1e7 + 0.3);
    }
    // Turned so that the least corner comes first; the winding stays.
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), less),
                corners.end());
    result.push_back(corners);
  }
  std::sort(result.begin(), result.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
  });
  return result;
}

TEST(CopyTriangles, IdentityOriginsGiveTheExampleBack) {
  // A box with sides on cell borders, a ball, and a torus: large, small and many triangles.
  for (const TriangleMesh& example : {makeBox({{-1, -1, -1}, {1, 1, 1}}), makeSphere({}, 1, 9),
                                      makeTorus({}, {1, 2, 3}, 1, 0.4, 40, 20)}) {
    for (const int padding : {0, 2}) {
      const DistanceField field = meshToSdf(example, {.resolution = 24, .padding = padding});
      const CopiedTriangles copied =
          copyTriangles(field, identityOrigins(field.size()), example, field);
      EXPECT_EQ(copied.motions, 1);
      EXPECT_EQ(copied.cutTriangles, 0);
      const auto expected = sortedTriangles(example), found = sortedTriangles(copied.mesh);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t t = 0; t < found.size(); ++t) {
        ASSERT_EQ(found[t], expected[t]);
      }
      EXPECT_TRUE(copied.health.closed() && copied.health.manifold() && copied.health.oriented());
    }
  }
}

TEST(CopyTriangles, CarriesColorsCoordinatesAndMaterials) {
  TriangleMesh example = makeSphere({}, 1, 9);
  example.materials.resize(2);
  for (std::size_t t = 0; t < example.triangles.size(); ++t) {
    std::array<Vec2f, 3> uvs;
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = example.positions[example.triangles[t][c]];
      uvs[c] = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
    example.uvs.push_back(uvs);
    example.triangleMaterials.push_back(areaNormal(example, t).z > 0);
  }
  for (const Vec3d& p : example.positions) {
    example.colors.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 0, 1});
  }
  const DistanceField field = meshToSdf(example, {.resolution = 20, .padding = 2});
  // Two halves, the right one lifted by one cell: triangles are cut between them.
  Origins origins = identityOrigins(field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    if (c.x >= field.size().x / 2)
      origins.values()[n] = Origin(origins.clamped(c - Vec3i{0, 0, 1}));
  }
  const CopiedTriangles copied =
      copyTriangles(field, origins, example, field, {.weld = 0, .relax = 0});
  validate(copied.mesh, "copied");
  EXPECT_GT(copied.cutTriangles, 10);
  EXPECT_EQ(copied.motions, 2);
  for (std::size_t t = 0; t < copied.mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = copied.mesh.triangles[t][c];
      const Vec3d& p = copied.mesh.positions[v];
      // Interpolated linearly over the example's triangles, so equal to the place itself.
      ASSERT_NEAR(copied.mesh.uvs[t][c].x, p.x, 1e-5);
      ASSERT_NEAR(copied.mesh.uvs[t][c].y, p.y, 1e-5);
      ASSERT_NEAR(copied.mesh.colors[v][0], p.x, 1e-5);
    }
    const bool up = areaNormal(copied.mesh, t).z > 0;
    ASSERT_EQ(copied.mesh.triangleMaterials[t], up);
  }
}

TEST(CopyTriangles, CutsLoseNoSurface) {
  // Random blocks, each in its own place: motions differ only by a shift that is taken back.
  const TriangleMesh example = makeTorus({}, {1, 2, 3}, 1, 0.4, 24, 12);
  const DistanceField field = meshToSdf(example, {.resolution = 30, .padding = 2});
  const Vec3i n = field.size();
  DistanceField twice = field;
  twice.values = Array3D<float>({2 * n.x, n.y, n.z});
  // Each block comes out either left or right.
  Origins origins(twice.size(), Origin(Vec3i{0, 0, 0}));
  const Random random(5);
  for (std::size_t m = 0; m < field.values.count(); ++m) {
    const Vec3i c = field.values.ijk(m);
    const Vec3i block{c.x / 5, c.y / 5, c.z / 5};
    const bool right = random.below(2, (block.z * 100 + block.y) * 100 + block.x);
    origins[c + Vec3i{right ? n.x : 0, 0, 0}] = Origin(c);
  }
  const CopiedTriangles copied =
      copyTriangles(twice, origins, example, field, {.weld = 0, .relax = 0});
  EXPECT_GT(copied.cutTriangles, 50);
  EXPECT_NEAR(surfaceArea(copied.mesh), surfaceArea(example), 1e-9 * surfaceArea(example));
}

TEST(CopyTriangles, PartsThatFitCloseAgain) {
  // A capsule along x, its right half taken from further left: the surface is the same there.
  const TriangleMesh example = makeCapsule({-2, 0, 0}, {2, 0, 0}, 0.5, 24);
  const DistanceField field = meshToSdf(example, {.resolution = 50, .padding = 2});
  Origins origins = identityOrigins(field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    if (c.x >= 20 && c.x < 34) origins.values()[n] = Origin(c - Vec3i{5, 0, 0});
  }
  const CopiedTriangles copied = copyTriangles(field, origins, example, field);
  EXPECT_EQ(copied.motions, 2);
  EXPECT_EQ(copied.health.components, 1);
  EXPECT_TRUE(copied.health.closed() && copied.health.manifold() && copied.health.oriented());
  EXPECT_NEAR(copied.health.signedVolume, meshHealth(example).signedVolume,
              0.01 * copied.health.signedVolume);
}

TEST(CopyTriangles, PartsThatDoNotFitStayOpenAndTheHealthSaysSo) {
  const TriangleMesh example = makeSphere({}, 1, 9);
  const DistanceField field = meshToSdf(example, {.resolution = 24, .padding = 4});
  Origins origins = identityOrigins(field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    if (c.x >= field.size().x / 2)
      origins.values()[n] = Origin(origins.clamped(c - Vec3i{0, 0, 4}));
  }
  const CopiedTriangles copied = copyTriangles(field, origins, example, field);
  EXPECT_GT(copied.health.boundaryEdges, 0);
  EXPECT_EQ(copied.health.boundaryEdges, meshHealth(copied.mesh).boundaryEdges);
}

TEST(CopyTriangles, QuarterTurnsTurnTriangles) {
  const TriangleMesh example = makeBox({{-1, -0.5, -0.4}, {1, 0.7, 0.6}});
  const DistanceField field = meshToSdf(example, {.resolution = 20, .padding = 2});
  const Vec3i n = field.size();
  DistanceField turnedField = field;
  turnedField.values = Array3D<float>({n.y, n.x, n.z});
  turnedField.origin = {0, 0, 0};
  Origins origins(turnedField.size());
  for (std::size_t m = 0; m < field.values.count(); ++m) {
    const Vec3i c = field.values.ijk(m);
    origins[turned(c, 1) + Vec3i{n.y - 1, 0, 0}] = Origin(c, 0, 1);
  }
  const CopiedTriangles copied = copyTriangles(turnedField, origins, example, field);
  EXPECT_EQ(copied.mesh.triangles.size(), 12u);
  EXPECT_TRUE(copied.health.closed() && copied.health.oriented());
  EXPECT_NEAR(copied.health.signedVolume, 2 * 1.2 * 1, 1e-9);
  const Vec3d size = boundingBox(copied.mesh).size();
  EXPECT_NEAR(size.x, 1.2, 1e-9);
  EXPECT_NEAR(size.y, 2, 1e-9);
}

TEST(CopyTriangles, WhatLiesOutsideTheExamplesBoxIsNotCopied) {
  const TriangleMesh example = makeBox({{-5, -1, -1}, {5, 1, 1}});
  const DistanceField field =
      meshToSdf(example, {.voxelSize = 0.2, .box = Box3d{{-2, -2, -2}, {2, 2, 2}}});
  const CopiedTriangles copied =
      copyTriangles(field, identityOrigins(field.size()), example, field);
  const Box3d box = boundingBox(copied.mesh);
  EXPECT_NEAR(box.min.x, -2, 1e-5);
  EXPECT_NEAR(box.max.x, 2, 1e-5);
  EXPECT_NEAR(surfaceArea(copied.mesh), 4 * 4 * 2, 1e-4);
}

TEST(CopyTriangles, IsTheSameAtAnyNumberOfThreads) {
  const TriangleMesh example = makeTorus({}, {1, 2, 3}, 1, 0.4, 40, 20);
  const DistanceField field = meshToSdf(example, {.resolution = 32, .padding = 4});
  Origins origins = identityOrigins(field.size());
  const Random random(5);
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    const std::uint64_t block = (c.z / 8 * 100 + c.y / 8) * 100 + c.x / 8;
    origins.values()[n] =
        Origin(origins.clamped(c + Vec3i{static_cast<int>(random.below(3, block)) - 1,
                                         static_cast<int>(random.below(3, block, 1)) - 1, 0}));
  }
  CopiedTriangles one, eight;
  tbb::task_arena(1).execute([&] { one = copyTriangles(field, origins, example, field); });
  tbb::task_arena(8).execute([&] { eight = copyTriangles(field, origins, example, field); });
  EXPECT_EQ(one.mesh.positions, eight.mesh.positions);
  EXPECT_EQ(one.mesh.triangles, eight.mesh.triangles);
  // Where three parts overlap their rims meet in edges of more than two triangles.
  EXPECT_TRUE(one.health.manifold());
}

TEST(CopyTriangles, BadInputIsRefused) {
  const TriangleMesh example = makeSphere({}, 1, 4);
  const DistanceField field = meshToSdf(example, {.resolution = 12, .padding = 2});
  const Origins origins = identityOrigins(field.size());
  EXPECT_THAT([&] { copyTriangles(field, origins, example, field, {.weld = 2}); },
              ThrowsMessage<InputError>(HasSubstr("`weld` is 2")));
  EXPECT_THAT(
      [&] {
        copyTriangles(field, Origins({2, 2, 2}), example, field);
      },
      ThrowsMessage<InputError>(HasSubstr("origins")));
  EXPECT_THAT(
      [&] {
        copyTriangles(field, Origins(field.size(), Origin(Vec3i{0, 0, 0})), example, field);
      },
      ThrowsMessage<InputError>(HasSubstr("no triangle was copied")));
}

TEST(CopyTriangles, ReportsItsProgressAndStopsWhereItIsCancelled) {
  const TriangleMesh example = makeSphere({}, 1, 20);
  const DistanceField field = meshToSdf(example, {.resolution = 32, .padding = 2});
  const Origins origins = identityOrigins(field.size());
  expectReportsAndStops(
      [&](const Progress& progress) {
        copyTriangles(field, origins, example, field, {}, progress);
      },
      20);
}

}  // namespace
}  // namespace exemplar
