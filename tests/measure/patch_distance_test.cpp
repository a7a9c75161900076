// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/patch_distance.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/measure/fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using testing::ball;
using testing::ballPacking;
using testing::balls;
using testing::emptyField;
using testing::makeField;
using testing::moved;
using testing::noise;
using testing::packing;

TEST(PatchDistance, OfTheExampleAgainstItselfIsItsFloor) {
  const DistanceField example = ballPacking({48, 48, 48}, 1);
  const auto d = patchDistance(example, example);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->distance, d->floor);
  EXPECT_GT(d->floor, 0);
}

TEST(PatchDistance, GrowsAsTheMaterialDeparts) {
  // The same process at another seed is nearer than balls of another size, and these than noise.
  const Vec3i n{48, 48, 48};
  const DistanceField example = ballPacking(n, 1);
  const auto to = [&](const DistanceField& field) {
    const auto d = patchDistance(example, field);
    return d->distance / d->floor;
  };
  const double fresh = to(ballPacking(n, 2)), larger = to(balls(n, 8, packing(n, 8, 0.5, 3)));
  const double rough = to(noise(n, 0.3, 4));
  EXPECT_LT(fresh, 5);
  EXPECT_GT(larger, 4 * fresh);
  EXPECT_GT(rough, 10 * larger);
}

// The definition again for one component, over all patches instead of 4,000 draws, with the
// component by power iteration: (m1 - m2)² + (s1 - s2)². Sampling changes the means and deviations
// by about 1 / sqrt(4 * 4000) = 1 % of a deviation, so the distance of two fields that are a
// deviation or so apart by a few percent.
TEST(PatchDistance, AgreesWithItsDefinitionForOneComponent) {
  const Vec3i n{32, 32, 32};
  const DistanceField example = ball(n, {15.3, 15.8, 16.1}, 9), result = ball(n, {16, 15, 15.7}, 5);
  using Patch = std::vector<double>;
  const auto patches = [&](const DistanceField& field) {
    std::vector<Patch> all;
    for (int k = 3; k < n.z - 3; ++k)
      for (int j = 3; j < n.y - 3; ++j)
        for (int i = 3; i < n.x - 3; ++i) {
          if (std::abs(field.values(i, j, k)) > 0.5f) continue;
          Patch patch;
          for (int c = 0; c < 343; ++c)
            patch.push_back(std::clamp<double>(
                field.values(i + c % 7 - 3, j + c / 7 % 7 - 3, k + c / 49 - 3), -3, 3));
          all.push_back(patch);
        }
    return all;
  };
  const auto mean = [](const std::vector<Patch>& all) {
    Patch m(343);
    for (const Patch& p : all)
      for (int c = 0; c < 343; ++c) m[c] += p[c] / static_cast<double>(all.size());
    return m;
  };
  const auto along = [](const Patch& p, const Patch& axis) {
    double sum = 0;
    for (int c = 0; c < 343; ++c) sum += p[c] * axis[c];
    return sum;
  };
  const std::vector<Patch> e = patches(example), r = patches(result);
  const Patch center = mean(e);
  // A ball's three components across are nearly equal in variance, so power iteration may end
  // anywhere among them; start with the field's gradient along a diagonal and take many steps.
  Patch axis(343);
  for (int c = 0; c < 343; ++c) axis[c] = c % 7 - 3 + 0.3 * (c / 7 % 7 - 3) + 0.1 * (c / 49 - 3);
  for (int step = 0; step < 400; ++step) {
    Patch next(343);
    for (const Patch& p : e) {
      const double weight = along(p, axis) - along(center, axis);
      for (int c = 0; c < 343; ++c) next[c] += weight * (p[c] - center[c]);
    }
    const double size = std::sqrt(along(next, next));
    for (int c = 0; c < 343; ++c) axis[c] = next[c] / size;
  }
  const auto moments = [&](const std::vector<Patch>& all) {
    const double m = along(mean(all), axis);
    double square = 0;
    for (const Patch& p : all) square += std::pow(along(p, axis) - m, 2);
    return std::pair{m, std::sqrt(square / static_cast<double>(all.size() - 1))};
  };
  const auto [m1, s1] = moments(e);
  const auto [m2, s2] = moments(r);
  const double expected = std::pow(m1 - m2, 2) + std::pow(s1 - s2, 2);

  PatchDistanceOptions options;
  options.components = 1;
  options.patches = 20000;
  const auto d = patchDistance(example, result, options);
  EXPECT_EQ(d->examplePatches, static_cast<std::int64_t>(e.size()));
  EXPECT_EQ(d->resultPatches, static_cast<std::int64_t>(r.size()));
  ASSERT_GT(expected, 0.2);
  EXPECT_NEAR(d->distance / expected, 1, 0.25);
}

TEST(PatchDistance, DoesNotDependOnWhatIsFarFromTheSurface) {
  const Vec3i n{40, 40, 40};
  const DistanceField full = ballPacking(n, 5), other = ballPacking(n, 6);
  const auto truncate = [](DistanceField field, float at) {
    for (float& v : field.values.values()) v = std::clamp(v, -at, at);
    field.truncation = at;
    return field;
  };
  const auto a = patchDistance(full, other),
             b = patchDistance(truncate(full, 3), truncate(other, 4));
  EXPECT_EQ(a->distance, b->distance);
  // A narrower band is one for both, and the example is still at its floor.
  const auto narrow = patchDistance(full, truncate(full, 2));
  EXPECT_EQ(narrow->distance, narrow->floor);
}

TEST(PatchDistance, CountsInVoxels) {
  DistanceField a = ballPacking({40, 40, 40}, 5), b = ballPacking({40, 40, 40}, 6);
  const double expected = patchDistance(a, b)->distance;
  for (DistanceField* f : {&a, &b}) {
    f->voxelSize = 0.25;  // a power of two: nothing is rounded
    for (float& v : f->values.values()) v *= 0.25f;
  }
  EXPECT_EQ(patchDistance(a, b)->distance, expected);
}

TEST(PatchDistance, IsAbsentWithoutPatches) {
  const DistanceField example = ball({24, 24, 24}, {12, 12, 12}, 6);
  EXPECT_FALSE(patchDistance(example, emptyField({24, 24, 24})));
  EXPECT_FALSE(patchDistance(emptyField({24, 24, 24}), example));
  EXPECT_FALSE(patchDistance(example, ball({24, 24, 6}, {12, 12, 3}, 6)));
}

TEST(PatchDistance, RefusesFieldsThatCannotBeCompared) {
  const DistanceField example = ball({24, 24, 24}, {12, 12, 12}, 6);
  DistanceField fine = example;
  fine.voxelSize = 0.5;
  EXPECT_THROW(patchDistance(example, fine), InputError);
  EXPECT_THROW(patchDistance(example, DistanceField{}), InputError);
}

TEST(PatchDistance, IsTheSameAtOneAndEightThreads) {
  const DistanceField a = ballPacking({40, 40, 40}, 7), b = ballPacking({40, 40, 40}, 8);
  const auto measure = [&] {
    const auto d = patchDistance(a, b);
    return std::pair{d->distance, d->floor};
  };
  EXPECT_EQ(testing::onThreads(1, measure), testing::onThreads(8, measure));
}

}  // namespace
}  // namespace exemplar
