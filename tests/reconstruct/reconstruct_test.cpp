// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/reconstruct.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <map>

#include "core/error.h"
#include "core/random.h"
#include "mesh/primitives.h"
#include "sdf/mesh_to_sdf.h"
#include "tests/reconstruct/fields.h"

namespace exemplar {
namespace {

/// A coloured example and a copy of it in jittered blocks: what a poor synthesis would return.
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

TEST(ReconstructSurface, IsSoundAndCarriesEverythingWhateverTheSteps) {
  const Blocks blocks;
  for (const double blend : {0.0, 2.0}) {
    for (const int relax : {0, 10}) {
      for (const double simplify : {0.0, 0.1}) {
        ReconstructOptions options;
        options.blend = blend;
        options.relax = relax;
        options.simplify = simplify;
        const Reconstruction result = reconstructSurface(
            blocks.field, blocks.origins, {blocks.exampleField, &blocks.example}, options);
        expectSound(result.mesh);
        validate(result.mesh, "result");
        EXPECT_TRUE(result.health.closed() && result.health.manifold() && result.health.oriented());
        EXPECT_TRUE(result.mesh.hasColors() && result.mesh.hasMaterials());
        const double volume = meshHealth(blocks.example).signedVolume;
        EXPECT_NEAR(result.health.signedVolume, volume, 0.05 * volume);
      }
    }
  }
}

TEST(ReconstructSurface, BlendingAndRelaxingSmoothTheSeams) {
  const Blocks blocks;
  // The mean angle between neighbouring triangles; the torus itself has next to none.
  const auto meanTurn = [&](double blend, int relax) {
    ReconstructOptions options;
    options.blend = blend;
    options.relax = relax;
    const TriangleMesh mesh =
        reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField}, options).mesh;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> normalAt;
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3d n = normalized(areaNormal(mesh, t));
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t a = mesh.triangles[t][c], b = mesh.triangles[t][(c + 1) % 3];
        normalAt[{a, b}] = n;
        const auto other = normalAt.find({b, a});
        if (other != normalAt.end()) sum += std::acos(std::clamp(dot(n, other->second), -1.0, 1.0));
      }
    }
    return sum / (1.5 * static_cast<double>(mesh.triangles.size()));
  };
  const double plain = meanTurn(0, 0);
  // Blending moves the surface within two voxels of the seams only, and relaxing no more than half
  // a voxel, so part of the roughness of one-voxel jitter stays.
  EXPECT_LT(meanTurn(2, 0), 0.75 * plain);
  EXPECT_LT(meanTurn(0, 10), 0.95 * plain);
  EXPECT_LT(meanTurn(2, 10), meanTurn(2, 0));
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
  ReconstructOptions options;
  options.relax = 3;
  options.simplify = 0.05;
  Reconstruction one, eight;
  const auto run = [&] {
    return reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField, &blocks.example},
                              options);
  };
  tbb::task_arena(1).execute([&] { one = run(); });
  tbb::task_arena(8).execute([&] { eight = run(); });
  EXPECT_EQ(one.mesh.positions, eight.mesh.positions);
  EXPECT_EQ(one.mesh.triangles, eight.mesh.triangles);
  EXPECT_EQ(one.mesh.colors, eight.mesh.colors);
  EXPECT_EQ(one.mesh.triangleMaterials, eight.mesh.triangleMaterials);
}

TEST(ReconstructSurface, BadOptionsAreRefused) {
  const Blocks blocks;
  ReconstructOptions options;
  options.simplify = -1;
  EXPECT_THROW(reconstructSurface(blocks.field, blocks.origins, {blocks.exampleField}, options),
               InputError);
}

}  // namespace
}  // namespace exemplar
