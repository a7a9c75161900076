// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/voting/voting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "core/cells.h"
#include "core/error.h"
#include "maps/height_map_file.h"
#include "sdf/height_map.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

VotingOptions sized(const Vec3i& size) { return {.size = size, .rounds = 3}; }

TEST(Voting, MatchesPatchesOnEachLevelAndRound) {
  const DistanceField example = balls({34, 28, 28}, 4, 1);
  const std::int64_t three = synthesizeByVoting(example, sized({34, 30, 20})).matches;
  VotingOptions options = sized({34, 30, 20});
  options.rounds = 6;
  EXPECT_GT(three, 0);
  EXPECT_EQ(synthesizeByVoting(example, options).matches, 2 * three);
}

TEST(Voting, AnyCompletenessAboveZeroIsAccepted) {
  const DistanceField example = balls({16, 16, 16}, 4, 1);
  for (const double completeness : {1e-300, 1e-3, 1e3, 1e300}) {
    VotingOptions options = sized({16, 16, 16});
    options.completeness = completeness;
    const SynthesisResult result = synthesizeByVoting(example, options);
    for (std::size_t s = 0; s < result.origins.count(); ++s) {
      const float there = example.values[result.origins.values()[s].cell()];
      ASSERT_EQ(there < 0, result.field.values.values()[s] < 0);
    }
  }
}

TEST(Voting, StaysAtAStartThatIsTheExample) {
  const DistanceField example = balls({24, 20, 20}, 4, 1);
  VotingOptions options = sized(example.size());
  options.levels = 1;
  options.start = Array3D<Vec3i>(example.size());
  forEachCell(example.size(), [&](const Vec3i& p) { options.start[p] = p; });
  const SynthesisResult result = synthesizeByVoting(example, options);
  EXPECT_EQ(result.field.values, example.values);
  forEachCell(example.size(), [&](const Vec3i& p) { ASSERT_EQ(result.origins[p].cell(), p); });
}

TEST(Voting, RefusesOptionsOutOfRange) {
  const DistanceField example = balls({16, 16, 16}, 4, 1);
  const auto refused = [&](const auto& change, const std::string& word) {
    VotingOptions options = sized({16, 16, 16});
    change(options);
    try {
      synthesizeByVoting(example, options);
      return false;
    } catch (const InputError& error) {
      return std::string(error.what()).find(word) != std::string::npos;
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused([](VotingOptions&) {}, ""));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.size.z = 0; }, "size"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.size = {30000, 30000, 30000}; }, "memory"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.patch = 2; }, "patch"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.patch = 16; }, "patch"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.levels = 0; }, "levels"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.levels = 9; }, "levels"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.rounds = 0; }, "rounds"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.rounds = 101; }, "rounds"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.truncation = 0; }, "truncation"));
  EXPECT_TRUE(refused([&](VotingOptions& o) { o.truncation = nan; }, "truncation"));
  EXPECT_TRUE(refused([](VotingOptions& o) { o.completeness = 0; }, "completeness"));
  EXPECT_TRUE(refused([&](VotingOptions& o) { o.completeness = nan; }, "completeness"));
  // A start is for the coarsest level, whose number has to be said.
  EXPECT_TRUE(refused([](VotingOptions& o) { o.start = Array3D<Vec3i>({16, 16, 16}); }, "start"));
  EXPECT_TRUE(refused(
      [](VotingOptions& o) {
        o.start = Array3D<Vec3i>({16, 16, 16});
        o.levels = 2;
      },
      "start"));
  EXPECT_THROW(synthesizeByVoting(DistanceField{}, sized({8, 8, 8})), InputError);
}

TEST(Voting, WhereAnAxisIsNotStationaryPartsStillHoldTogether) {
  // Hills whose ground rises along x, made twice as long: copied parts cannot all be in place, and
  // must not be stretched sample by sample either.
  DistanceField example = ground({40, 32, 24}, 3);
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    example.values.values()[s] -= 0.2f * static_cast<float>(example.values.ijk(s).x - 20);
  }
  VotingOptions options = sized({80, 32, 24});
  options.stationary = Axes{false, true, false};
  const SynthesisResult result = synthesizeByVoting(example, options);
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

TEST(Voting, RealGroundThatSlopesHasNoCliffs) {
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
  VotingOptions options;
  options.size = {2 * n.x, 2 * n.y, n.z};
  const SynthesisResult result = synthesizeByVoting(example, options);
  EXPECT_LE(steepest(result.field), steepest(example) + 1);
}

}  // namespace
}  // namespace exemplar
