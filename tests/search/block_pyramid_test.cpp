// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "definitions.h"
#include "fields.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using Block = Array3D<double>;

template <class Sample>
Block asDouble(const Array3D<Sample>& samples) {
  Block block(samples.size());
  for (std::size_t i = 0; i < block.count(); ++i) block.data()[i] = samples.data()[i];
  return block;
}

Block randomBlock(int n, std::uint64_t seed) {
  const Random random(seed, 3);
  Block block({n, n, n});
  for (std::size_t i = 0; i < block.count(); ++i) block.data()[i] = random.normal(i);
  return block;
}

// All signs of frequencies that averaging destroys, and one-sample spikes.
Block adversarialBlock(int n, std::uint64_t seed) {
  Block block({n, n, n});
  const Random random(seed, 4);
  for (std::size_t i = 0; i < block.count(); ++i) {
    const Vec3i p = block.ijk(i);
    const int parity = ((seed & 1 ? p.x : 0) + (seed & 2 ? p.y : 0) + (seed & 4 ? p.z : 0)) & 1;
    block.data()[i] = (parity ? 1000 : -1000) + (random.below(64, i) == 0 ? 1e6 : 0);
  }
  return block;
}

// Rounding: each of up to 4096 terms of a mean may be off by 2^-53 of its size, and so may their
// averages.
constexpr double kSlack = 1e-10;

void expectDistancesGrow(const Block& a, const Block& b, const std::string& what) {
  const auto pa = blockPyramid(a), pb = blockPyramid(b);
  for (std::size_t l = 0; l + 1 < pa.size(); ++l)
    EXPECT_LE(levelDistance(pa[l], pb[l]), levelDistance(pa[l + 1], pb[l + 1]) * (1 + kSlack))
        << what << ", level " << l + 1;
}

TEST(Equation2, HoldsAtEveryLevelOfRandomBlocks) {
  for (std::uint64_t trial = 0; trial < 30; ++trial)
    for (int n : {1, 2, 4, 8, 16})
      expectDistancesGrow(randomBlock(n, trial), randomBlock(n, trial + 500), "random");
}

TEST(Equation2, HoldsAtEveryLevelOfSmoothBlocks) {
  const auto a = fields::ballPacking(32, 6, 1), b = fields::terrain(32, 2);
  for (std::uint64_t trial = 0; trial < 30; ++trial)
    for (int n : {4, 8, 16})
      expectDistancesGrow(asDouble(fields::octantQuery(a, {n, n, n}, trial).samples),
                          asDouble(fields::octantQuery(b, {n, n, n}, trial).samples), "smooth");
}

TEST(Equation2, HoldsAtEveryLevelOfAdversarialBlocks) {
  for (std::uint64_t a = 0; a < 8; ++a)
    for (std::uint64_t b = 0; b < 8; ++b)
      for (int n : {2, 4, 8}) {
        expectDistancesGrow(adversarialBlock(n, a), adversarialBlock(n, b), "checkerboards");
        expectDistancesGrow(adversarialBlock(n, a), Block({n, n, n}, 3), "against a constant");
      }
}

TEST(Equation2, IsTightForBlocksThatDifferByAConstantInEachCell) {
  const Block a = randomBlock(8, 1);
  Block b = a;
  for (double& v : b.values()) v += 0.75;
  const auto pa = blockPyramid(a), pb = blockPyramid(b);
  for (std::size_t l = 0; l < pa.size(); ++l)
    EXPECT_NEAR(levelDistance(pa[l], pb[l]), 0.5625, kSlack);
}

// With cells known in full only, a level's part of the sum is still at most the next one's.
TEST(Equation2, HoldsForTheCellsKnownInFullOfMaskedBlocks) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    const int n = 8;
    const auto known = trial % 2 ? fields::withoutOctant({n, n, n}, int(trial / 2 % 8))
                                 : fields::randomMask({n, n, n}, 0.97, trial);
    const auto a = blockPyramid(randomBlock(n, trial)), b = blockPyramid(randomBlock(n, trial + 9));
    double previous = 0;
    for (std::size_t l = 0; l < a.size(); ++l) {
      const int cells = a[l].size().x, side = n / cells;
      double sum = 0;  // of squared differences over the samples of full cells
      for (std::size_t c = 0; c < a[l].count(); ++c) {
        const Vec3i first = a[l].ijk(c) * side;
        bool full = true;
        for (int s = 0; s < side * side * side; ++s)
          full = full &&
                 known(first.x + s % side, first.y + s / side % side, first.z + s / side / side);
        const double d = a[l].data()[c] - b[l].data()[c];
        if (full) sum += d * d * side * side * side;
      }
      EXPECT_LE(previous, sum * (1 + kSlack));
      previous = sum;
    }
  }
}

TEST(Equation2, TheCheckerSeesAViolation) {
  // Subsampling by taking a corner instead of averaging breaks the bound.
  Block a({2, 2, 2}, 0), b({2, 2, 2}, 0);
  b(0, 0, 0) = 1;
  EXPECT_GT(levelDistance(Block({1, 1, 1}, a(0, 0, 0)), Block({1, 1, 1}, b(0, 0, 0))),
            levelDistance(a, b));
}

