// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace exemplar {
namespace {

// The known answers that the Random123 library publishes for philox4x32-10.
TEST(Philox4x32, GivesThePublishedAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t f = 0xffffffff;
  EXPECT_EQ(philox4x32({f, f, f, f}, {f, f}),
            (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

TEST(Random, EveryPartOfTheKeyMatters) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed : {1, 2})
    for (std::uint32_t stream : {0, 1})
      for (std::uint64_t cell : {0ull, 1ull, 1ull << 40})
        for (std::uint32_t draw : {0, 1}) seen.insert(Random(seed, stream).bits(cell, draw));
  EXPECT_EQ(seen.size(), 24u);
}

TEST(Random, BelowStaysBelowAndReachesEveryValue) {
  const Random random(7);
  std::set<std::uint32_t> seen;
  for (int n = 0; n < 1000; ++n) {
    const std::uint32_t v = random.below(10, n);
    ASSERT_LT(v, 10u);
    seen.insert(v);
  }
  EXPECT_EQ(seen.size(), 10u);
}

// 10,000 draws: the mean's deviation is 0.01, the variance's 0.014; five of each are allowed.
TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  const Random random(3);
  double sum = 0, squares = 0;
  for (int n = 0; n < 10000; ++n) {
    const double v = random.normal(n);
    sum += v;
    squares += v * v;
  }
  EXPECT_NEAR(sum / 10000, 0, 0.05);
  EXPECT_NEAR(squares / 10000, 1, 0.07);
}

TEST(Random, AttemptsShareNoDraw) {
  const Random random(7, 3);
  std::set<std::uint64_t> seen;
  for (std::uint64_t attempt = 0; attempt < 8; ++attempt) {
    const Random fork = random.fork(attempt);
    for (std::uint64_t cell = 0; cell < 64; ++cell)
      for (std::uint32_t draw = 0; draw < 4; ++draw) seen.insert(fork.bits(cell, draw));
  }
  EXPECT_EQ(seen.size(), 8u * 64 * 4);
}

}  // namespace
}  // namespace exemplar
