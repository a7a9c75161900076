// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/cell_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fields.h"
#include "search/block_sum.h"
#include "tests/threads.h"

namespace exemplar {
namespace {

using Levels = Array3D<std::uint8_t>;

TEST(OrthonormalPolynomials, AreOrthonormal) {
  for (int length = 1; length <= 33; ++length) {
    const auto p = orthonormalPolynomials(length, 3);
    ASSERT_EQ(p.size(), std::size_t(std::min(length, 3)));
    for (std::size_t a = 0; a < p.size(); ++a)
      for (std::size_t b = 0; b < p.size(); ++b) {
        double product = 0;
        for (int i = 0; i < length; ++i) product += p[a][i] * p[b][i];
        EXPECT_NEAR(product, a == b ? 1 : 0, 1e-12);
      }
  }
}

TEST(CellLayout, CutsABlockIntoCells) {
  for (const Vec3i& block : {Vec3i{8, 8, 8}, Vec3i{7, 5, 9}, Vec3i{1, 6, 3}, Vec3i{1, 1, 1}})
    for (bool equal : {false, true}) {
      const CellLayout layout(block, equal);
      Levels covered(block, 0);
      for (int c = 0; c < 8; ++c) {
        if (!layout.there(c)) continue;
        if (equal) {
          EXPECT_EQ(layout.size[c], layout.size[0]);
        }
        for (std::int64_t s = 0; s < volume(layout.size[c]); ++s) {
          const Vec3i size = layout.size[c];
          ++covered[layout.first[c] +
                    Vec3i{int(s) % size.x, int(s) / size.x % size.y, int(s) / size.x / size.y}];
        }
      }
      for (auto times : covered.values()) {
        EXPECT_LE(times, 1);
        if (!equal) {
          EXPECT_EQ(times, 1);
        }
      }
    }
}

struct Case {
  const char* name;
  Levels source, target;
};

std::vector<Case> cases() {
  std::vector<Case> result;
  result.push_back({"balls", fields::quantized(fields::ballPacking(26, 5, 1), 5),
                    fields::quantized(fields::ballPacking(26, 5, 2), 5)});
  result.push_back({"noise", fields::noise({22, 21, 20}, 1), fields::noise({22, 22, 22}, 2)});
  result.push_back(
      {"two levels", fields::noise({20, 20, 20}, 1, 2), fields::noise({20, 20, 20}, 2)});
  result.push_back({"constant", Levels({18, 18, 18}, 7), fields::noise({18, 18, 18}, 2)});
  return result;
}

Vec3d slopesOf(const Levels& field) {
  Vec3d slopes;
  for (std::size_t s = 0; s < field.count(); ++s)
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i next = field.ijk(s);
      ++next[axis];
      if (field.contains(next))
        slopes[axis] = std::max(slopes[axis], std::abs(double(field[next]) - field.data()[s]));
    }
  return slopes;
}

// The bound that the index rests on: gaps between a query's ranges and a block's numbers, squared
// and summed, against the sum of squared differences of their known samples.
TEST(CellFeatures, GapsNeverExceedSumsOfSquaredDifferences) {
  double tightest = 0;
  for (const Case& c : cases())
    for (const Vec3i& block : {Vec3i{8, 8, 8}, Vec3i{7, 5, 6}, Vec3i{1, 9, 4}, Vec3i{2, 2, 2}})
      for (bool equal : {false, true}) {
        const CellLayout layout(block, equal);
        const Levels* const sources[] = {&c.source};
        const auto [low, high] = std::ranges::minmax(c.source.values());
        const CellFeatures features(layout, std::span<const Levels* const>(sources), low, high);
        std::array<Array3D<CellFeatures::Numbers>, 8> numbers;
        for (int n = 0; n < 8; ++n)
          if (layout.there(n)) numbers[n] = features.ofSource(c.source, layout.size[n]);
        for (std::uint64_t trial = 0; trial < 30; ++trial) {
          BlockQuery<std::uint8_t> query = fields::octantQuery(c.target, block, trial);
          if (trial % 3 == 1) query.known = {};
          if (trial % 3 == 2)
            query.known = fields::randomMask(block, Random(trial).uniform(0.2, 1, 0), trial);
          const auto q = features.ofQuery(query, slopesOf(c.source));
          const BlockSum<std::uint8_t> sums(query, c.source.size());
          const Vec3i places = blockPositions(c.source.size(), block);
          for (std::uint64_t sample = 0; sample < 40; ++sample) {
            const Random random(trial, 31);
            const Vec3i p{int(random.below(places.x, sample, 0)),
                          int(random.below(places.y, sample, 1)),
                          int(random.below(places.z, sample, 2))};
            double gaps = 0;
            for (int n = 0; n < 8; ++n) {
              if (!layout.there(n)) continue;
              for (int f = 0; f < CellFeatures::kCount; ++f) {
                const int number = numbers[n][p + layout.first[n]][f];
                const int d = f == 0 ? 0 : kernels::detail(n, f - 1);
                const int from = f == 0 ? q.meanLow[n] : q.detailLow[d];
                const int to = f == 0 ? q.meanHigh[n] : q.detailHigh[d];
                const double weight = f == 0 ? q.meanWeight[n] / 65536.0 : 1;
                const double gap = weight * std::max({0, number - features.margin() - to,
                                                      from - number - features.margin()});
                gaps += gap * gap;
              }
            }
            const double sum =
                double(sums.sum(c.source.data() + c.source.index(p), std::int64_t{1} << 60)) *
                features.scale() * features.scale();
            EXPECT_LE(gaps, sum * (1 + 1e-9)) << c.name;
            if (sum > 0) tightest = std::max(tightest, gaps / sum);
          }
        }
      }
  EXPECT_GT(tightest, 0.9);  // or the test says nothing
}

TEST(CellFeatures, ABlockLiesInItsOwnRanges) {
  const Case c = cases()[0];
  const CellLayout layout({9, 8, 6}, false);
  const Levels* const sources[] = {&c.source};
  const CellFeatures features(layout, std::span<const Levels* const>(sources), 0, 255);
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    const Vec3i p{int(trial % 5), int(trial % 7), int(trial % 3)};
    const BlockQuery<std::uint8_t> query{fields::block(c.source, p, {9, 8, 6}), {}};
    const auto q = features.ofQuery(query, {});
    for (int n = 0; n < 8; ++n) {
      const auto numbers = features.ofSource(c.source, layout.size[n])[p + layout.first[n]];
      EXPECT_LE(q.meanLow[n], numbers[0] + features.margin());
      EXPECT_GE(q.meanHigh[n], numbers[0] - features.margin());
      // Ranges of whole cells are as narrow as rounding allows.
      EXPECT_LE(q.meanHigh[n] - q.meanLow[n], 2);
    }
  }
}

