// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/random.h"
#include "mesh/primitives.h"
#include "sdf/example_surface.h"
#include "sdf/mesh_to_sdf.h"
#include "tests/reconstruct/fields.h"
#include "tests/sdf/cancellation.h"

namespace exemplar {
namespace {

/// A colored example and a copy of it in jittered blocks: what a poor synthesis would return.
struct Blocks {
  TriangleMesh example = makeTorus({}, {1, 2, 3}, 1, 0.45, 60, 30);
  DistanceField exampleField, field;
  Origins origins;

  Blocks() {
    for (const Vec3d& p : example.positions) {
      example.colors.push_back({static_cast<float>(p.x * 0.3 + 0.5), 0.5f, 0.5f, 1});
    }
    example.materials.resize(2);
    for (std::size_t t = 0; t < example.triangles.size(); ++t) {
      example.triangleMaterials.push_back(example.positions[example.triangles[t][0]].z > 0);
    }
    exampleField = field = meshToSdf(example, {.resolution = 48, .padding = 3});
    origins = identityOrigins(field.size());
    const Random random(8);
    for (std::size_t n = 0; n < origins.count(); ++n) {
      const Vec3i c = origins.ijk(n);
      const std::uint64_t block = (c.z / 8 * 100 + c.y / 8) * 100 + c.x / 8;
      const Vec3i jitter{static_cast<int>(random.below(3, block, 0)) - 1,
                         static_cast<int>(random.below(3, block, 1)) - 1,
                         static_cast<int>(random.below(3, block, 2)) - 1};
      origins.values()[n] = Origin(origins.clamped(c + jitter));
      field.values[c] = exampleField.values[origins.values()[n].cell()];
    }
  }
};

TEST(ReconstructSurface, IsSoundAndCarriesEverything) {
  const Blocks blocks;
  const Reconstruction result =
      reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField, &blocks.example});
  expectSound(result.mesh);
  validate(result.mesh, "result");
  EXPECT_TRUE(result.health.closed() && result.health.manifold() && result.health.oriented());
  EXPECT_TRUE(result.mesh.hasColors() && result.mesh.hasMaterials());
  const double volume = meshHealth(blocks.example).signedVolume;
  EXPECT_NEAR(result.health.signedVolume, volume, 0.05 * volume);
}

TEST(ReconstructSurface, MergesTrianglesAndStaysSoundWithItsMaterials) {
  const Blocks blocks;
  const ReconstructExample example{blocks.exampleField, &blocks.example};
  const Reconstruction whole = reconstructSurface(blocks.field, blocks.origins, example);
  EXPECT_EQ(whole.contoured > 0, true);
  const double volume = whole.health.signedVolume;
  std::int64_t before = whole.contoured;
  for (const double error : {0.05, 0.2}) {
    const Reconstruction merged =
        reconstructSurface(blocks.field, blocks.origins, example, {.simplify = error});
    EXPECT_EQ(merged.contoured, whole.contoured);
    // Borders of materials cut triangles, so there are more than were left of the contour.
    EXPECT_LT(merged.health.triangles, before) << error;
    before = merged.health.triangles;
    EXPECT_TRUE(merged.health.closed() && merged.health.manifold() && merged.health.oriented());
    EXPECT_TRUE(merged.mesh.hasMaterials());
    EXPECT_NEAR(merged.health.signedVolume, volume, 0.02 * volume);
  }
  const Reconstruction few =
      reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField}, {.triangles = 2000});
  EXPECT_LE(few.health.triangles, 2000);
  EXPECT_GT(few.health.triangles, 1000);
  EXPECT_TRUE(few.health.closed());
}

