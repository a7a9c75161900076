// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/decimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "mesh/primitives.h"
#include "reconstruct/field_to_mesh.h"
#include "tests/reconstruct/fields.h"
#include "tests/sdf/cancellation.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Decimate, KeepsASurfaceSoundAndNear) {
  const auto value = [](const Vec3d& p) { return torusDistance(p, 14, 6); };
  const DistanceField field = makeField({44, 44, 16}, 1, {-21.5, -21.5, -7.5}, value);
  TriangleMesh mesh = fieldToMesh(field);
  const std::size_t before = mesh.triangles.size();
  decimate(mesh, {.error = 0.2});
  expectSound(mesh);
  EXPECT_EQ(eulerCharacteristic(mesh), 0);
  EXPECT_LT(mesh.triangles.size(), before / 3);
  // Planes that bound the error are those of the fine mesh, itself within 0.05 voxels.
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d middle = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
    EXPECT_LT(std::abs(value(middle)), 0.5);
  }
  for (const Vec3d& p : mesh.positions) EXPECT_LT(std::abs(value(p)), 0.25);
}

TEST(Decimate, FlatFacesShrinkToAFewTrianglesAndTheBoxStaysWhole) {
  const DistanceField field =
      makeField({20, 20, 20}, 0.5, {0, 0, 0}, [](const Vec3d& p) { return p.z + 0.3 * p.x - 6.1; });
  TriangleMesh mesh = fieldToMesh(field);
  const double volume = meshHealth(mesh).signedVolume;
  const std::size_t before = mesh.triangles.size();
  decimate(mesh, {.error = 0.01, .box = field.box()});
  expectSound(mesh);
  EXPECT_LT(mesh.triangles.size(), before / 10);
  EXPECT_NEAR(meshHealth(mesh).signedVolume, volume, 0.01 * volume);
  const Box3d box = boundingBox(mesh), expected = field.box();
  EXPECT_NEAR(box.min.x, expected.min.x, 1e-12);
  EXPECT_NEAR(box.max.y, expected.max.y, 1e-12);
}

TEST(Decimate, AnErrorOfZeroKeepsCurvedSurface) {
  TriangleMesh mesh = makeSphere({}, 1, 8);
  const TriangleMesh before = mesh;
  decimate(mesh, {.error = 0});
  EXPECT_EQ(mesh.triangles.size(), before.triangles.size());
}

TEST(Decimate, StopsAtTheNumberAskedFor) {
  TriangleMesh mesh = makeSphere({}, 1, 16);
  decimate(mesh, {.error = 10, .triangles = 500});
  EXPECT_LE(mesh.triangles.size(), 500u);
  EXPECT_GE(mesh.triangles.size(), 490u);
  expectSound(mesh);
}

/// Necks between balls, where hardly a collapse turns no triangle far.
TEST(Decimate, FusedBallsBecomeFew) {
  std::vector<Vec3d> balls;
  const Random random(2);
  for (std::uint64_t b = 0; b < 150; ++b)
    balls.push_back(
        {44 * random.uniform(b, 0), 44 * random.uniform(b, 1), 44 * random.uniform(b, 2)});
  const DistanceField field = makeField({48, 48, 48}, 1, {-2, -2, -2}, [&](const Vec3d& p) {
    double nearest = 1e9;
    for (const Vec3d& ball : balls) nearest = std::min(nearest, length(p - ball) - 4);
    return nearest;
  });
  const TriangleMesh fine = fieldToMesh(field);
  for (const std::int64_t share : {4, 16, 40}) {
    SCOPED_TRACE(share);
    TriangleMesh mesh = fine;
    const auto wanted = static_cast<std::int64_t>(fine.triangles.size()) / share;
    decimate(mesh, {.error = 1e9, .triangles = wanted, .box = field.box()});
    EXPECT_LE(static_cast<double>(mesh.triangles.size()), 1.02 * static_cast<double>(wanted));
    EXPECT_EQ(eulerCharacteristic(mesh), eulerCharacteristic(fine));
    const MeshHealth health = meshHealth(mesh);
    EXPECT_TRUE(health.closed() && health.manifold() && health.oriented());
  }
}

TEST(Decimate, RefusesWhatItWouldSpoil) {
  TriangleMesh mesh = makeSphere({}, 1, 2);
  EXPECT_THAT([&] { decimate(mesh, {.error = -1}); },
              ThrowsMessage<InputError>(HasSubstr("`error` is -1")));
  EXPECT_THAT([&] { decimate(mesh, {.error = 1, .triangles = -1}); },
              ThrowsMessage<InputError>(HasSubstr("`triangles` is -1")));
  mesh.colors.assign(mesh.positions.size(), {1, 1, 1, 1});
  EXPECT_THAT([&] { decimate(mesh, {.error = 1}); },
              ThrowsMessage<InputError>(HasSubstr("would lose materials")));
  TriangleMesh fan;
  fan.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  fan.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_THAT([&] { decimate(fan, {.error = 1}); },
              ThrowsMessage<InputError>(HasSubstr("manifold, oriented mesh")));
}

TEST(Decimate, ReportsItsProgressAndStopsWhereItIsCancelled) {
  const TriangleMesh mesh = makeSphere({}, 1, 60);  // 72,000 triangles
  expectReportsAndStops(
      [&](const Progress& progress) {
        TriangleMesh simple = mesh;
        decimate(simple, {.error = 0.01}, progress);
      },
      8);
}

}  // namespace
}  // namespace exemplar
