// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/mesh_to_sdf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/primitives.h"

namespace exemplar {
namespace {

TEST(MeshToSdf, IsWithinHalfAVoxelOfTheAnalyticDistanceOnASphere) {
  const TriangleMesh sphere = makeSphere({0.1, 0.2, 0.3}, 1, 32);
  const DistanceField field = meshToSdf(sphere, {.resolution = 40, .padding = 4});
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const double exact =
        length(field.position(cast<double>(field.values.ijk(s))) - Vec3d{0.1, 0.2, 0.3}) - 1;
    const double clamped = std::clamp<double>(exact, -field.truncation, field.truncation);
    ASSERT_NEAR(field.values.values()[s], clamped, 0.5 * field.voxelSize);
  }
}

}  // namespace
}  // namespace exemplar
