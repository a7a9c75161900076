// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/random.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

using namespace testing;

BlocksOptions sized(const Vec3i& size, int block = 8) {
  BlocksOptions options;
  options.size = size;
  options.block = block;
  return options;
}

/// White noise: no part of it continues as another does.
DistanceField noise(const Vec3i& size) {
  DistanceField field = constant(size, 0);
  const Random random(5);
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    field.values.values()[s] = static_cast<float>(random.uniform(-4, 4, s));
  }
  return field;
}

TEST(Blocks, SamplesAreTheExamplesAtTheirOrigins) {
  for (const DistanceField& example : {balls({32, 32, 32}, 4, 1), ground({32, 32, 16}, 2)}) {
    for (const BlockSeeding seeding : {BlockSeeding::Random, BlockSeeding::Masked}) {
      BlocksOptions options = sized({40, 40, 24});
      options.seeding = seeding;
      const SynthesisResult result = synthesizeBlocks(example, options);
      EXPECT_EQ(result.field.size(), options.size);
      EXPECT_EQ(result.field.voxelSize, example.voxelSize);
      EXPECT_GT(result.matches, 0);
      EXPECT_EQ(samplesNotCopied(example, result), 0);
    }
  }
}

TEST(Blocks, ASampleThatIsNotCopiedIsSeen) {
  const DistanceField example = balls({16, 16, 16}, 4, 1);
  SynthesisResult result = synthesizeBlocks(example, sized({16, 16, 16}));
  result.field.values(3, 4, 5) += 1;
  result.origins(0, 0, 0) = Origin({16, 0, 0});
  EXPECT_EQ(samplesNotCopied(example, result), 2);
}

TEST(Blocks, TreeAndScanFindTheSame) {
  const DistanceField examples[] = {balls({32, 24, 20}, 4, 3), ground({32, 32, 16}, 4),
                                    noise({20, 20, 20})};
  for (const DistanceField& example : examples) {
    for (const BlockSeeding seeding : {BlockSeeding::Random, BlockSeeding::Masked}) {
      BlocksOptions options = sized({28, 28, 16});
      options.seed = 9;
      options.seeding = seeding;
      options.search = BlockSearch::Tree;
      const SynthesisResult byTree = synthesizeBlocks(example, options);
      options.search = BlockSearch::Scan;
      const SynthesisResult byScan = synthesizeBlocks(example, options);
      options.search = BlockSearch::Index;
      const SynthesisResult byIndex = synthesizeBlocks(example, options);
      EXPECT_EQ(byTree.origins, byScan.origins);
      EXPECT_EQ(byIndex.origins, byScan.origins);
      EXPECT_EQ(byTree.matches, byScan.matches);
    }
  }
}

TEST(Blocks, SameSeedSameBytesAtAnyNumberOfThreads) {
  const DistanceField example = balls({24, 24, 24}, 4, 1);
  for (const BlockSearch search : {BlockSearch::Index, BlockSearch::Scan, BlockSearch::Tree}) {
    BlocksOptions options = sized({32, 32, 24});
    options.search = search;
    SynthesisResult one, eight;
    withThreads(1, [&] { one = synthesizeBlocks(example, options); });
    withThreads(8, [&] { eight = synthesizeBlocks(example, options); });
    EXPECT_EQ(one.origins, eight.origins);
    EXPECT_EQ(one.field.values, eight.field.values);
  }
}

TEST(Blocks, AnotherSeedGivesAnotherResult) {
  const DistanceField example = balls({32, 32, 32}, 4, 1);
  for (const BlockSeeding seeding : {BlockSeeding::Random, BlockSeeding::Masked}) {
    BlocksOptions options = sized({32, 32, 32});
    options.seeding = seeding;
    const Origins first = synthesizeBlocks(example, options).origins;
    options.seed = 1;
    EXPECT_NE(first, synthesizeBlocks(example, options).origins);
  }
}

TEST(Blocks, AConstantExampleGivesAConstant) {
  for (const float value : {-3.0f, 0.0f, 5.5f}) {
    const SynthesisResult result =
        synthesizeBlocks(constant({16, 16, 16}, value), sized({21, 18, 17}));
    for (const float v : result.field.values.values()) ASSERT_EQ(v, value);
  }
}

TEST(Blocks, AnySizeIsMade) {
  const DistanceField example = balls({24, 24, 24}, 4, 1);
  for (const Vec3i& size :
       {Vec3i{1, 1, 1}, Vec3i{5, 1, 9}, Vec3i{17, 33, 8}, Vec3i{31, 2, 23}, Vec3i{9, 9, 9}}) {
    const SynthesisResult result = synthesizeBlocks(example, sized(size));
    EXPECT_EQ(result.field.size(), size);
    EXPECT_EQ(result.origins.size(), size);
    EXPECT_EQ(samplesNotCopied(example, result), 0);
  }
}