TEST(ReconstructSurface, CoarserCopiesHaveAQuarterEachAndStayNear) {
  const Blocks blocks;
  const ReconstructExample example{blocks.exampleField, &blocks.example};
  // The example itself: what a poor synthesis returns has steps that no coarse surface follows.
  const Origins origins = identityOrigins(blocks.exampleField.size());
  const Reconstruction made =
      reconstructSurface(blocks.exampleField, origins, example, {.lods = 3});
  const Reconstruction whole = reconstructSurface(blocks.exampleField, origins, example);
  EXPECT_EQ(made.mesh.triangles, whole.mesh.triangles) << "the surface itself is as without";
  ASSERT_EQ(made.lods.size(), 3u);
  const ExampleSurface surface(made.mesh);
  auto before = static_cast<double>(made.mesh.triangles.size());
  for (const CoarserSurface& lod : made.lods) {
    const auto triangles = static_cast<double>(lod.mesh.triangles.size());
    EXPECT_LT(triangles, 0.3 * before);
    EXPECT_GT(triangles, 0.15 * before);
    before = triangles;
    EXPECT_TRUE(lod.health.closed() && lod.health.manifold() && lod.health.oriented());
    EXPECT_TRUE(lod.mesh.hasColors() && lod.mesh.hasMaterials());
    if (&lod != &made.lods.front()) continue;
    // At a quarter: points of the coarse surface are within half a voxel of the whole one.
    for (const auto& [a, b, c] : lod.mesh.triangles) {
      const auto& p = lod.mesh.positions;
      for (const Vec3d& point : {p[a], (p[a] + p[b]) / 2.0, (p[a] + p[b] + p[c]) / 3.0})
        EXPECT_LT(surface.closest(point)->distance, 0.5 * blocks.exampleField.voxelSize);
    }
  }
  ReconstructOptions periodic{.lods = 1};
  periodic.contour.wraps = Axes{true, false, false};
  EXPECT_THROW(reconstructSurface(blocks.exampleField, origins, example, periodic), InputError);
  EXPECT_THROW(reconstructSurface(blocks.exampleField, origins, example, {.lods = 9}), InputError);
}

TEST(ReconstructSurface, WithoutTrianglesThereIsNothingToCarry) {
  const Blocks blocks;
  const Reconstruction result =
      reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField});
  expectSound(result.mesh);
  EXPECT_FALSE(result.mesh.hasColors() || result.mesh.hasMaterials());
}

TEST(ReconstructSurface, IsTheSameAtAnyNumberOfThreads) {
  const Blocks blocks;
  Reconstruction one, eight;
  const auto run = [&] {
    ReconstructOptions options{.lods = 1};
    options.appearance.sources = true;
    return reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField, &blocks.example},
                              options);
  };
  tbb::task_arena(1).execute([&] { one = run(); });
  tbb::task_arena(8).execute([&] { eight = run(); });
  EXPECT_EQ(one.mesh.positions, eight.mesh.positions);
  EXPECT_EQ(one.mesh.triangles, eight.mesh.triangles);
  EXPECT_EQ(one.mesh.colors, eight.mesh.colors);
  EXPECT_EQ(one.mesh.triangleMaterials, eight.mesh.triangleMaterials);
  EXPECT_EQ(one.mesh.sources, eight.mesh.sources);
  EXPECT_EQ(one.lods.at(0).mesh.positions, eight.lods.at(0).mesh.positions);
  EXPECT_EQ(one.lods.at(0).mesh.triangles, eight.lods.at(0).mesh.triangles);
}

TEST(ReconstructSurface, RefusesOriginsOfAnotherSynthesis) {
  const Blocks blocks;
  EXPECT_THAT(
      [&] {
        reconstructSurface(blocks.field, Origins({2, 2, 2}),
                           {blocks.exampleField, &blocks.example});
      },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("not of the field's size")));
}

TEST(ReconstructSurface, ReportsItsProgressAndStopsWhereItIsCancelled) {
  const Blocks blocks;
  const auto plain = [&](const Progress& progress) {
    reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField}, {}, progress);
  };
  expectReportsAndStops(plain, 20);
  const auto dressed = [&](const Progress& progress) {
    reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField, &blocks.example}, {},
                       progress);
  };
  expectReportsAndStops(dressed, 40);
  const auto coarser = [&](const Progress& progress) {
    reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField, &blocks.example},
                       {.lods = 2}, progress);
  };
  expectReportsAndStops(coarser, 40);
}

}  // namespace
}  // namespace exemplar
