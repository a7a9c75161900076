// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/mesh_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "measure/likeness.h"
#include "mesh/primitives.h"
#include "reconstruct/field_to_mesh.h"
#include "sdf/mesh_to_sdf.h"
#include "tests/measure/fields.h"

namespace exemplar {
namespace {

using testing::ballPacking;
using testing::balls;
using ::testing::HasSubstr;

/// `field` with voxels of `h` whose first sample is at `origin`.
DistanceField placed(DistanceField field, double h, const Vec3d& origin) {
  for (float& v : field.values.values()) v *= static_cast<float>(h);
  field.truncation = static_cast<float>(8 * h);
  for (float& v : field.values.values()) v = std::clamp(v, -field.truncation, field.truncation);
  field.voxelSize = h;
  field.origin = origin;
  return field;
}

constexpr double kVoxel = 0.03;
const Vec3d kOrigin{-1.234, 0.777, 12.05};

TEST(MeshResult, StandsWhereTheFieldStoodThatItWasContouredFrom) {
  // Balls that lean over all faces: the mesh is cut, and as large as the box.
  const DistanceField example = placed(ballPacking({40, 40, 40}, 1), kVoxel, kOrigin);
  const DistanceField result = placed(ballPacking({80, 60, 40}, 2), kVoxel, kOrigin);
  const TriangleMesh mesh = fieldToMesh(result);
  const DistanceField again = sampleMeshResult(mesh, example);
  ASSERT_EQ(again.size(), result.size());
  EXPECT_NEAR(length(again.origin - result.origin), 0, 1e-9);
  // Contouring misplaces the surface by a tenth of a voxel on smooth balls, by more where two touch
  // (which is a small part of the samples) and where it drops a sliver of fewer than 8 voxels that
  // a ball pushes through a face.
  std::size_t flipped = 0, off = 0, near = 0;
  for (std::size_t s = 0; s < result.values.count(); ++s) {
    const double before = result.values.values()[s] / kVoxel,
                 after = again.values.values()[s] / kVoxel;
    flipped += (before < 0) != (after < 0);
    if (std::abs(before) > 3) continue;
    ++near;
    off += std::abs(before - after) > 0.2;
  }
  EXPECT_LT(flipped, 0.004 * result.values.count());
  EXPECT_LT(off, 0.05 * near);
}

TEST(MeshResult, ScoresAsTheFieldDoes) {
  const DistanceField example = placed(ballPacking({60, 60, 40}, 1), kVoxel, kOrigin);
  // The example itself, moved: alike up to its new rims.
  const DistanceField result = placed(
      testing::makeField({60, 60, 40},
                         [&](const Vec3d& p) {
                           const Vec3i q = cast<int>(p) + Vec3i{7, 0, 0};
                           return example.values.contains(q) ? example.values[q] / kVoxel : 8.0;
                         }),
      kVoxel, kOrigin);
  const TriangleMesh mesh = fieldToMesh(result);
  LikenessOptions contoured;
  contoured.contoured = true;
  const Likeness field = measureLikeness(example, result);
  const Likeness again =
      measureLikeness(example, sampleMeshResult(mesh, example, {.size = result.size()}), contoured);
  EXPECT_GT(field.dense.share, 0.8);
  EXPECT_NEAR(again.dense.share, field.dense.share, 0.02);
  EXPECT_NEAR(again.coverage.share, field.coverage.share, 0.02);
  EXPECT_NEAR(again.dense.meanIou, field.dense.meanIou, 0.02);
  EXPECT_NEAR(*again.occupancyRatio, *field.occupancyRatio, 0.02);
  EXPECT_NEAR(*again.surfaceRatio, *field.surfaceRatio, 0.02);
  // Samples that begin at the mesh's own corner, as if it were an example, mean nothing: what the
  // alignment is for.
  TriangleMesh aside = mesh;
  for (Vec3d& p : aside.positions) p += Vec3d{0.5, 0.5, 0.5} * kVoxel;
  const Likeness other = measureLikeness(
      example,
      meshToSdf(aside, {.voxelSize = kVoxel,
                        .box = Box3d{example.box().min, example.box().min + result.box().size()}}));
  EXPECT_LT(other.dense.share, field.dense.share - 0.4);
}

TEST(MeshResult, IsAsLargeAsTheExamplesBorderSays) {
  // Two voxels of air below the ball and five above it.
  const DistanceField example = placed(balls({40, 40, 21}, 7, {{20, 20, 8.5}}), kVoxel, kOrigin);
  const auto sampled = [&](const std::vector<Vec3d>& centers, const MeshResultOptions& o = {}) {
    const DistanceField large = placed(balls({100, 100, 100}, 7, centers), kVoxel, kOrigin);
    return sampleMeshResult(fieldToMesh(large), example, o).size();
  };
  EXPECT_EQ(sampled({{20, 20, 8.5}}), example.size());
  EXPECT_EQ(sampled({{12, 12, 8.5}}), example.size());
  EXPECT_EQ(sampled({{12, 12, 8.5}, {60, 20, 29.5}}), (Vec3i{80, 40, 42}));
  EXPECT_EQ(sampled({{12, 12, 8.5}}, {.size = Vec3i{30, 35, 17}}), (Vec3i{30, 35, 17}));
}

TEST(MeshResult, ThatIsPlacedElsewhereIsSampledOnTheSameGrid) {
  const DistanceField example = placed(balls({40, 40, 40}, 7, {{20, 20, 20}}), kVoxel, kOrigin);
  const Vec3d center = kOrigin + Vec3d{-200.3, 5, 9} * kVoxel;
  const DistanceField field = sampleMeshResult(makeSphere(center, 7 * kVoxel, 30), example);
  const Vec3d step = (field.origin - example.origin) / kVoxel;
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(step[axis], std::round(step[axis]), 1e-6);
  EXPECT_EQ(field.size(), (Vec3i{15, 15, 15}));
  EXPECT_LT(field.values(7, 7, 7), -5 * kVoxel);
}

TEST(MeshResult, RefusesWhatCannotBe) {
  const DistanceField example = placed(balls({40, 40, 40}, 7, {{20, 20, 20}}), kVoxel, kOrigin);
  const TriangleMesh mesh = fieldToMesh(example);
  EXPECT_THROW(sampleMeshResult({}, example), InputError);
  EXPECT_THROW(sampleMeshResult(mesh, {}), InputError);
  EXPECT_THROW(sampleMeshResult(mesh, example, {.size = Vec3i{40, 0, 40}}), InputError);
  try {
    sampleMeshResult(mesh, example, {.size = Vec3i{40, 26, 40}});
    FAIL() << "a mesh of 27 voxels in a box of 26";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("40 x 26 x 40"));
  }
}

}  // namespace
}  // namespace exemplar
