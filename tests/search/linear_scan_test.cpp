// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/linear_scan.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/cells.h"
#include "core/error.h"
#include "definitions.h"
#include "fft_correlation.h"
#include "fields.h"

namespace exemplar {
namespace {

// The nearest block by the definition, ties by index.
template <class Sample>
BlockMatch nearest(const Array3D<Sample>& source, const BlockQuery<Sample>& query) {
  BlockMatch best;
  best.distance = std::numeric_limits<double>::infinity();
  forEachCell(blockPositions(source.size(), query.samples.size()), [&](const Vec3i& p) {
    const double distance = blockDistance(source, p, query);
    if (distance < best.distance) best = {p, distance, 0};
  });
  return best;
}

TEST(LinearScan, FindsWhatTheDefinitionFinds) {
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    const Random random(trial, 1);
    const Vec3i size{1 + int(random.below(9, 0)), 1 + int(random.below(6, 1)),
                     1 + int(random.below(6, 2))};
    const Vec3i sourceSize = size + Vec3i{int(random.below(7, 3)), 3, int(random.below(5, 4))};
    // Two levels only in some trials: many ties.
    const auto source = fields::noise(sourceSize, trial, trial % 2 ? 2 : 256);
    BlockQuery<std::uint8_t> query{fields::noise(size, trial + 99, trial % 2 ? 2 : 256), {}};
    if (trial % 3) query.known = fields::randomMask(size, random.uniform(5), trial);
    EXPECT_EQ(linearScan(source, query), nearest(source, query));
  }
}

TEST(LinearScan, FindsWhatTheDefinitionFindsInFloats) {
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const auto source = fields::shape(16, fields::Shape::Torus, trial);
    const auto other = fields::shape(16, fields::Shape::Ball, trial);
    auto query = fields::octantQuery(other, {5, 6, 7}, trial);
    EXPECT_EQ(linearScan(source, query), nearest(source, query));
  }
}

TEST(LinearScan, PrefersTheLowestIndexAmongTies) {
  const Array3D<std::uint8_t> flat({9, 9, 9}, 77);
  const BlockQuery<std::uint8_t> query{Array3D<std::uint8_t>({4, 4, 4}, 80), {}};
  EXPECT_EQ(linearScan(flat, query), (BlockMatch{{0, 0, 0}, 9, 0}));
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

TEST(LinearScan, RefusesABlockThatDoesNotFit) {
  const auto source = fields::noise({6, 6, 6}, 1);
  const BlockQuery<std::uint8_t> query{fields::noise({3, 3, 3}, 2), {}};
  EXPECT_THROW(linearScan(fields::noise({2, 6, 6}, 1), query), InputError);
}

}  // namespace
}  // namespace exemplar
