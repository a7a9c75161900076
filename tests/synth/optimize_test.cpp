// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/optimize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "core/error.h"
#include "sdf/height_map.h"
#include "synth/geometry/broken_pieces.h"
#include "synth/geometry/even_seams.h"
#include "synth/geometry/repetition.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

OptimizeOptions sized(const Vec3i& size) {
  OptimizeOptions options;
  options.size = size;
  options.rounds = 3;
  return options;
}

/// The samples whose side, or away from seams whose value, is not the example's at their origin.
std::int64_t samplesWrong(const DistanceField& example, const SynthesisResult& result) {
  const int reachOfSeams = EvenSeamsOptions{}.reach;
  const Origins& origins = result.origins;
  if (origins.size() != result.field.size()) return volume(result.field.size());
  std::int64_t wrong = 0, compared = 0;
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const Vec3i p = origins.ijk(s), cell = origins[p].cell();
    if (!example.values.contains(cell)) return volume(result.field.size());
    const float there = example.values[cell], here = result.field.values[p];
    wrong += (there < 0) != (here < 0);
    // A box holds all samples within so many steps.
    bool seam = false;
    const Vec3i reach{reachOfSeams, reachOfSeams, reachOfSeams};
    const Vec3i low = max(p - reach, Vec3i{0, 0, 0});
    const Vec3i high = min(p + reach, origins.size() - Vec3i{1, 1, 1});
    for (int k = low.z; k <= high.z && !seam; ++k) {
      for (int j = low.y; j <= high.y && !seam; ++j) {
        for (int i = low.x; i <= high.x && !seam; ++i) {
          seam = origins(i, j, k).cell() - Vec3i{i, j, k} != cell - p;
        }
      }
    }
    if (seam) continue;
    ++compared;
    wrong += there != here;
  }
  return compared == 0 && origins.count() > 10000 ? volume(origins.size()) : wrong;
}

TEST(Optimize, SamplesAreTheExamplesAtTheirOriginsAwayFromSeams) {
  for (const DistanceField& example : {balls({28, 28, 28}, 4, 1), ground({32, 32, 20}, 2)}) {
    const SynthesisResult result = synthesizeOptimized(example, sized({34, 30, 20}));
    EXPECT_EQ(result.status, SynthesisStatus::Complete);
    EXPECT_EQ(result.field.size(), (Vec3i{34, 30, 20}));
    EXPECT_GT(result.matches, 0);
    EXPECT_EQ(samplesWrong(example, result), 0);
  }
}

TEST(Optimize, SameSeedSameBytesAtAnyNumberOfThreads) {
  const DistanceField example = balls({32, 32, 32}, 4, 1);
  SynthesisResult one, eight;
  withThreads(1, [&] { one = synthesizeOptimized(example, sized({40, 36, 32})); });
  withThreads(8, [&] { eight = synthesizeOptimized(example, sized({40, 36, 32})); });
  EXPECT_EQ(one.origins, eight.origins);
  EXPECT_EQ(one.field.values, eight.field.values);
}

TEST(Optimize, AnotherSeedGivesAnotherResult) {
  const DistanceField example = balls({28, 28, 28}, 4, 1);
  OptimizeOptions options = sized({28, 28, 28});
  const SynthesisResult first = synthesizeOptimized(example, options);
  options.seed = 1;
  EXPECT_NE(first.field.values, synthesizeOptimized(example, options).field.values);
}

