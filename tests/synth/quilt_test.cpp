// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/quilt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

/// A wall with air around it and bricks that protrude from it.
DistanceField wall() {
  DistanceField field = constant({24, 12, 24}, 0);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3i p = field.values.ijk(s);
    const int brick = (p.x / 5 + p.z / 4) % 3;
    const Vec3d d{std::abs(p.x - 11.5) - 9, std::abs(p.y - 5.5) - 1 - brick,
                  std::abs(p.z - 11.5) - 9};
    field.values.values()[s] = static_cast<float>(std::max({d.x, d.y, d.z}));
  }
  return field;
}

PyramidSources moved(const PyramidLevel& level, const Vec3i& shift) {
  PyramidSources sources(level.target.framed());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    sources.values()[s] = level.source.values.clamped(sources.ijk(s) + shift);
  }
  return sources;
}

TEST(Quilt, IsMadeOfFewLargeBlocksOfTheExample) {
  const PyramidLevel level = levelOf(balls({24, 20, 22}, 4, 1), {48, 40, 44});
  const PyramidSources sources = quilt(level, {});
  std::set<std::tuple<int, int, int>> offsets;
  for (std::size_t s = 0; s < sources.count(); ++s) {
    ASSERT_TRUE(level.source.values.contains(sources.values()[s]));
    const Vec3i d = sources.values()[s] - sources.ijk(s);
    offsets.insert({d.x, d.y, d.z});
  }
  // Rows of blocks of 0.9 of the example's side, each at a phase of its own: at most four a row,
  // four rows and four layers.
  EXPECT_LE(offsets.size(), 64u);
  EXPECT_GE(offsets.size(), 8u);
}

TEST(Quilt, SameSeedSameBytesAtAnyNumberOfThreads) {
  const PyramidLevel level = levelOf(balls({20, 20, 20}, 4, 2), {30, 41, 20});
  PyramidSources one, eight;
  withThreads(1, [&] { one = quilt(level, {}); });
  withThreads(8, [&] { eight = quilt(level, {}); });
  EXPECT_EQ(one, eight);
  QuiltOptions other;
  other.seed = 1;
  EXPECT_NE(quilt(level, other), one);
}

TEST(Quilt, OfTheExamplesSizeIsNoCopyOfIt) {
  for (const DistanceField& example : {balls({19, 19, 19}, 4, 3), wall()}) {
    const PyramidLevel level = levelOf(example, example.size());
    QuiltOptions options;
    for (options.seed = 0; options.seed < 2; ++options.seed) {
      EXPECT_GE(distanceToSource(level, quilt(level, options), 2), options.novelty);
    }
    // The checker: what is a copy, and what is one moved.
    EXPECT_EQ(distanceToSource(level, moved(level, {0, 0, 0}), 0), 0);
    EXPECT_GT(distanceToSource(level, moved(level, {2, 0, 0}), 0), 0.05);
    EXPECT_LT(distanceToSource(level, moved(level, {2, 0, 0}), 2), 0.02);
  }
}

TEST(Quilt, WhatIsLeftAfterCuttingCounts) {
  // A cut that makes all starts copies: the quilt that comes back is one, and all were tried.
  const PyramidLevel level = levelOf(balls({20, 20, 20}, 4, 1), {20, 20, 20});
  int cuts = 0;
  QuiltOptions options;
  options.cut = [&](PyramidSources& sources, const Progress&) {
    ++cuts;
    sources = moved(level, {0, 0, 0});
  };
  EXPECT_EQ(quilt(level, options), moved(level, {0, 0, 0}));
  EXPECT_GT(cuts, 4);
}

TEST(Quilt, BlocksStayWithinTheirWindow) {
  const PyramidLevel level = levelOf(ground({25, 25, 21}, 1), {25, 25, 21});
  QuiltOptions options;
  options.window = {-1, 3, 0};
  const PyramidSources sources = quilt(level, options);
  int farthest = 0;
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i d = sources.values()[s] - sources.ijk(s);
    // One more: the target has some samples more than the example, and places are rounded.
    ASSERT_LE(std::abs(d.y), 4);
    ASSERT_LE(std::abs(d.z), 1);
    farthest = std::max(farthest, std::abs(d.x));
  }
  EXPECT_GT(farthest, 4);
}

TEST(Quilt, AnExampleThatRepeatsContinuesToRepeat) {
  // Blocks that agree with what is there are those at whole periods; with no price on use or
  // variety nothing else is drawn, where there is room for a period beside a block.
  const PyramidLevel level = levelOf(waves({20, 20, 20}, 5), {37, 33, 25});
  QuiltOptions options;
  options.use = options.variety = 0;
  options.longBlock = 0.5;
  const PyramidSources sources = quilt(level, options);
  const Array3D<float> target = gather(level, sources);
  for (std::size_t s = 0; s < target.count(); ++s) {
    const Vec3i p = target.ijk(s);
    for (const Vec3i& step : {Vec3i{5, 0, 0}, Vec3i{0, 5, 0}, Vec3i{0, 0, 5}}) {
      if (target.contains(p + step)) {
        ASSERT_NEAR(target[p], target[p + step], 1e-4);
      }
    }
  }
}

