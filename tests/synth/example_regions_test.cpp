// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/voting/example_regions.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/cells.h"
#include "core/error.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

constexpr Vec3i kSize{48, 40, 24};

/// The shares of `kSize` by volume.
std::vector<double> volumes(const ExampleRegions& regions, std::size_t examples) {
  std::vector<double> shares(examples);
  forEachCell(kSize, [&](const Vec3i& p) {
    shares[static_cast<std::size_t>(regions.at(cast<double>(p)))] += 1.0 / volume(kSize);
  });
  return shares;
}

ExampleRegions regionsOf(std::span<const DistanceField* const> examples, const MixOptions& mix,
                         std::uint64_t seed = 0, const Axes& along = Axes::every(),
                         const Axes& periodic = {}) {
  return ExampleRegions(examples, mix, kSize, along, periodic, seed);
}

TEST(ExampleRegions, HaveTheSharesThatAreAskedForByVolumeWhereSurfacesAreAlike) {
  const DistanceField a = balls({24, 24, 24}, 4, 1);
  const DistanceField* examples[] = {&a, &a, &a};
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const auto shares = volumes(regionsOf(examples, {.shares = {0.2, 0.5, 0.3}}, seed), 3);
    // Quantiles are taken from 32 x 32 x 24 of 48 x 40 x 24 samples.
    EXPECT_NEAR(shares[0], 0.2, 0.02);
    EXPECT_NEAR(shares[1], 0.5, 0.02);
    EXPECT_NEAR(shares[2], 0.3, 0.02);
    const auto one = volumes(regionsOf(examples, {.shares = {0, 1, 0}}, seed), 3);
    EXPECT_NEAR(one[1], 1, 1e-9);
  }
}

TEST(ExampleRegions, GiveLessVolumeToWhatHasMoreSurface) {
  // Surface for each unit of solid is 3 / radius, and both are about as full.
  const DistanceField fine = balls({24, 24, 24}, 2.5, 1), coarse = balls({24, 24, 24}, 5, 1);
  const DistanceField* examples[] = {&fine, &coarse};
  EXPECT_LT(volumes(regionsOf(examples, {}), 2)[0], 0.45);
  ExampleRegions regions = regionsOf(examples, {});
  const double before = volumes(regions, 2)[0];
  const double made[] = {0.7, 0.3};
  regions.correct(made);
  EXPECT_LT(volumes(regions, 2)[0], before - 0.1);
}

TEST(ExampleRegions, AreFewAndDoNotChangeAlongAxesOfNoPlace) {
  const DistanceField a = balls({24, 24, 24}, 4, 1);
  const DistanceField* examples[] = {&a, &a};
  const ExampleRegions columns = regionsOf(examples, {}, 3, {true, true, false});
  std::int64_t changes[3] = {};
  forEachCell(kSize, [&](const Vec3i& p) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i q = p;
      if (++q[axis] < kSize[axis])
        changes[axis] += columns.at(cast<double>(p)) != columns.at(cast<double>(q));
    }
  });
  EXPECT_EQ(changes[2], 0);
  // A line along an axis crosses a border once in some dozen samples, not in each.
  EXPECT_GT(changes[0] + changes[1], 40 * 24);
  EXPECT_LT(changes[0] + changes[1], (40 + 48) * 24 * 5);
}

TEST(ExampleRegions, TileWhereTheResultDoes) {
  const DistanceField a = balls({24, 24, 24}, 4, 1);
  const DistanceField* examples[] = {&a, &a};
  const ExampleRegions regions = regionsOf(examples, {}, 5, Axes::every(), Axes::every());
  forEachCell(kSize, [&](const Vec3i& p) {
    ASSERT_EQ(regions.at(cast<double>(p)), regions.at(cast<double>(p + kSize)));
  });
}

TEST(ExampleRegions, FollowWhatIsPainted) {
  const DistanceField a = balls({24, 24, 24}, 2.5, 1), b = balls({24, 24, 24}, 5, 1);
  const DistanceField* examples[] = {&a, &b};
  MixOptions mix;
  mix.map = Array3D<float>(kSize);
  forEachCell(kSize, [&](const Vec3i& p) {
    (*mix.map)[p] = p.x < 16 ? 0.0f : p.x < 32 ? 1.0f : 0.5f;
  });
  ExampleRegions regions = regionsOf(examples, mix);
  const double made[] = {0.9, 0.1};
  regions.correct(made);
  double gray = 0;
  forEachCell(kSize, [&](const Vec3i& p) {
    const int example = regions.at(cast<double>(p));
    if (p.x < 32) {
      ASSERT_EQ(example, p.x < 16 ? 0 : 1);
    } else {
      gray += example / (16.0 * 40 * 24);
    }
  });
  EXPECT_GT(gray, 0.2);  // half in the mean over all of the box
  EXPECT_LT(gray, 0.8);
}

TEST(ExampleRegions, RefuseWhatIsNoShare) {
  const DistanceField a = balls({16, 16, 16}, 4, 1);
  const DistanceField* examples[] = {&a, &a};
  EXPECT_THROW(regionsOf(examples, {.shares = {1}}), InputError);
  EXPECT_THROW(regionsOf(examples, {.shares = {0.5, 0.4}}), InputError);
  EXPECT_THROW(regionsOf(examples, {.shares = {-0.5, 1.5}}), InputError);
  MixOptions mix;
  mix.map = Array3D<float>({4, 4, 4});
  EXPECT_THROW(regionsOf(examples, mix), InputError);
}

}  // namespace
}  // namespace exemplar
