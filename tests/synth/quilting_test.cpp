// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/quilting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "synth/geometry/quilting/repetition.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

TEST(Quilting, OfTheExamplesSizeIsNoCopyOfIt) {
  // A wall with bricks, air around it: it has a place of its own along every axis.
  DistanceField wall = constant({40, 16, 40}, 0);
  for (std::size_t s = 0; s < wall.values.count(); ++s) {
    const Vec3i p = wall.values.ijk(s);
    const int brick = (p.x / 5 + p.z / 4) % 3;
    wall.values.values()[s] = static_cast<float>(std::max(
        {std::abs(p.x - 19.5) - 16, std::abs(p.y - 7.5) - 2 - brick, std::abs(p.z - 19.5) - 16}));
  }
  for (const DistanceField& example : {balls({32, 32, 32}, 4, 1), wall}) {
    const SynthesisResult result = synthesizeByQuilting(example, {.size = example.size()});
    double both = 0, either = 0;
    for (std::size_t s = 0; s < result.field.values.count(); ++s) {
      const bool here = result.field.values.values()[s] < 0, there = example.values.values()[s] < 0;
      both += here && there;
      either += here || there;
    }
    EXPECT_GT(1 - both / either, 0.1);
    EXPECT_LT(1 - both / either, 0.95);
  }
}

TEST(Quilting, ResultsOfTheExamplesSizeAreNearlyAllOfThreeParts) {
  // 44 samples: four windows of 11, the least. All but what is near the joints is of three
  // offsets.
  const DistanceField example = balls({44, 44, 44}, 5, 6);
  QuiltingOptions asked;
  asked.size = example.size();
  asked.stationary = Axes::every();
  const SynthesisResult result = synthesizeByQuilting(example, asked);
  std::map<std::tuple<int, int, int>, int> samples;
  std::int64_t wrong = 0;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Vec3i p = result.origins.ijk(s), cell = result.origins[p].cell();
    const Vec3i d = cell - p;
    ++samples[{d.x, d.y, d.z}];
    wrong += (result.field.values[p] < 0) != (example.values[cell] < 0);
  }
  EXPECT_EQ(wrong, 0);
  std::vector<int> counts;
  for (const auto& [d, count] : samples) counts.push_back(count);
  std::sort(counts.rbegin(), counts.rend());
  ASSERT_GE(counts.size(), 3u);
  const double all = static_cast<double>(result.origins.count());
  EXPECT_GT((counts[0] + counts[1] + counts[2]) / all, 0.7);
  EXPECT_LT(counts[0] / all, 0.5);
  EXPECT_GT(counts[2] / all, 0.1);
  EXPECT_EQ(samples.count({0, 0, 0}), 0u);
}

TEST(Quilting, WhatRepeatsStaysAligned) {
  // Steps between samples, and parts a little out of place, as in woven things.
  const DistanceField example =
      lattice({45, 42, 15}, {{{14.7, 0, 0}, {0, 10.4, 0}, {0, 0, 30}}}, 3.4, 0.2);
  QuiltingOptions options;
  options.size = {90, 84, 15};
  Repetition steps;
  steps.basis = {{14.7, 0, 0}, {0, 10.4, 0}};
  for (options.seed = 0; options.seed < 2; ++options.seed) {
    const SynthesisResult result = synthesizeByQuilting(example, options);
    std::int64_t out = 0;
    for (std::size_t s = 0; s < result.origins.count(); ++s) {
      const Vec3i step = result.origins.values()[s].cell() - result.origins.ijk(s);
      out += !steps.holds(step, 1.5);
    }
    // Single samples at seams may have been moved aside.
    EXPECT_LT(static_cast<double>(out), 0.01 * static_cast<double>(result.origins.count()));
  }
}

