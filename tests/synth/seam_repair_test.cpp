// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/patches/seam_repair.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

/// Sizes here are 7 + an even number, so that patches cover a target without more samples.
/// Everything copied from `shift` further along x from the middle on.
PyramidSources halves(const PyramidLevel& level, int shift) {
  PyramidSources sources(level.target.framed());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s);
    sources.values()[s] =
        level.source.values.clamped(p + Vec3i{p.x < sources.size().x / 2 ? 0 : shift, 0, 0});
  }
  return sources;
}

std::int64_t count(const Array3D<std::uint8_t>& marks) {
  return std::count(marks.values().begin(), marks.values().end(), 1);
}

Array3D<std::uint8_t> sprinkled(const Vec3i& size, double share, std::uint64_t seed) {
  Array3D<std::uint8_t> marks(size);
  const Random random(seed);
  for (std::size_t s = 0; s < marks.count(); ++s) marks.values()[s] = random.uniform(s) < share;
  return marks;
}

TEST(BadSeams, ACopyHasNone) {
  const PyramidLevel level = levelOf(balls({25, 21, 21}, 4, 1), {25, 21, 21});
  EXPECT_EQ(count(badSeams(level, halves(level, 0), 0)), 0);
}

TEST(BadSeams, ASeamWhereBothSidesAgreeIsNotBad) {
  // An example that repeats after 8 samples, cut and moved by as much.
  const PyramidLevel level = levelOf(waves({33, 25, 25}, 8), {25, 25, 25});
  // Rounding of the waves; their values are some voxels.
  EXPECT_EQ(count(badSeams(level, halves(level, 8), 1e-4)), 0);
  EXPECT_GT(count(badSeams(level, halves(level, 4), 1e-4)), 0);
}

TEST(BadSeams, OnlySamplesBesideTheSeamAreMarked) {
  const PyramidLevel level = levelOf(balls({40, 25, 25}, 4, 2), {29, 25, 25});
  const PyramidSources sources = halves(level, 7);
  const Array3D<std::uint8_t> bad = badSeams(level, sources, 1);
  const int middle = sources.size().x / 2;
  ASSERT_GT(count(bad), 0);
  for (std::size_t s = 0; s < bad.count(); ++s) {
    const int x = bad.ijk(s).x;
    if (bad.values()[s]) {
      ASSERT_TRUE(x == middle - 1 || x == middle) << x;
    }
  }
}

TEST(BadSeams, AHigherLimitMarksFewer) {
  const PyramidLevel level = levelOf(balls({40, 25, 25}, 4, 3), {29, 25, 25});
  const PyramidSources sources = halves(level, 7);
  std::int64_t before = count(badSeams(level, sources, 0));
  for (const double limit : {1.0, 2.0, 4.0}) {
    const std::int64_t now = count(badSeams(level, sources, limit));
    EXPECT_LT(now, before);
    before = now;
  }
  // Both terms are differences of distances cut off at four.
  EXPECT_EQ(count(badSeams(level, sources, 16)), 0);
}

TEST(BadSeams, PatchesAndSamplesThatCoverEachOtherAreFound) {
  const Vec3i size{19, 15, 12}, patch{7, 5, 3}, stride{2, 2, 1};
  const Vec3i shape{(size.x - patch.x) / stride.x + 1, (size.y - patch.y) / stride.y + 1,
                    (size.z - patch.z) / stride.z + 1};
  const auto covers = [&](const Vec3i& n, const Vec3i& p) {
    const Vec3i d = p - scaled(n, stride);
    return max(d, {0, 0, 0}) == d && min(d, patch - Vec3i{1, 1, 1}) == d;
  };
  const Array3D<std::uint8_t> samples = sprinkled(size, 0.004, 1);
  const Array3D<std::uint8_t> patches = patchesCovering(samples, patch, stride, shape);
  ASSERT_GT(count(patches), 0);
  ASSERT_LT(count(patches), static_cast<std::int64_t>(patches.count()));
  for (std::size_t n = 0; n < patches.count(); ++n) {
    bool any = false;
    for (std::size_t s = 0; s < samples.count(); ++s) {
      any = any || (samples.values()[s] && covers(patches.ijk(n), samples.ijk(s)));
    }
    ASSERT_EQ(patches.values()[n] != 0, any);
  }
  const Array3D<std::uint8_t> few = sprinkled(shape, 0.01, 2);
  const Array3D<std::uint8_t> covered = samplesCovered(few, patch, stride, size);
  for (std::size_t s = 0; s < covered.count(); ++s) {
    bool any = false;
    for (std::size_t n = 0; n < few.count(); ++n) {
      any = any || (few.values()[n] && covers(few.ijk(n), covered.ijk(s)));
    }
    ASSERT_EQ(covered.values()[s] != 0, any);
  }
}

}  // namespace
}  // namespace exemplar
