// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_match.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "definitions.h"
#include "fields.h"

namespace exemplar {
namespace {

// Equation 1, as one writes it down.
template <class Sample>
double plainDistance(const Array3D<Sample>& source, const Vec3i& position,
                     const BlockQuery<Sample>& query) {
  double sum = 0, known = 0;
  for (std::size_t i = 0; i < query.samples.count(); ++i) {
    if (!query.known.empty() && query.known.data()[i] == 0) continue;
    const double d = double(source[position + query.samples.ijk(i)]) - query.samples.data()[i];
    sum += d * d;
    ++known;
  }
  return known == 0 ? 0 : sum / known;
}

TEST(BlockDistance, IsTheMeanOfSquaredDifferencesOverKnownSamples) {
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    const Random random(trial);
    const Vec3i size{1 + int(random.below(21, 0)), 1 + int(random.below(9, 1)),
                     1 + int(random.below(9, 2))};
    const Vec3i sourceSize = size + Vec3i{int(random.below(5, 3)), 2, int(random.below(4, 4))};
    const auto source = fields::noise(sourceSize, trial);
    BlockQuery<std::uint8_t> query{fields::noise(size, trial + 1000), {}};
    if (trial % 3) query.known = fields::randomMask(size, random.uniform(5), trial);
    const Vec3i last = sourceSize - size;
    EXPECT_EQ(blockDistance(source, last, query), plainDistance(source, last, query));

    Array3D<float> floats(sourceSize);
    for (std::size_t i = 0; i < floats.count(); ++i)
      floats.data()[i] = static_cast<float>(random.normal(i, 7));
    BlockQuery<float> other{fields::block(floats, {}, size), query.known};
    for (std::size_t i = 0; i < other.samples.count(); ++i)
      other.samples.data()[i] += static_cast<float>(random.normal(i, 9));
    const double expected = plainDistance(floats, last, other);
    // Differences are rounded to float: 2^-24 each, twice that in the square.
    EXPECT_NEAR(blockDistance(floats, last, other), expected, 2e-7 * expected);
  }
}

TEST(BlockDistance, UnknownSamplesMayHoldAnything) {
  const auto source = fields::shape(12, fields::Shape::Ball, 1);
  BlockQuery<float> query{fields::block(source, {1, 2, 3}, {6, 6, 6}),
                          fields::withoutOctant({6, 6, 6}, 5)};
  for (std::size_t i = 0; i < query.known.count(); ++i)
    if (!query.known.data()[i]) query.samples.data()[i] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(blockDistance(source, {1, 2, 3}, query), 0);
  EXPECT_GT(blockDistance(source, {1, 2, 2}, query), 0);
}

TEST(BlockPositions, RefusesBlocksThatDoNotFit) {
  EXPECT_EQ(blockPositions({8, 9, 10}, {8, 8, 1}), (Vec3i{1, 2, 10}));
  EXPECT_THROW(blockPositions({8, 8, 8}, {8, 9, 8}), InputError);
  EXPECT_THROW(blockPositions({8, 8, 8}, {8, 0, 8}), InputError);
}

TEST(KnownSamples, RefusesMasksOfAnotherSize) {
  const BlockQuery<std::uint8_t> query{Array3D<std::uint8_t>({4, 4, 4}),
                                       Array3D<std::uint8_t>({4, 4, 3})};
  EXPECT_THROW(knownSamples(query), InputError);
}

}  // namespace
}  // namespace exemplar