TEST(Quilting, WhatRepeatsMeetsItsOtherSideAligned) {
  const DistanceField example =
      lattice({45, 42, 15}, {{{14.9, 0, 0}, {0, 10.6, 0}, {0, 0, 30}}}, 3.4, 0.2);
  QuiltingOptions options;
  options.size = {90, 84, 15};
  options.periodic = {true, true, false};
  const SynthesisResult result = synthesizeByQuilting(example, options);
  const Array3D<float>& values = result.field.values;
  // Neighbors across the faces differ hardly more than neighbors inside: the worst pair by 1.26
  // voxels, inside by 1.17. What lies beside the faces is held fixed while seams there are cut.
  double most = 0, across = 0;
  for (std::size_t s = 0; s < values.count(); ++s) {
    const Vec3i p = values.ijk(s);
    for (int axis = 0; axis < 2; ++axis) {
      Vec3i q = p;
      q[axis] = (p[axis] + 1) % values.size()[axis];
      double& worst = q[axis] == 0 ? across : most;
      worst = std::max<double>(worst, std::abs(values[p] - values[q]));
    }
  }
  EXPECT_LE(across, most + 0.1);
  EXPECT_LT(across, 1.5);  // a distance, with parts 0.4 out of place and steps between samples
  std::int64_t out = 0;
  Repetition steps;
  steps.basis = {{15, 0, 0}, {0, 10.5, 0}};  // six and eight of them
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    out += !steps.holds(result.origins.values()[s].cell() - result.origins.ijk(s), 1.5);
  }
  EXPECT_LT(static_cast<double>(out), 0.01 * static_cast<double>(result.origins.count()));
}

TEST(Quilting, RefusesOptionsOutOfRange) {
  const DistanceField example = balls({16, 16, 16}, 4, 1);
  const auto refused = [&](const auto& change, const std::string& word) {
    QuiltingOptions options{.size = {16, 16, 16}};
    change(options);
    try {
      synthesizeByQuilting(example, options);
      return false;
    } catch (const InputError& error) {
      return std::string(error.what()).find(word) != std::string::npos;
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused([](QuiltingOptions&) {}, ""));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.size.z = 0; }, "size"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.size = {30000, 30000, 30000}; }, "memory"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.patch = 2; }, "patch"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.patch = 16; }, "patch"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.levels = 0; }, "levels"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.levels = 9; }, "levels"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.rounds = 0; }, "rounds"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.rounds = 101; }, "rounds"));
  EXPECT_TRUE(refused([](QuiltingOptions& o) { o.truncation = 0; }, "truncation"));
  EXPECT_TRUE(refused([&](QuiltingOptions& o) { o.truncation = nan; }, "truncation"));
  EXPECT_THROW(synthesizeByQuilting(DistanceField{}, {.size = {8, 8, 8}}), InputError);
}

TEST(SuitsQuilting, PlainExamplesOfAnySize) {
  const DistanceField example = balls({24, 24, 24}, 4, 1);
  EXPECT_TRUE(suitsQuilting(example, {.size = {24, 24, 24}}));
  EXPECT_TRUE(suitsQuilting(example, {.size = {50, 20, 30}}));
  EXPECT_THROW(suitsQuilting(example, {.size = {0, 20, 30}}), InputError);
}

TEST(SuitsQuilting, OnlyAsMuchOfASlopeAsTheExampleHas) {
  DistanceField slope = constant({24, 24, 20}, 0);
  for (std::size_t s = 0; s < slope.values.count(); ++s) {
    const Vec3i p = slope.values.ijk(s);
    slope.values.values()[s] = static_cast<float>(p.z - 5.0 - p.x / 4.0);
  }
  EXPECT_TRUE(suitsQuilting(slope, {.size = {24, 24, 20}}));
  EXPECT_TRUE(suitsQuilting(slope, {.size = {20, 24, 20}}));
  EXPECT_FALSE(suitsQuilting(slope, {.size = {25, 24, 20}}));
}

TEST(SuitsQuilting, APeriodicResultOnlyOfWhatRepeatsAWholeNumberOfTimes) {
  const DistanceField example =
      lattice({45, 42, 15}, {{{14.9, 0, 0}, {0, 10.6, 0}, {0, 0, 30}}}, 3.4, 0.2);
  QuiltingOptions options{.size = {90, 84, 15}, .periodic = {true, true, false}};
  EXPECT_TRUE(suitsQuilting(example, options));
  options.size.x = 97;  // six periods and a half
  EXPECT_FALSE(suitsQuilting(example, options));
  EXPECT_THROW(synthesizeByQuilting(example, options), InputError);
  options.periodic = {false, true, false};
  EXPECT_TRUE(suitsQuilting(example, options));
  EXPECT_FALSE(suitsQuilting(balls({40, 40, 40}, 5, 2),
                             {.size = {40, 40, 40}, .periodic = {true, false, false}}));
}

}  // namespace
}  // namespace exemplar
