// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/random.h"

namespace exemplar::kernels {
namespace {

std::span<const Kernels* const> all() { return availableKernels(); }

int draw(const Random& random, std::uint64_t cell, int low, int high) {
  return low + int(random.below(std::uint32_t(high - low + 1), cell));
}

QueryFeatures randomQuery(std::uint64_t trial) {
  const Random random(trial, 1);
  QueryFeatures q;
  q.weighted = trial % 2 == 1;
  const auto range = [&](std::uint64_t cell, std::int16_t& low, std::int16_t& high) {
    // A fifth of the dimensions says nothing.
    const bool silent = random.below(5, cell, 3) == 0;
    low = silent ? 0 : std::int16_t(draw(random, cell, 0, 32767));
    high = silent ? 32767 : std::int16_t(std::min(32767, low + int(random.below(400, cell, 1))));
  };
  for (int d = 0; d < kMeans; ++d) {
    range(d, q.meanLow[d], q.meanHigh[d]);
    q.meanWeight[d] = q.weighted ? std::uint16_t(draw(random, 100 + d, 0, 65535)) : 65535;
  }
  q.detailPairs = 0;
  for (int d = 0; d < kDetails; ++d) range(50 + d, q.detailLow[d], q.detailHigh[d]);
  for (int p = 0; p < kDetails / 2; ++p)
    if (random.below(4, 200 + p) != 0) q.detailPair[q.detailPairs++] = std::uint8_t(p);
  return q;
}

// What one dimension adds, as the header states it.
std::uint32_t square(int low, int high, int queryLow, int queryHigh, int weight, bool weighted) {
  int gap = std::clamp(std::max(low - queryHigh, queryLow - high), 0, int(kLargestGap));
  if (weighted) gap = int(std::uint32_t(gap) * std::uint32_t(weight) >> 16);
  return std::uint32_t(gap) * std::uint32_t(gap);
}

TEST(Kernels, TheBaselineIsThere) {
  ASSERT_FALSE(all().empty());
  EXPECT_EQ(&kernels(), all().back());
}

TEST(Kernels, BoxGapsAreSumsOfSquares) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const Random random(trial, 2);
    const QueryFeatures q = randomQuery(trial);
    MeanBoxes boxes;
    boxes.shift = std::uint8_t(random.below(8, 0));
    std::uint32_t expected[kWide] = {};
    for (int d = 0; d < kMeans; ++d) {
      const int reach = 255 << boxes.shift;
      boxes.base[d] = std::int16_t(draw(random, 10 + d, 0, 32767 - reach));
      for (int c = 0; c < kWide; ++c) {
        const int low = draw(random, 1000 + 16 * d + c, 0, 255);
        const int high = draw(random, 3000 + 16 * d + c, low, 255);
        boxes.low[d / 2][c][d % 2] = std::uint8_t(low);
        boxes.high[d / 2][c][d % 2] = std::uint8_t(high);
        expected[c] +=
            square(boxes.base[d] + (low << boxes.shift), boxes.base[d] + (high << boxes.shift),
                   q.meanLow[d], q.meanHigh[d], q.meanWeight[d], q.weighted);
      }
    }
    const std::uint32_t bound = expected[trial % kWide];
    for (const Kernels* k : all()) {
      std::uint32_t sums[kWide];
      const std::uint32_t within = k->boxGaps(boxes, q, bound, sums);
      for (int c = 0; c < kWide; ++c) {
        EXPECT_EQ(sums[c], expected[c]) << k->name;
        EXPECT_EQ(within >> c & 1, expected[c] <= bound ? 1u : 0u) << k->name;
      }
    }
  }
}

template <int dimensions>
void fill(Points<dimensions>& points, const Random& random) {
  points.shift = std::uint8_t(random.below(8, 0));
  for (int d = 0; d < dimensions; ++d) {
    points.base[d] = std::int16_t(draw(random, 10 + d, 0, 32767 - (255 << points.shift)));
    points.width[d] = std::int16_t(random.below(300, 100 + d));
    for (int c = 0; c < kWide; ++c)
      points.value[d / 2][c][d % 2] = std::uint8_t(draw(random, 1000 + 16 * d + c, 0, 255));
  }
}

