// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "sdf/resample.h"
#include "synth/geometry/pyramid/source_part.h"
#include "synth/geometry/quilting/quilting.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

/// A ball packing and the same at half the resolution, in one box.
struct Versions {
  DistanceField fine = balls({64, 56, 48}, 8, 3), coarse = blockAverage(fine, 2);
  const DistanceField* examples[1] = {&fine};

  Origins identity() const {
    Origins origins(coarse.size());
    for (std::size_t s = 0; s < origins.count(); ++s) origins.values()[s] = Origin(origins.ijk(s));
    return origins;
  }
};

TEST(AddDetail, IdentityGivesTheFinerExample) {
  const Versions v;
  const SynthesisResult result = addDetail(v.examples, v.identity(), 2);
  EXPECT_EQ(result.field.values, v.fine.values);
  EXPECT_EQ(result.field.voxelSize, v.fine.voxelSize);
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    ASSERT_EQ(result.origins.values()[s], Origin(result.origins.ijk(s)));
  }
}

TEST(AddDetail, TurnsAreFollowed) {
  // The whole example turned once, at the coarse resolution by hand.
  const Versions v;
  for (int turns = 1; turns < 4; ++turns) {
    SourcePart part;
    part.turns = turns;
    part.field = turnedField(v.coarse, turns);
    Origins origins(part.field.size());
    for (std::size_t s = 0; s < origins.count(); ++s) {
      origins.values()[s] = Origin(part.unturned(origins.ijk(s)), 0, turns);
      ASSERT_EQ(v.coarse.values[origins.values()[s].cell()], part.field.values.values()[s]);
    }
    const SynthesisResult result = addDetail(v.examples, origins, 2);
    EXPECT_EQ(result.field.values, turnedField(v.fine, turns).values);
  }
}

TEST(AddDetail, ASynthesisGetsTheFinerExamplesSurface) {
  const Versions v;
  const SynthesisResult coarse = synthesizeByQuilting(v.coarse, {.size = {44, 28, 24}});
  const SynthesisResult fine = addDetail(v.examples, coarse.origins, 2);
  ASSERT_EQ(fine.field.size(), (Vec3i{88, 56, 48}));
  std::int64_t differ = 0;
  for (std::size_t s = 0; s < fine.origins.count(); ++s) {
    const Vec3i p = fine.origins.ijk(s);
    ASSERT_EQ(fine.field.values[p] < 0, v.fine.values[fine.origins[p].cell()] < 0);
    differ += (fine.field.values[p] < 0) != (coarse.field.values(p.x / 2, p.y / 2, p.z / 2) < 0);
  }
  // The same shapes, but for the surface's own voxels and the seams.
  EXPECT_GT(differ, 0);
  EXPECT_LT(static_cast<double>(differ) / static_cast<double>(fine.origins.count()), 0.08);
}

TEST(AddDetail, BadInputIsRefused) {
  const Versions v;
  EXPECT_THROW(addDetail(v.examples, v.identity(), 0), InputError);
  EXPECT_THROW(addDetail(v.examples, v.identity(), 3), InputError);  // not three times as fine
  Origins origins = v.identity();
  origins(3, 3, 3).example = 1;
  EXPECT_THROW(addDetail(v.examples, origins, 2), InputError);
}

TEST(SampledFinely, IsTheFieldInTheSameBox) {
  const Versions v;
  const DistanceField fine = sampledFinely(v.fine, v.coarse, 2);
  EXPECT_EQ(fine.size(), v.fine.size());
  EXPECT_NEAR(fine.origin.x, v.fine.origin.x, 1e-12);
  for (std::size_t s = 0; s < fine.values.count(); ++s) {
    ASSERT_NEAR(fine.values.values()[s], v.fine.values.values()[s], 1e-5);
  }
}

}  // namespace
}  // namespace exemplar
