// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What quilting and voting both promise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "synth/geometry/quilting/quilting.h"
#include "synth/geometry/seams/broken_pieces.h"
#include "synth/geometry/seams/even_seams.h"
#include "synth/geometry/voting/voting.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

SynthesisResult byQuilting(const DistanceField& example, const Vec3i& size, std::uint64_t seed,
                           const Progress& progress) {
  return synthesizeByQuilting(example, {.size = size, .seed = seed}, progress);
}
SynthesisResult byVoting(const DistanceField& example, const Vec3i& size, std::uint64_t seed,
                         const Progress& progress) {
  return synthesizeByVoting(example, {.size = size, .seed = seed, .rounds = 3}, progress);
}

class Engines : public ::testing::TestWithParam<decltype(&byQuilting)> {};
INSTANTIATE_TEST_SUITE_P(All, Engines, ::testing::Values(&byQuilting, &byVoting),
                         [](const auto& tested) {
                           return std::string(tested.param == &byQuilting ? "Quilting" : "Voting");
                         });

/// The samples whose side, or away from seams whose value, is not the example's at their origin.
/// `away`, where not null, receives how many are away from seams.
std::int64_t samplesWrong(const DistanceField& example, const SynthesisResult& result,
                          std::int64_t* away = nullptr) {
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
  if (away) *away = compared;
  return wrong;
}

TEST_P(Engines, SamplesAreTheExamplesAtTheirOriginsAwayFromSeams) {
  std::int64_t away = 0, all = 0;
  for (const DistanceField& example : {balls({28, 28, 28}, 4, 1), ground({32, 32, 20}, 2)}) {
    const SynthesisResult result = GetParam()(example, {34, 30, 20}, 0, {});
    EXPECT_EQ(result.field.size(), (Vec3i{34, 30, 20}));
    EXPECT_EQ(samplesWrong(example, result, &away), 0);
    all += away;
  }
  EXPECT_GT(all, 100);
}

TEST_P(Engines, SameSeedSameBytesAtAnyNumberOfThreads) {
  const DistanceField example = balls({32, 32, 32}, 4, 1);
  SynthesisResult one, eight;
  withThreads(1, [&] { one = GetParam()(example, {40, 36, 32}, 0, {}); });
  withThreads(8, [&] { eight = GetParam()(example, {40, 36, 32}, 0, {}); });
  EXPECT_EQ(one.origins, eight.origins);
  EXPECT_EQ(one.field.values, eight.field.values);
}

TEST_P(Engines, AnotherSeedGivesAnotherResult) {
  const DistanceField example = balls({28, 28, 28}, 4, 1);
  EXPECT_NE(GetParam()(example, {28, 28, 28}, 0, {}).field.values,
            GetParam()(example, {28, 28, 28}, 1, {}).field.values);
}

TEST_P(Engines, AConstantExampleGivesAConstant) {
  for (const float value : {-3.0f, 5.5f}) {
    const SynthesisResult result = GetParam()(constant({16, 16, 16}, value), {21, 18, 17}, 0, {});
    for (const float v : result.field.values.values()) ASSERT_EQ(v, value);
  }
}

TEST_P(Engines, BallsStayWhole) {
  // Every piece of the result has at least half the samples of the example's smallest: what
  // dropBrokenPieces would clear away is not there any more.
  const DistanceField example = balls({32, 32, 32}, 4, 1);
  SynthesisResult result = GetParam()(example, {36, 36, 36}, 0, {});
  EXPECT_EQ(dropBrokenPieces(example, result.origins), 0);
}

TEST_P(Engines, SidesInAirStayInAir) {
  // One ball with air all around, made twice as long: nothing solid may touch the box.
  DistanceField example = constant({24, 24, 24}, 0);
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    const Vec3d d = cast<double>(example.values.ijk(s)) - Vec3d{11.5, 11.5, 11.5};
    example.values.values()[s] = static_cast<float>(length(d)) - 8;
  }
  const Vec3i size{48, 24, 24};
  const SynthesisResult result = GetParam()(example, size, 0, {});
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

TEST_P(Engines, GroundStaysGround) {
  const DistanceField example = ground({32, 32, 24}, 1);
  const SynthesisResult result = GetParam()(example, {48, 40, 24}, 0, {});
  for (int j = 0; j < 40; ++j) {
    for (int i = 0; i < 48; ++i) {
      ASSERT_LT(result.field.values(i, j, 0), 0);
      ASSERT_GT(result.field.values(i, j, 23), 0);
    }
  }
}

TEST_P(Engines, MakesSmallAndOddSizes) {
  const DistanceField example = balls({22, 19, 17}, 4, 1);
  for (const Vec3i& size : {Vec3i{7, 7, 7}, Vec3i{1, 1, 1}, Vec3i{3, 21, 9}, Vec3i{31, 8, 13}}) {
    const SynthesisResult result = GetParam()(example, size, 0, {});
    EXPECT_EQ(result.field.size(), size);
    EXPECT_EQ(samplesWrong(example, result), 0);
  }
}

TEST_P(Engines, AcceptThinExamples) {
  for (const Vec3i& size : {Vec3i{24, 24, 2}, Vec3i{1, 20, 20}, Vec3i{5, 5, 5}}) {
    const DistanceField example = balls(size, 4, 1);
    const SynthesisResult result = GetParam()(example, {20, 20, 8}, 0, {});
    EXPECT_EQ(result.field.size(), (Vec3i{20, 20, 8}));
    EXPECT_EQ(samplesWrong(example, result), 0);
  }
}

TEST_P(Engines, ReportTheirProgressInOrderAndToTheEnd) {
  double last = 0;
  int reports = 0;
  const Progress progress([&](std::string_view, double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++reports;
  });
  GetParam()(balls({44, 24, 24}, 4, 1), {60, 30, 24}, 0, progress);
  EXPECT_GT(reports, 5);
  EXPECT_GT(last, 0.8);
}

TEST_P(Engines, StopInEachStageWhenCancelled) {
  const DistanceField example = balls({44, 24, 24}, 4, 1);
  for (const char* stage : {"level 1 of 2", "level 2 of 2", "matching", "seams", "pieces"}) {
    CancelAfter cancel(1, stage);
    EXPECT_THROW(GetParam()(example, {30, 20, 20}, 0, cancel.progress()), Cancelled) << stage;
    EXPECT_TRUE(cancel.happened()) << stage;
  }
}

}  // namespace
}  // namespace exemplar
