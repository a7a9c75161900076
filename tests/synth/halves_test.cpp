// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/halves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "synth/geometry/quilting/quilt.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

using testing::levelOf;
PyramidLevel levelOf(const DistanceField& example) { return levelOf(example, example.size()); }

/// Windows of five samples, so that small examples are long enough.
HalvesOptions options(std::uint64_t seed) {
  HalvesOptions options;
  options.seed = seed;
  options.window = 5;
  return options;
}

Vec3i offset(const PyramidSources& sources, const Vec3i& p) { return sources[p] - p; }

/// The axis along which most samples have moved.
int movedAlong(const PyramidSources& sources) {
  const Vec3i d = offset(sources, {0, 0, 0});
  return d.x != 0 ? 0 : d.y != 0 ? 1 : 2;
}

/// A slope along x, `rise` higher at its end, with waves on it, and six samples below and above.
DistanceField slope(const Vec3i& size, double rise) {
  DistanceField field = constant(size, 0);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const Vec3i p = field.values.ijk(s);
    const double height = 6 + rise * p.x / (size.x - 1) + 0.5 * std::sin(0.9 * p.x + 0.6 * p.y);
    field.values.values()[s] = static_cast<float>(std::clamp(p.z - height, -4.0, 4.0));
  }
  return field;
}

/// The mean step of the height of the ground between neighboring columns of different pieces.
double stepAtJoint(const PyramidLevel& level, const PyramidSources& sources) {
  const Vec3i n = level.target.size;
  const auto height = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < n.z; ++k) {
      sum += std::clamp(0.5 - level.source.values[sources(i, j, k)], 0.0, 1.0);
    }
    return sum;
  };
  double sum = 0;
  int count = 0;
  for (int j = 0; j < n.y; ++j) {
    for (int i = 0; i + 1 < n.x; ++i) {
      if (offset(sources, {i, j, n.z / 2}) == offset(sources, {i + 1, j, n.z / 2})) continue;
      sum += std::abs(height(i, j) - height(i + 1, j));
      ++count;
    }
  }
  return count == 0 ? 0 : sum / count;
}

TEST(ExchangedHalves, IsMadeOfTwoHalvesExchanged) {
  const PyramidLevel level = levelOf(balls({24, 22, 20}, 4, 1));
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const PyramidSources sources = exchangedHalves(level, options(seed));
    ASSERT_FALSE(sources.empty());
    std::set<std::tuple<int, int, int>> offsets;
    for (std::size_t s = 0; s < sources.count(); ++s) {
      const Vec3i p = sources.ijk(s);
      if (!(p.x < 24 && p.y < 22 && p.z < 20)) continue;  // samples that only patches see
      ASSERT_TRUE(level.source.values.contains(sources.values()[s]));
      const Vec3i d = offset(sources, p);
      offsets.insert({d.x, d.y, d.z});
    }
    EXPECT_EQ(offsets.size(), 2u);
  }
}

TEST(ExchangedHalves, NoPartIsTwoFifthsWhereTheLargerIsDivided) {
  const DistanceField example = balls({40, 38, 36}, 4, 1);
  const PyramidLevel level = levelOf(example);
  std::set<std::set<std::tuple<int, int, int>>> ways;
  for (std::uint64_t seed = 0; seed < 9; ++seed) {
    HalvesOptions asked = options(seed);
    asked.divide = true;
    const PyramidSources sources = exchangedHalves(level, asked);
    ASSERT_FALSE(sources.empty());
    std::map<std::tuple<int, int, int>, double> shares;
    double all = 0;
    for (std::size_t s = 0; s < sources.count(); ++s) {
      const Vec3i p = sources.ijk(s);
      if (!(p.x < 40 && p.y < 38 && p.z < 36)) continue;
      const Vec3i d = offset(sources, p);
      shares[{d.x, d.y, d.z}] += 1;
      all += 1;
    }
    EXPECT_EQ(shares.size(), 3u);
    std::set<std::tuple<int, int, int>> offsets;
    for (const auto& [d, count] : shares) {
      // .36 and a half of .05, or the rest times a half and .06; and a sample's rounding.
      EXPECT_LT(count / all, 0.42);
      EXPECT_GT(count / all, 0.2);
      offsets.insert(d);
    }
    ways.insert(offsets);
  }
  EXPECT_GE(ways.size(), 7u);
}