TEST(Blocks, AnExampleMayBeThinnerThanABlock) {
  for (const Vec3i& size : {Vec3i{24, 24, 3}, Vec3i{2, 24, 24}, Vec3i{1, 16, 1}}) {
    const DistanceField example = balls(size, 4, 1);
    for (const BlockSearch search : {BlockSearch::Index, BlockSearch::Scan, BlockSearch::Tree}) {
      BlocksOptions options = sized({26, 26, 10});
      options.search = search;
      const SynthesisResult result = synthesizeBlocks(example, options);
      EXPECT_EQ(samplesNotCopied(example, result), 0);
    }
  }
}

TEST(Blocks, GroundStaysGround) {
  const DistanceField example = ground({32, 32, 24}, 1);
  for (const BlockSearch search : {BlockSearch::Index, BlockSearch::Scan, BlockSearch::Tree}) {
    BlocksOptions options = sized({48, 40, 24});
    options.search = search;
    const SynthesisResult result = synthesizeBlocks(example, options);
    for (std::size_t s = 0; s < result.origins.count(); ++s) {
      ASSERT_EQ(result.origins.values()[s].k, result.origins.ijk(s).z);
    }
  }
  // Where there is no ground, blocks come from any height.
  const DistanceField packing = balls({32, 32, 24}, 4, 1);
  const SynthesisResult result = synthesizeBlocks(packing, sized({32, 32, 24}));
  std::int64_t moved = 0;
  for (std::size_t s = 0; s < result.origins.count(); ++s) {
    moved += result.origins.values()[s].k != result.origins.ijk(s).z;
  }
  EXPECT_GT(moved, volume(result.field.size()) / 4);
}

TEST(Blocks, WhatRepeatsGoesOn) {
  // The example holds every shift of its period, so whatever is known of a block has an exact
  // continuation in it; 0.05 is some steps of the 256 levels that blocks are compared in (8 / 255).
  const DistanceField example = waves({32, 32, 32}, 8);
  BlocksOptions options = sized({48, 48, 48});
  options.seeding = BlockSeeding::Masked;
  const SynthesisResult result = synthesizeBlocks(example, options);
  EXPECT_LT(brokenFaces(example, result.field, result.origins, 0.05f), 0.02);

  // The checker sees what does not continue.
  Origins shuffled = result.origins;
  DistanceField field = result.field;
  const Random random(1);
  for (std::size_t s = 0; s < shuffled.count(); ++s) {
    shuffled.values()[s] = result.origins.values()[random.below(1000, s)];
    field.values.values()[s] = example.values[shuffled.values()[s].cell()];
  }
  EXPECT_GT(brokenFaces(example, field, shuffled, 0.05f), 0.5);
}

TEST(Blocks, CancelsAtOnceAndLater) {
  const DistanceField example = balls({32, 32, 32}, 4, 1);
  for (const int reports : {1, 2, 9}) {
    CancelAfter cancel(reports);
    EXPECT_THROW(synthesizeBlocks(example, sized({40, 40, 40}), cancel.progress()), Cancelled);
    EXPECT_TRUE(cancel.happened());
  }
}

TEST(Blocks, RefusesOptionsOutOfRange) {
  const DistanceField example = balls({32, 32, 32}, 4, 1);
  const auto refused = [&](const auto& change, const std::string& word) {
    BlocksOptions options = sized({32, 32, 32});
    change(options);
    try {
      synthesizeBlocks(example, options);
      return false;
    } catch (const InputError& error) {
      return std::string(error.what()).find(word) != std::string::npos;
    }
  };
  EXPECT_FALSE(refused([](BlocksOptions&) {}, ""));
  EXPECT_TRUE(refused([](BlocksOptions& o) { o.size.y = 0; }, "`size`"));
  EXPECT_TRUE(refused([](BlocksOptions& o) { o.size.x = -4; }, "`size`"));
  for (const int block : {0, 1, 3, 12, 512}) {
    EXPECT_TRUE(refused([&](BlocksOptions& o) { o.block = block; }, "block"));
  }
  EXPECT_TRUE(refused([](BlocksOptions& o) { o.block = 64; }, "block"));  // longer than the example
  EXPECT_TRUE(refused([](BlocksOptions& o) { o.iterations = 0; }, "iterations"));
  EXPECT_TRUE(refused([](BlocksOptions& o) { o.iterations = 9; }, "iterations"));
  EXPECT_TRUE(refused([](BlocksOptions& o) { o.truncation = 0; }, "truncation"));
  EXPECT_TRUE(
      refused([](BlocksOptions& o) { o.truncation = std::numeric_limits<double>::quiet_NaN(); },
              "truncation"));
  EXPECT_TRUE(refused([](BlocksOptions& o) { o.size = {30000, 30000, 30000}; }, "memory"));
  EXPECT_THROW(synthesizeBlocks(DistanceField{}, sized({8, 8, 8})), InputError);
}

}  // namespace
}  // namespace exemplar