TEST(Optimize, OfTheExamplesSizeIsNoCopyOfIt) {
  // A wall with bricks, air around it: it has a place of its own along every axis.
  DistanceField wall = constant({40, 16, 40}, 0);
  for (std::size_t s = 0; s < wall.values.count(); ++s) {
    const Vec3i p = wall.values.ijk(s);
    const int brick = (p.x / 5 + p.z / 4) % 3;
    wall.values.values()[s] = static_cast<float>(std::max(
        {std::abs(p.x - 19.5) - 16, std::abs(p.y - 7.5) - 2 - brick, std::abs(p.z - 19.5) - 16}));
  }
  for (const DistanceField& example : {balls({32, 32, 32}, 4, 1), wall}) {
    const SynthesisResult result = synthesizeOptimized(example, sized(example.size()));
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

TEST(Optimize, AConstantExampleGivesAConstant) {
  for (const float value : {-3.0f, 5.5f}) {
    const SynthesisResult result =
        synthesizeOptimized(constant({16, 16, 16}, value), sized({21, 18, 17}));
    for (const float v : result.field.values.values()) ASSERT_EQ(v, value);
  }
}

TEST(Optimize, BallsStayWhole) {
  // Every piece of the result has at least half the samples of the example's smallest: what
  // dropBrokenPieces would clear away is not there any more.
  const DistanceField example = balls({32, 32, 32}, 4, 1);
  SynthesisResult result = synthesizeOptimized(example, sized({36, 36, 36}));
  EXPECT_EQ(dropBrokenPieces(example, result.origins), 0);
}

TEST(Optimize, WhatRepeatsGoesOnInStep) {
  // Steps between samples, and parts a little out of place, as in woven things.
  const DistanceField example =
      lattice({45, 42, 15}, {{{14.7, 0, 0}, {0, 10.4, 0}, {0, 0, 30}}}, 3.4, 0.2);
  OptimizeOptions options;
  options.size = {90, 84, 15};
  Repetition steps;
  steps.basis = {{14.7, 0, 0}, {0, 10.4, 0}};
  for (options.seed = 0; options.seed < 2; ++options.seed) {
    const SynthesisResult result = synthesizeOptimized(example, options);
    std::int64_t out = 0;
    for (std::size_t s = 0; s < result.origins.count(); ++s) {
      const Vec3i step = result.origins.values()[s].cell() - result.origins.ijk(s);
      out += !steps.holds(step, 1.5);
    }
    // Single samples at seams may have been moved aside.
    EXPECT_LT(static_cast<double>(out), 0.01 * static_cast<double>(result.origins.count()));
  }
}

TEST(Optimize, WhatRepeatsMeetsItsOtherSideInStep) {
  const DistanceField example =
      lattice({45, 42, 15}, {{{14.9, 0, 0}, {0, 10.6, 0}, {0, 0, 30}}}, 3.4, 0.2);
  OptimizeOptions options;
  options.size = {90, 84, 15};
  options.periodic = {true, true, false};
  const SynthesisResult result = synthesizeOptimized(example, options);
  const Array3D<float>& values = result.field.values;
  // Neighbours across the faces differ hardly more than neighbours inside: the worst pair by 1.26
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

TEST(Optimize, AnyCompletenessAboveZeroIsTaken) {
  const DistanceField example = balls({16, 16, 16}, 4, 1);
  for (const double completeness : {1e-300, 1e-3, 1e3, 1e300}) {
    OptimizeOptions options = sized({16, 16, 16});
    options.completeness = completeness;
    EXPECT_EQ(samplesWrong(example, synthesizeOptimized(example, options)), 0);
  }
}

TEST(Optimize, SidesInAirStayInAir) {
  // One ball with air all around, made twice as long: nothing solid may touch the box.
  DistanceField example = constant({24, 24, 24}, 0);
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    const Vec3d d = cast<double>(example.values.ijk(s)) - Vec3d{11.5, 11.5, 11.5};
    example.values.values()[s] = static_cast<float>(length(d)) - 8;
  }
  const Vec3i size{48, 24, 24};
  const SynthesisResult result = synthesizeOptimized(example, sized(size));
  std::int64_t solid = 0, outside = 0;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Vec3i p = result.origins.ijk(s);
    const bool side = p.x == 0 || p.y == 0 || p.z == 0 || p.x == size.x - 1 || p.y == size.y - 1 ||
                      p.z == size.z - 1;
    solid += result.field.values.values()[s] < 0;
    outside += side && result.field.values.values()[s] < 0;
  }
  EXPECT_GT(solid, 1000);
  EXPECT_EQ(outside, 0);
}

TEST(Optimize, GroundStaysGround) {
  const DistanceField example = ground({32, 32, 24}, 1);
  const SynthesisResult result = synthesizeOptimized(example, sized({48, 40, 24}));
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 48; ++i) {
      ASSERT_LT(result.field.values(i, j, 0), 0);
      ASSERT_GT(result.field.values(i, j, 23), 0);
    }
  }
}

TEST(Optimize, MakesSmallAndOddSizes) {
  const DistanceField example = balls({22, 19, 17}, 4, 1);
  for (const Vec3i& size : {Vec3i{7, 7, 7}, Vec3i{1, 1, 1}, Vec3i{3, 21, 9}, Vec3i{31, 8, 13}}) {
    const SynthesisResult result = synthesizeOptimized(example, sized(size));
    EXPECT_EQ(result.field.size(), size);
    EXPECT_EQ(samplesWrong(example, result), 0);
  }
}