TEST(Quilt, BlocksStayAlignedWithARepetition) {
  // Bricks: one step is along x, the other is not along an axis.
  const std::array<Vec3d, 3> steps{{{9, 0, 0}, {4.5, 6, 0}, {0, 0, 7}}};
  const PyramidLevel level = levelOf(lattice({36, 30, 24}, steps, 2.2, 0.3), {72, 60, 48});
  const auto unaligned = [&](const QuiltOptions& options) {
    Repetition repetition;
    repetition.basis.assign(steps.begin(), steps.end());
    const PyramidSources sources = quilt(level, options);
    std::int64_t out = 0;
    for (std::size_t s = 0; s < sources.count(); ++s) {
      out += !repetition.holds(sources.values()[s] - sources.ijk(s), 1);
    }
    return static_cast<double>(out) / static_cast<double>(sources.count());
  };
  QuiltOptions options;
  EXPECT_GT(unaligned(options), 0.2);
  options.repetition.basis.assign(steps.begin(), steps.end());
  EXPECT_EQ(unaligned(options), 0);
}

TEST(Quilt, BlocksOfARepetitionMeetTheOtherSide) {
  const std::array<Vec3d, 3> steps{{{10, 0, 0}, {0, 8, 0}, {0, 0, 40}}};
  const DistanceField example = lattice({30, 24, 12}, steps, 3, 0);
  PyramidOptions pyramid;
  pyramid.size = {50, 40, 12};
  pyramid.periodic = {true, true, false};
  const std::vector<SourcePart> parts{{example, 0, 0, {}}};
  const PyramidLevel level = makeLevel(parts, 0, pyramid);
  QuiltOptions options;
  options.repetition.basis = {steps[0], steps[1]};
  options.window = {-1, -1, 0};
  PyramidSources sources = quilt(level, options);
  pinSources(level, sources);
  const Array3D<float> target = gather(level, sources);
  for (std::size_t s = 0; s < target.count(); ++s) {
    // The example repeats exactly, so every sample, those in the margins too, is known.
    const Vec3i p = target.ijk(s) - level.target.margin.before;
    if (p.z < 0 || p.z >= example.size().z) continue;  // in the frame
    const Vec3i q{(p.x % 10 + 10) % 10, (p.y % 8 + 8) % 8, p.z};
    ASSERT_NEAR(target.values()[s], std::clamp(example.values[q], -4.0f, 4.0f), 1e-5);
  }
}

TEST(Quilt, EveryPartOfTheExampleGetsItsTurn) {
  const PyramidLevel level = levelOf(balls({20, 20, 20}, 4, 5), {40, 40, 40});
  // The share of the example that is used, and how unevenly: the mean difference of the uses of a
  // sample from their mean, of that mean.
  struct Use {
    double share = 0, unevenness = 0;
  };
  const auto used = [&](double price) {
    QuiltOptions options;
    options.use = price;
    options.longBlock = 0.5;  // which leaves blocks a choice
    Array3D<double> count(level.source.values.size());
    const PyramidSources sources = quilt(level, options);
    for (const Vec3i& cell : sources.values()) ++count[cell];
    const double samples = static_cast<double>(count.count());
    const double mean = static_cast<double>(sources.count()) / samples;
    Use use;
    for (const double uses : count.values()) {
      use.share += (uses > 0) / samples;
      use.unevenness += std::abs(uses - mean) / mean / samples;
    }
    return use;
  };
  const Use priced = used(0.3), free = used(0);
  EXPECT_GT(priced.share, 0.9);
  EXPECT_LT(priced.unevenness, 0.9 * free.unevenness);
}

TEST(Quilt, NothingSolidIsInTheFrameWhereAnObjectEndsAsItDid) {
  // An object with air around it, twice as long: its blocks at the ends show air there.
  const DistanceField example = wall();
  const PyramidLevel level = levelOf(example, {48, 12, 24});
  const Array3D<float> target = gather(level, quilt(level, {}));
  std::int64_t solid = 0, frame = 0;
  for (std::size_t s = 0; s < target.count(); ++s) {
    const Vec3i p = target.ijk(s);
    if (p.x >= level.target.margin.before.x && p.x < level.target.margin.before.x + 48) continue;
    ++frame;
    solid += target.values()[s] < 0;
  }
  EXPECT_LT(static_cast<double>(solid), 0.1 * static_cast<double>(frame));
}

TEST(Quilt, TakesSmallThinAndOddSizes) {
  for (const Vec3i& size : {Vec3i{1, 1, 1}, Vec3i{5, 40, 3}, Vec3i{2, 2, 33}}) {
    for (const Vec3i& from : {Vec3i{16, 15, 9}, Vec3i{20, 1, 20}, Vec3i{2, 3, 30}}) {
      const PyramidLevel level = levelOf(balls(from, 4, 1), size);
      const PyramidSources sources = quilt(level, {});
      for (const Vec3i& cell : sources.values()) ASSERT_TRUE(level.source.values.contains(cell));
    }
  }
}

}  // namespace
}  // namespace exemplar