TEST(ExchangedHalves, HoldsEachPartOnceButForTheOverlap) {
  const PyramidLevel level = levelOf(balls({24, 24, 24}, 4, 2));
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const PyramidSources sources = exchangedHalves(level, options(seed));
    const int axis = movedAlong(sources);
    Array3D<int> used(level.source.values.size());
    for (std::size_t s = 0; s < sources.count(); ++s) {
      const Vec3i p = sources.ijk(s);
      if (std::max({p.x, p.y, p.z}) < 24) ++used[sources.values()[s]];
    }
    for (std::size_t s = 0; s < used.count(); ++s) {
      // At most a quarter overlaps: half of it is left out at each end of the example.
      const int at = used.ijk(s)[axis];
      ASSERT_LE(used.values()[s], 2);
      if (at >= 3 && at < 21) {
        ASSERT_GE(used.values()[s], 1);
      }
    }
  }
}

TEST(ExchangedHalves, AllWindowsAreWholeButThoseAtTheExamplesEnds) {
  // Of what lies further than an overlap from the ends there is a window of one offset around each
  // sample, though the example was cut in its middle.
  const PyramidLevel level = levelOf(balls({32, 32, 32}, 4, 3));
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const HalvesOptions asked = options(seed);
    const PyramidSources sources = exchangedHalves(level, asked);
    const int axis = movedAlong(sources), half = asked.window / 2;
    std::vector<std::uint8_t> whole(32);
    Vec3i p{16, 16, 16};
    int torn = 0;
    for (p[axis] = half; p[axis] < 32 - half; ++p[axis]) {
      bool same = true;
      for (int step = -half; step <= half; ++step) {
        Vec3i q = p;
        q[axis] += step;
        same = same && offset(sources, q) == offset(sources, p);
      }
      if (same) whole[sources[p][axis]] = 1;
      torn += !same;
    }
    EXPECT_EQ(torn, asked.window - 1);  // the result's own: those across its one joint
    for (int at = 32 / 4; at < 32 - 32 / 4; ++at) EXPECT_TRUE(whole[at]) << at;
  }
}

TEST(ExchangedHalves, IsNewEnoughAndSeedsDiffer) {
  const PyramidLevel level = levelOf(balls({32, 32, 32}, 4, 4));
  std::set<std::tuple<int, int>> ways;
  for (std::uint64_t seed = 0; seed < 9; ++seed) {
    const PyramidSources sources = exchangedHalves(level, options(seed));
    EXPECT_GE(distanceToSource(level, sources, 2), options(0).novelty);
    const int axis = movedAlong(sources);
    ways.insert({axis, offset(sources, {0, 0, 0})[axis]});
  }
  EXPECT_GE(ways.size(), 7u);  // where an axis has no turn, others have more
}

TEST(ExchangedHalves, WhatIsNotNewEnoughIsCutAgain) {
  // A cut that undoes all: every plan is tried, and the farthest, a copy, comes back.
  const PyramidLevel level = levelOf(balls({20, 20, 20}, 4, 1));
  HalvesOptions asked = options(0);
  int cuts = 0;
  asked.cut = [&](PyramidSources& sources, const Progress&) {
    ++cuts;
    for (std::size_t s = 0; s < sources.count(); ++s) {
      sources.values()[s] = level.source.values.clamped(sources.ijk(s));
    }
  };
  const PyramidSources sources = exchangedHalves(level, asked);
  EXPECT_EQ(distanceToSource(level, sources, 0), 0);
  EXPECT_GE(cuts, 5);
  // One that cuts nothing is asked once.
  cuts = 0;
  asked.cut = [&](PyramidSources&, const Progress&) { ++cuts; };
  exchangedHalves(level, asked);
  EXPECT_EQ(cuts, 1);
}