TEST(Kernels, MeanAndDetailGapsAreSumsOfSquares) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const QueryFeatures q = randomQuery(trial);
    MeanPoints means;
    DetailPoints details;
    fill(means, Random(trial, 3));
    fill(details, Random(trial, 4));
    std::uint32_t expectedMeans[kWide] = {}, expected[kWide] = {};
    for (int c = 0; c < kWide; ++c) {
      for (int d = 0; d < kMeans; ++d) {
        const int v = means.base[d] + (means.value[d / 2][c][d % 2] << means.shift);
        expectedMeans[c] += square(v - means.width[d], v + means.width[d], q.meanLow[d],
                                   q.meanHigh[d], q.meanWeight[d], q.weighted);
      }
      expected[c] = expectedMeans[c];
      for (int i = 0; i < q.detailPairs; ++i)
        for (int d = 2 * q.detailPair[i]; d < 2 * q.detailPair[i] + 2; ++d) {
          const int v = details.base[d] + (details.value[d / 2][c][d % 2] << details.shift);
          expected[c] += square(v - details.width[d], v + details.width[d], q.detailLow[d],
                                q.detailHigh[d], 65535, false);
        }
    }
    for (const Kernels* k : all()) {
      std::uint32_t sums[kWide];
      const std::uint32_t bound = expectedMeans[trial % kWide];
      const std::uint32_t within = k->meanGaps(means, q, bound, sums);
      for (int c = 0; c < kWide; ++c) {
        EXPECT_EQ(sums[c], expectedMeans[c]) << k->name;
        EXPECT_EQ(within >> c & 1, expectedMeans[c] <= bound ? 1u : 0u) << k->name;
      }
      k->detailGaps(details, q, kLargestBound, sums);
      for (int c = 0; c < kWide; ++c) EXPECT_EQ(sums[c], expected[c]) << k->name;
    }
  }
}

TEST(Kernels, BrickGapsAreSumsOfSquares) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const Random random(trial, 5);
    const QueryFeatures q = randomQuery(trial);
    const int shift = int(random.below(5, 0)), count = 1 + int(random.below(8, 1));
    const auto width = std::int16_t(random.below(100, 2));
    Brick bricks[8];
    BrickNumbers numbers[8];
    const Brick* pointers[8];
    std::uint8_t cells[8];
    std::uint32_t expected[8] = {};
    for (int i = 0; i < count; ++i) {
      pointers[i] = &bricks[i];
      const int cell = cells[i] = std::uint8_t((i + trial) % 8);
      for (int f = 0; f < kFeatures; ++f) {
        const int margin = (128 << shift) / 128 + 1;
        bricks[i].center[f] = std::uint8_t(draw(random, 10 + 4 * i + f, margin, 255 - margin));
        for (int p = 0; p < 8; ++p) {
          const int v = draw(random, 100 + 32 * i + 8 * f + p, 0, 255);
          bricks[i].difference[p][f] = std::uint8_t(v);
          const int number = (bricks[i].center[f] << kCenterShift) + ((v - 128) << shift);
          numbers[i].number[p][f] = std::int16_t(number);
          const int low = f == 0 ? q.meanLow[cell] : q.detailLow[detail(cell, f - 1)];
          const int high = f == 0 ? q.meanHigh[cell] : q.detailHigh[detail(cell, f - 1)];
          // Full weight is 65535 of 65536 where weights are applied at all.
          expected[p] +=
              square(number, number, std::max(low - width, -32768), std::min(high + width, 32767),
                     f == 0 ? q.meanWeight[cell] : 65535, q.weighted);
        }
      }
    }
    for (const Kernels* k : all()) {
      std::uint32_t sums[8], spelled[8];
      k->brickGaps(pointers, shift, width, q, cells, count, sums);
      k->numberGaps(numbers, width, q, cells, count, spelled);
      for (int p = 0; p < 8; ++p) {
        EXPECT_EQ(sums[p], expected[p]) << k->name;
        EXPECT_EQ(spelled[p], expected[p]) << k->name;
      }
    }
  }
}