TEST(Equation3, HoldsOnTrueDistanceFields) {
  std::vector<Array3D<float>> distances;
  for (std::uint64_t seed = 0; seed < 3; ++seed)
    for (auto kind : {fields::Shape::Ball, fields::Shape::Torus, fields::Shape::Box})
      distances.push_back(fields::shape(40, kind, seed));
  Array3D<float> both = distances[0];
  for (std::size_t i = 0; i < both.count(); ++i)
    both.data()[i] = std::min({both.data()[i], distances[1].data()[i], distances[2].data()[i]});
  distances.push_back(std::move(both));
  distances.push_back(fields::ballPacking(40, 7, 1));

  double tightest = 0;
  for (std::uint64_t trial = 0; trial < 400; ++trial) {
    const Random random(trial, 8);
    const int n = 2 << random.below(4, 0);
    const auto pick = [&](std::uint32_t draw) -> const Array3D<float>& {
      return distances[random.below(std::uint32_t(distances.size()), 1, draw)];
    };
    const auto a = blockPyramid(asDouble(fields::octantQuery(pick(0), {n, n, n}, trial).samples));
    const auto b =
        blockPyramid(asDouble(fields::octantQuery(pick(1), {n, n, n}, trial + 7777).samples));
    for (std::size_t coarse = 0; coarse + 1 < a.size(); ++coarse)
      for (std::size_t fine = coarse + 1; fine < a.size(); ++fine) {
        // Cells of the fine level lie `spacing` samples apart; averages are as Lipschitz as
        // samples.
        const double spacing = double(n) / a[fine].size().x;
        const double epsilon =
            lipschitzEpsilon(a[fine].size().x / a[coarse].size().x, 1.0 * spacing);
        const double rise = levelDistance(a[fine], b[fine]) - levelDistance(a[coarse], b[coarse]);
        // Samples are floats: their differences may exceed the Lipschitz constant by a few ulps.
        EXPECT_LE(rise, epsilon * (1 + 1e-4));
        tightest = std::max(tightest, rise / epsilon);
      }
  }
  // The test would say nothing were the bound never approached.
  EXPECT_GT(tightest, 0.15);
}

TEST(Equation3, FailsOnAFieldThatIsNoDistance) {
  // Checkerboards: averages agree, samples do not.
  const auto a = blockPyramid(adversarialBlock(8, 1)), b = blockPyramid(adversarialBlock(8, 2));
  EXPECT_GT(levelDistance(a[3], b[3]), levelDistance(a[0], b[0]) + lipschitzEpsilon(8, 1.0));
}

TEST(Equation3, HoldsOnAnyFieldWithMeasuredDeviations) {
  for (const auto& source : {fields::noise({20, 20, 20}, 1), fields::noise({20, 20, 20}, 2, 2),
                             fields::quantized(fields::terrain(20, 3), 5)}) {
    const SlidingPyramid pyramid(source, 8);
    const auto deviations = pyramid.cellDeviations();
    for (std::uint64_t trial = 0; trial < 100; ++trial) {
      const auto a = blockPyramid(asDouble(fields::octantQuery(source, {8, 8, 8}, trial).samples));
      const auto b =
          blockPyramid(asDouble(fields::octantQuery(source, {8, 8, 8}, trial + 200).samples));
      for (int scale = 1; scale <= 3; ++scale) {
        const double s = 2 * deviations[scale];
        EXPECT_LE(levelDistance(a[3], b[3]),
                  levelDistance(a[3 - scale], b[3 - scale]) + s * s + 1e-9);
      }
    }
  }
}

TEST(SlidingPyramid, HoldsTheAverageOfEveryCell) {
  const auto source = fields::noise({19, 11, 14}, 5);
  const SlidingPyramid pyramid(source, 8);
  ASSERT_EQ(pyramid.scales(), 3);
  EXPECT_EQ(pyramid.averages(0), source);
  for (int scale = 0; scale <= 3; ++scale) {
    const int side = 1 << scale;
    for (int k = 0; k + side <= 14; ++k)
      for (int j = 0; j + side <= 11; ++j)
        for (int i = 0; i + side <= 19; ++i) {
          const auto cell = fields::block(source, {i, j, k}, {side, side, side});
          int sum = 0;
          for (auto v : cell.values()) sum += v;
          const int average = pyramid.averages(scale)(i, j, k);
          ASSERT_EQ(average, int(std::floor(double(sum) / double(cell.count()) + 0.5)));
          const SumRange range = cellSums(average, scale, 0);
          EXPECT_LE(range.low, sum);
          EXPECT_GE(range.high, sum);
        }
  }
}

TEST(SlidingPyramid, SumRangesHoldForSubsampledFields) {
  const auto source = fields::noise({16, 16, 16}, 6);
  const SlidingPyramid pyramid(source, 16);
  for (int finest = 1; finest < 4; ++finest)
    for (int scale = finest; scale <= 4; ++scale) {
      const int cells = 1 << (scale - finest), step = 1 << finest;
      for (int at = 0; at + (1 << scale) <= 16; ++at) {
        int sum = 0;
        for (int c = 0; c < cells * cells * cells; ++c)
          sum += pyramid.averages(finest)(at + c % cells * step, at + c / cells % cells * step,
                                          at + c / cells / cells * step);
        const SumRange range = cellSums(pyramid.averages(scale)(at, at, at), scale, finest);
        EXPECT_LE(range.low, sum);
        EXPECT_GE(range.high, sum);
      }
    }
}

TEST(SlidingPyramid, IsTheSameAtOneAndEightThreads) {
  const auto source = fields::noise({40, 33, 37}, 7);
  const auto make = [&] { return SlidingPyramid(source, 16).averages(4); };
  EXPECT_EQ(testing::onThreads(1, make), testing::onThreads(8, make));
}

TEST(BlockLevels, RefusesSizesThatAreNoPowersOfTwo) {
  EXPECT_EQ(blockLevels(1), 0);
  EXPECT_EQ(blockLevels(32), 5);
  for (int size : {0, -8, 3, 12, 512}) EXPECT_THROW(blockLevels(size), InputError);
}

}  // namespace
}  // namespace exemplar