TEST(CellFeatures, AreTheSameAtOneAndEightThreads) {
  const Case c = cases()[0];
  const CellLayout layout({8, 8, 8}, true);
  const Levels* const sources[] = {&c.source};
  const CellFeatures features(layout, std::span<const Levels* const>(sources), 0, 255);
  const auto make = [&] { return features.ofSource(c.source, layout.size[0]); };
  EXPECT_EQ(testing::onThreads(1, make), testing::onThreads(8, make));
}

TEST(MeanShift, BoundsTheMeansOfFieldsOfKnownSlopes) {
  double tightest = 0;
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const Random random(trial, 41);
    const Vec3i size{1 + int(random.below(7, 0)), 1 + int(random.below(7, 1)),
                     1 + int(random.below(7, 2))};
    auto known = fields::randomMask(size, random.uniform(0.05, 1, 3), trial);
    if (trial % 2)
      for (std::size_t s = 0; s < known.count(); ++s)  // half of it, across
        known.data()[s] = known.ijk(s).x + known.ijk(s).y > int(random.below(8, 4));
    // Slopes are drawn, then a field that keeps them: a plane, or ramps up and down.
    const Vec3d slopes{random.uniform(5), random.uniform(6), random.uniform(7)};
    double all = 0, some = 0, count = 0;
    for (std::size_t s = 0; s < known.count(); ++s) {
      const Vec3i p = known.ijk(s);
      const double v = slopes.x * (trial % 3 ? p.x : std::abs(p.x - 2)) + slopes.y * p.y -
                       slopes.z * std::abs(p.z - 3);
      all += v / double(known.count());
      if (known.data()[s]) {
        some += v;
        ++count;
      }
    }
    const double bound = meanShift(known, {0, 0, 0}, size, slopes);
    if (count == 0) {
      EXPECT_TRUE(std::isinf(bound));
      continue;
    }
    EXPECT_LE(std::abs(some / count - all), bound + 1e-12);
    if (bound > 0) tightest = std::max(tightest, std::abs(some / count - all) / bound);
  }
  EXPECT_GT(tightest, 0.95);
}

TEST(MeanShift, IsZeroWhereAllIsKnown) {
  EXPECT_NEAR(meanShift(Levels({4, 3, 5}, 1), {0, 0, 0}, {4, 3, 5}, {9, 9, 9}), 0, 1e-12);
}

}  // namespace
}  // namespace exemplar