TEST(Kernels, ByteGapsAreSumsOfSquares) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    const Random random(trial, 7);
    const QueryFeatures q = randomQuery(trial);
    const int count = 1 + int(random.below(8, 1));
    ByteScale scale;
    for (int f = 0; f < kFeatures; ++f) {
      scale.step[f] = std::int16_t(1 + random.below(128, 2, f));
      scale.base[f] = std::int16_t(random.below(32768 - 255 * scale.step[f], 3, f));
      scale.width[f] = std::int16_t(random.below(100, 4, f));
    }
    ByteBrick bricks[8];
    const ByteBrick* pointers[8];
    std::uint8_t cells[8];
    std::uint32_t expected[8] = {};
    for (int i = 0; i < count; ++i) {
      pointers[i] = &bricks[i];
      const int cell = cells[i] = std::uint8_t((i + trial) % 8);
      for (int f = 0; f < kFeatures; ++f)
        for (int p = 0; p < 8; ++p) {
          bricks[i].value[p][f] = std::uint8_t(draw(random, 100 + 32 * i + 8 * f + p, 0, 255));
          const int number = scale.base[f] + bricks[i].value[p][f] * scale.step[f];
          const int low = f == 0 ? q.meanLow[cell] : q.detailLow[detail(cell, f - 1)];
          const int high = f == 0 ? q.meanHigh[cell] : q.detailHigh[detail(cell, f - 1)];
          expected[p] += square(number, number, std::max(low - scale.width[f], -32768),
                                std::min(high + scale.width[f], 32767),
                                f == 0 ? q.meanWeight[cell] : 65535, q.weighted);
        }
    }
    for (const Kernels* k : all()) {
      std::uint32_t sums[8];
      k->byteGaps(pointers, scale, q, cells, count, sums);
      for (int p = 0; p < 8; ++p) EXPECT_EQ(sums[p], expected[p]) << k->name;
    }
  }
}

TEST(Kernels, ScanSumsKnownSamples) {
  for (std::uint64_t trial = 0; trial < 120; ++trial) {
    const Random random(trial, 6);
    const int piece = 1 << (trial % 6), pieces = kSumLanes / piece;
    const std::size_t count = 1 + random.below(20, 0),
                      whole = random.below(std::uint32_t(count + 1), 1);
    std::vector<std::uint8_t> block(4000);
    for (std::size_t i = 0; i < block.size(); ++i) block[i] = std::uint8_t(random.bits(i, 9));
    std::vector<std::uint32_t> source(count * pieces);
    std::vector<std::int16_t> value(count * kSumLanes), mask(count * kSumLanes);
    for (std::size_t p = 0; p < source.size(); ++p) source[p] = random.below(3000, p, 2);
    for (std::size_t s = 0; s < value.size(); ++s) {
      mask[s] = s / kSumLanes < whole || random.below(2, s, 3) ? -1 : 0;
      value[s] = mask[s] ? std::int16_t(random.below(256, s, 4)) : 0;
    }
    const auto plain = [&](std::size_t at) {
      std::int64_t sum = 0;
      for (std::size_t s = 0; s < value.size(); ++s) {
        const int a = block[at + source[s / piece] + s % piece];
        if (mask[s]) sum += (a - value[s]) * (a - value[s]);
      }
      return sum;
    };
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::size_t first = 0;
    for (std::size_t b = 0; b < 50; ++b)
      if (plain(b) < least) {
        least = plain(b);
        first = b;
      }
    for (const Kernels* k : all()) {
      const SumChunks chunks{source.data(), value.data(), mask.data(), count, whole, piece};
      std::int64_t found = -1;
      EXPECT_EQ(k->scan(chunks, block.data(), 50, least, found), first) << k->name;
      EXPECT_EQ(found, least) << k->name;
      EXPECT_EQ(k->scan(chunks, block.data(), 50, least - 1, found), 50u) << k->name;
    }
  }
}

}  // namespace
}  // namespace exemplar::kernels
