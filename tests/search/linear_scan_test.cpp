// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/linear_scan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "fft_correlation.h"
#include "fields.h"

namespace exemplar {
namespace {

// All blocks by the yardstick alone, nearest first, ties by index.
template <class Sample>
std::vector<BlockMatch> allBlocks(const Array3D<Sample>& source, const BlockQuery<Sample>& query) {
  const Vec3i positions = blockPositions(source.size(), query.samples.size());
  std::vector<BlockMatch> all;
  for (int k = 0; k < positions.z; ++k)
    for (int j = 0; j < positions.y; ++j)
      for (int i = 0; i < positions.x; ++i)
        all.push_back({{i, j, k}, blockDistance(source, {i, j, k}, query), 0});
  std::ranges::stable_sort(all, {}, &BlockMatch::distance);
  return all;
}

TEST(LinearScan, FindsWhatTheYardstickFinds) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    const Random random(trial, 1);
    const Vec3i size{1 + int(random.below(9, 0)), 1 + int(random.below(6, 1)),
                     1 + int(random.below(6, 2))};
    const Vec3i sourceSize = size + Vec3i{int(random.below(7, 3)), 3, int(random.below(5, 4))};
    // Two levels only in some trials: many ties.
    const auto source = fields::noise(sourceSize, trial, trial % 2 ? 2 : 256);
    BlockQuery<std::uint8_t> query{fields::noise(size, trial + 99, trial % 2 ? 2 : 256), {}};
    if (trial % 3) query.known = fields::randomMask(size, random.uniform(5), trial);
    const auto expected = allBlocks(source, query);
    EXPECT_EQ(linearScan(source, query), expected.front());

    const auto few = linearScanNearest(source, query, 7);
    ASSERT_EQ(few.size(), std::min<std::size_t>(7, expected.size()));
    EXPECT_TRUE(std::ranges::equal(few, std::span(expected).first(few.size())));

    const auto near = linearScanWithin(source, query, 0.25, 1000000);
    const auto count = std::ranges::count_if(expected, [&](const BlockMatch& m) {
      return m.distance <= 1.25 * expected.front().distance;
    });
    ASSERT_EQ(near.size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(std::ranges::equal(near, std::span(expected).first(near.size())));
  }
}

TEST(LinearScan, FindsWhatTheYardstickFindsInFloats) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const auto source = fields::shape(16, fields::Shape::Torus, trial);
    const auto other = fields::shape(16, fields::Shape::Ball, trial);
    auto query = fields::octantQuery(other, {5, 6, 7}, trial);
    const auto expected = allBlocks(source, query);
    EXPECT_EQ(linearScan(source, query), expected.front());
    EXPECT_TRUE(
        std::ranges::equal(linearScanNearest(source, query, 20), std::span(expected).first(20)));
  }
}

TEST(LinearScan, PrefersTheLowestIndexAmongTies) {
  const Array3D<std::uint8_t> flat({9, 9, 9}, 77);
  const BlockQuery<std::uint8_t> query{Array3D<std::uint8_t>({4, 4, 4}, 80), {}};
  EXPECT_EQ(linearScan(flat, query), (BlockMatch{{0, 0, 0}, 9, 0}));
  const auto nearest = linearScanNearest(flat, query, 8);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(nearest[i].position, (Vec3i{i, 0, 0}));
  EXPECT_EQ(nearest[6].position, (Vec3i{0, 1, 0}));
}

TEST(LinearScan, AgreesWithCorrelationInTheFrequencyDomain) {
  const auto source = fields::quantized(fields::ballPacking(32, 5, 1), 5);
  const auto target = fields::quantized(fields::ballPacking(32, 5, 2), 5);
  FftCorrelation fft(source);
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    const auto query = fields::octantQuery(target, {8, 8, 8}, trial);
    EXPECT_EQ(linearScan(source, query), fft.findBest(query));
  }
}

TEST(LinearScan, NothingKnownMatchesTheFirstBlock) {
  const auto source = fields::noise({6, 6, 6}, 1);
  BlockQuery<std::uint8_t> query{fields::noise({3, 3, 3}, 2), Array3D<std::uint8_t>({3, 3, 3}, 0)};
  EXPECT_EQ(linearScan(source, query), BlockMatch{});
}

TEST(LinearScan, RefusesOptionsOutOfRange) {
  const auto source = fields::noise({6, 6, 6}, 1);
  const BlockQuery<std::uint8_t> query{fields::noise({3, 3, 3}, 2), {}};
  EXPECT_THROW(linearScanNearest(source, query, 0), InputError);
  EXPECT_THROW(linearScanWithin(source, query, -0.1, 5), InputError);
  EXPECT_THROW(linearScanWithin(source, query, 0.1, 0), InputError);
  EXPECT_THROW(linearScan(fields::noise({2, 6, 6}, 1), query), InputError);
}

}  // namespace
}  // namespace exemplar
