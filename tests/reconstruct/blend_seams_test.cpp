// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/blend_seams.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/random.h"
#include "reconstruct/field_to_mesh.h"
#include "core/origin.h"
#include "tests/reconstruct/fields.h"

namespace exemplar {
namespace {

/// A slope whose height over the plane x, y rises by `slope` a voxel.
DistanceField slopeField(double slope) {
  return makeField({40, 24, 24}, 1, {0, 0, 0}, [&](const Vec3d& p) {
    return (p.z - 11.3 - slope * (p.x - 20)) / std::hypot(1, slope);
  });
}

/// `field` with everything right of x = 20 taken from `shift` cells further left, or from the
/// example's end.
struct Copied {
  DistanceField field;
  Origins origins;

  Copied(const DistanceField& example, int shift)
      : field(example), origins(identityOrigins(example.size())) {
    for (std::size_t n = 0; n < origins.count(); ++n) {
      const Vec3i c = origins.ijk(n);
      if (c.x < 20) continue;
      const Vec3i source = example.values.clamped(c - Vec3i{shift, 0, 0});
      origins.values()[n] = Origin(source);
      field.values[c] = example.values[source];
    }
  }
};

/// The largest difference between neighbours along x, voxels, near the surface.
double largestStep(const DistanceField& field) {
  double worst = 0;
  for (int k = 0; k < field.size().z; ++k) {
    for (int j = 0; j < field.size().y; ++j) {
      for (int i = 0; i + 1 < field.size().x; ++i) {
        const float a = field.values(i, j, k), b = field.values(i + 1, j, k);
        if (std::abs(a) < 1.5 && std::abs(b) < 1.5)
          worst = std::max(worst, double{std::abs(a - b)});
      }
    }
  }
  return worst;
}

TEST(BlendSeams, LeavesAFieldWithoutSeamsAsItIs) {
  const DistanceField example = slopeField(0.3);
  EXPECT_EQ(blendSeams(example, identityOrigins(example.size()), example).values, example.values);
}

TEST(BlendSeams, TurnsAStepIntoASlope) {
  // 5 cells on a slope of 0.2: a step down of one voxel in height where the slope goes up by 0.2.
  const DistanceField example = slopeField(0.2);
  const Copied copied(example, 5);
  const DistanceField blended = blendSeams(copied.field, copied.origins, example, {.width = 3});
  // The example's own slope is 0.2. Over 7 voxels a smooth ramp of 1 adds at most about 2 / 7.
  EXPECT_GT(largestStep(copied.field), 0.75);
  EXPECT_LT(largestStep(blended), 0.2 + 0.3);
  // Nothing but the seam's surroundings changed.
  for (std::size_t n = 0; n < blended.values.count(); ++n) {
    const Vec3i c = blended.values.ijk(n);
    if (std::abs(c.x - 19.5) > 4) {
      ASSERT_EQ(blended.values[c], copied.field.values[c]);
    }
  }
}

TEST(BlendSeams, PartsThatAgreeStayAsTheyAre) {
  // A rod along x is the same everywhere, so its copies agree.
  const DistanceField example = makeField({40, 24, 24}, 1, {0, 0, 0}, [](const Vec3d& p) {
    return std::hypot(p.y - 11.2, p.z - 12.4) - 6;
  });
  const Copied copied(example, 7);
  const DistanceField blended = blendSeams(copied.field, copied.origins, example);
  for (std::size_t n = 0; n < blended.values.count(); ++n) {
    ASSERT_NEAR(blended.values.values()[n], copied.field.values.values()[n], 1e-6);
  }
}

TEST(BlendSeams, FollowsQuarterTurns) {
  // The right half is the example turned by a quarter: its cells (x, y) come from (y, n - 1 - x).
  const DistanceField example = makeField(
      {24, 24, 16}, 1, {0, 0, 0}, [](const Vec3d& p) { return p.z - 7.4 - 0.15 * (p.x - p.y); });
  DistanceField field = example;
  Origins origins = identityOrigins(example.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    const Vec3i c = origins.ijk(n);
    if (c.x < 12) continue;
    const Vec3i from{c.y, 23 - c.x, c.z};
    origins.values()[n] = Origin(from, 0, 1);
    field.values[c] = example.values[from];
  }
  // At x = 12 the turned part says p.z - 7.4 - 0.15 (y - 23 + x): a step, which the blend divides
  // where steps of any size count as the same surface.
  const DistanceField blended = blendSeams(field, origins, example, {.agreement = 1e6});
  for (int j = 4; j < 20; ++j) {
    const double left = 7 - 7.4 - 0.15 * (11 - j), right = 7 - 7.4 - 0.15 * (j - 23 + 11);
    if (std::abs(left) > 2.5 || std::abs(right) > 2.5) continue;
    const float value = blended.values(11, j, 7);
    EXPECT_GE(value, std::min(left, right) - 1e-5);
    EXPECT_LE(value, std::max(left, right) + 1e-5);
    EXPECT_NEAR(value, 0.5 * (left + right), 0.25 * std::abs(left - right) + 1e-5);
  }
}

TEST(BlendSeams, LeavesWhatDoesNotAgree) {
  // A wall of 4 voxels that ends at the seam: beyond it the copy says air, 8 voxels away from
  // solid. Without the limit the wall's end would be drawn out into a fin.
  const DistanceField example = makeField({40, 24, 24}, 1, {0, 0, 0}, [](const Vec3d& p) {
    return std::max(std::abs(p.z - 11.4) - 2, p.x - 29.5);
  });
  const Copied copied(example, -16);
  const auto change = [&](double agreement) {
    const DistanceField blended =
        blendSeams(copied.field, copied.origins, example, {.agreement = agreement});
    double most = 0;
    for (std::size_t n = 0; n < blended.values.count(); ++n) {
      most = std::max(
          most, std::abs(double{blended.values.values()[n]} - copied.field.values.values()[n]));
    }
    return most;
  };
  EXPECT_LT(change(1.5), 0.25);
  EXPECT_GT(change(1e6), 1);
}

TEST(BlendSeams, MakesTheContouredSurfaceSmoother) {
  const DistanceField example = slopeField(0.2);
  const Copied copied(example, 5);
  const auto roughest = [&](const DistanceField& field) {
    const TriangleMesh mesh = fieldToMesh(field);
    double worst = 1;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3d& p = mesh.positions[mesh.triangles[t][0]];
      const Vec3d n = normalized(areaNormal(mesh, t));
      if (p.z > 3 && p.z < 20 && p.y > 2 && p.y < 21 && p.x > 2 && p.x < 37) {
        worst = std::min(worst, n.z);
      }
    }
    return std::acos(worst);
  };
  EXPECT_GT(roughest(copied.field), 0.7);
  EXPECT_LT(roughest(blendSeams(copied.field, copied.origins, example)), 0.55);
}

TEST(BlendSeams, IsTheSameAtAnyNumberOfThreads) {
  const DistanceField example = slopeField(0.2);
  Copied copied(example, 5);
  DistanceField one, eight;
  tbb::task_arena(1).execute([&] { one = blendSeams(copied.field, copied.origins, example); });
  tbb::task_arena(8).execute([&] { eight = blendSeams(copied.field, copied.origins, example); });
  EXPECT_EQ(one.values, eight.values);
}

TEST(BlendSeams, BadInputIsRefused) {
  const DistanceField example = slopeField(0.2);
  Origins origins = identityOrigins(example.size());
  EXPECT_THROW(blendSeams(example, origins, example, {.width = 0}), InputError);
  EXPECT_THROW(blendSeams(example, origins, example, {.agreement = 0}), InputError);
  EXPECT_THROW(blendSeams(example, Origins({2, 2, 2}), example), InputError);
  origins(3, 3, 3).example = 1;
  EXPECT_THROW(blendSeams(example, origins, example), InputError);
}

}  // namespace
}  // namespace exemplar