TEST(ExchangedHalves, SlopingGroundMeetsAtOneHeight) {
  const DistanceField example = slope({48, 24, 24}, 6);
  const PyramidLevel level = levelOf(example);
  HalvesOptions asked = options(0);
  asked.stationary = {true, false, false};
  const PyramidSources sources = exchangedHalves(level, asked);
  ASSERT_FALSE(sources.empty());
  EXPECT_EQ(movedAlong(sources), 0);
  EXPECT_LT(stepAtJoint(level, sources), 1.5);
  // The checker: the same halves, not lifted, meet in a cliff.
  PyramidSources cliff = sources;
  for (std::size_t s = 0; s < cliff.count(); ++s) cliff.values()[s].z = cliff.ijk(s).z;
  EXPECT_GT(stepAtJoint(level, cliff), 4);
  // It is still ground, and as much of it.
  std::int64_t solid = 0, was = 0;
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    const Vec3i p = example.values.ijk(s);
    const bool here = level.source.values[sources[p]] < 0;
    if (p.z == 0) {
      ASSERT_TRUE(here);
    }
    if (p.z == 23) {
      ASSERT_FALSE(here);
    }
    solid += here;
    was += example.values.values()[s] < 0;
  }
  EXPECT_NEAR(static_cast<double>(solid) / static_cast<double>(was), 1, 0.1);
}

TEST(ExchangedHalves, AnExampleThatRepeatsOverlapsByAPeriod) {
  // 46 samples of a field of period 8: the ends fit where halves overlap by 6.
  const PyramidLevel level = levelOf(waves({46, 46, 46}, 8));
  const PyramidSources sources = exchangedHalves(level, options(0));
  const int axis = movedAlong(sources);
  Vec3i step{0, 0, 0};
  step[axis] = 8;
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s);
    if (std::max({p.x, p.y, p.z}) + 8 >= 46) continue;
    ASSERT_NEAR(level.source.values[sources[p]], level.source.values[sources[p + step]], 1e-4);
  }
}

TEST(ExchangedHalves, IsNothingWhereNoAxisWillDo) {
  EXPECT_TRUE(
      exchangedHalves(levelOf(balls({24, 24, 24}, 4, 1), {24, 24, 25}), options(0)).empty());
  EXPECT_TRUE(exchangedHalves(levelOf(balls({19, 19, 19}, 4, 1)), options(0)).empty());
  HalvesOptions asked = options(0);
  asked.stationary = {false, false, false};
  EXPECT_TRUE(exchangedHalves(levelOf(balls({24, 24, 24}, 4, 1)), asked).empty());
  // An object with air around it keeps its ends.
  DistanceField object = constant({24, 24, 24}, 4);
  for (std::size_t s = 0; s < object.values.count(); ++s) {
    const Vec3i p = object.values.ijk(s);
    const double r = length(Vec3d{p.x - 11.5, p.y - 11.5, p.z - 11.5});
    object.values.values()[s] = static_cast<float>(std::clamp(r - 8, -4.0, 4.0));
  }
  EXPECT_TRUE(exchangedHalves(levelOf(object), options(0)).empty());
}

TEST(ExchangedHalves, SameSeedSameBytesAtAnyNumberOfThreads) {
  for (const DistanceField& example : {balls({24, 20, 22}, 4, 2), slope({32, 28, 24}, 5)}) {
    const PyramidLevel level = levelOf(example);
    PyramidSources one, eight;
    HalvesOptions asked = options(3);
    asked.divide = true;
    withThreads(1, [&] { one = exchangedHalves(level, asked); });
    withThreads(8, [&] { eight = exchangedHalves(level, asked); });
    ASSERT_FALSE(one.empty());
    EXPECT_EQ(one, eight);
  }
}

}  // namespace
}  // namespace exemplar