TEST(Optimize, TakesThinExamples) {
  for (const Vec3i& size : {Vec3i{24, 24, 2}, Vec3i{1, 20, 20}, Vec3i{5, 5, 5}}) {
    const DistanceField example = balls(size, 4, 1);
    const SynthesisResult result = synthesizeOptimized(example, sized({20, 20, 8}));
    EXPECT_EQ(result.field.size(), (Vec3i{20, 20, 8}));
    EXPECT_EQ(samplesWrong(example, result), 0);
  }
}

TEST(Optimize, EndsEarlyInEachStageWhenCancelled) {
  const DistanceField example = balls({44, 24, 24}, 4, 1);
  for (const char* stage : {"level 1 of 2", "level 2 of 2", "matching", "seams"}) {
    CancelAfter cancel(1, stage);
    EXPECT_EQ(synthesizeOptimized(example, sized({30, 20, 20}), cancel.progress()).status,
              SynthesisStatus::Cancelled)
        << stage;
    EXPECT_TRUE(cancel.happened()) << stage;
  }
}

TEST(Optimize, RefusesOptionsOutOfRange) {
  const DistanceField example = balls({16, 16, 16}, 4, 1);
  const auto refused = [&](const auto& change, const std::string& word) {
    OptimizeOptions options = sized({16, 16, 16});
    change(options);
    try {
      synthesizeOptimized(example, options);
      return false;
    } catch (const InputError& error) {
      return std::string(error.what()).find(word) != std::string::npos;
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused([](OptimizeOptions&) {}, ""));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.size.z = 0; }, "size"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.size = {30000, 30000, 30000}; }, "memory"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.patch = 2; }, "patch"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.patch = 16; }, "patch"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.levels = 0; }, "levels"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.levels = 9; }, "levels"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.rounds = 0; }, "rounds"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.rounds = 101; }, "rounds"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.truncation = 0; }, "truncation"));
  EXPECT_TRUE(refused([&](OptimizeOptions& o) { o.truncation = nan; }, "truncation"));
  EXPECT_TRUE(refused([](OptimizeOptions& o) { o.completeness = 0; }, "completeness"));
  EXPECT_TRUE(refused([&](OptimizeOptions& o) { o.completeness = nan; }, "completeness"));
  EXPECT_THROW(synthesizeOptimized(DistanceField{}, sized({8, 8, 8})), InputError);
}

TEST(Optimize, WhereAnAxisIsNotStationaryPartsStillHoldTogether) {
  // Hills whose ground rises along x, made twice as long: copied parts cannot all be in place, and
  // must not be stretched sample by sample either.
  DistanceField example = ground({40, 32, 24}, 3);
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    example.values.values()[s] -= 0.2f * static_cast<float>(example.values.ijk(s).x - 20);
  }
  OptimizeOptions options = sized({80, 32, 24});
  options.stationary = StationaryAxes{false, true, false};
  const SynthesisResult result = synthesizeOptimized(example, options);
  std::int64_t seams = 0, faces = 0;
  double low = 0, high = 0;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    const Vec3i p = result.origins.ijk(s);
    (p.x < 40 ? low : high) += result.field.values.values()[s] < 0;
    if (p.x + 1 == 80) continue;
    ++faces;
    seams += result.origins[p + Vec3i{1, 0, 0}].cell() - result.origins[p].cell() != Vec3i{1, 0, 0};
  }
  EXPECT_LT(static_cast<double>(seams) / static_cast<double>(faces), 0.12);
  EXPECT_GT(high, 1.2 * low);  // and the ground still rises
}

TEST(Optimize, RealGroundThatSlopesHasNoCliffs) {
  const std::filesystem::path file = std::filesystem::path(EXEMPLAR_SOURCE_DIR) /
                                     "../shared/data/terrain/rockies_srtmgl3_240x144.pgm";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file << " beside the checkout";
  const HeightMap map = readHeightMap(file, {.cellSize = 90, .heightScale = 0.0205});
  const DistanceField example = heightMapToSdf(map, {.resolution = 64, .halfWidth = 16});
  const auto steepest = [](const DistanceField& field) {
    const Vec3i n = field.size();
    int most = 0;
    for (int j = 0; j < n.y; ++j) {
      for (int i = 0, before = 0; i < n.x; ++i) {
        int height = 0;
        for (int k = 0; k < n.z; ++k) height += field.values(i, j, k) < 0;
        if (i > 0) most = std::max(most, std::abs(height - before));
        before = height;
      }
    }
    return most;
  };
  const Vec3i n = example.size();
  OptimizeOptions options;
  options.size = {2 * n.x, 2 * n.y, n.z};
  const SynthesisResult result = synthesizeOptimized(example, options);
  EXPECT_LE(steepest(result.field), steepest(example) + 1);
}

}  // namespace
}  // namespace exemplar
