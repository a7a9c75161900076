// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.h"

namespace exemplar {
namespace {

/// The same by relabeling everything at each join.
struct SlowSets {
  std::vector<std::uint32_t> least;
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({least[a], least[b]});
    for (std::uint32_t& l : least)
      if (l == high) l = low;
  }
};

TEST(DisjointSets, AgreeWithRelabeling) {
  for (std::uint64_t trial = 0; trial < 50; ++trial) {
    const Random random(trial);
    const std::uint32_t count = 1 + random.below(60, 0);
    DisjointSets sets;
    SlowSets slow;
    for (std::uint32_t n = 0; n < count; ++n) {
      EXPECT_EQ(sets.add(), n);
      slow.least.push_back(n);
    }
    for (std::uint32_t n = 1; n < count; ++n) {
      const std::uint32_t a = random.below(count, n, 0), b = random.below(count, n, 1);
      EXPECT_EQ(sets.join(a, b), slow.least[a] != slow.least[b]);
      slow.join(a, b);
    }
    for (std::uint32_t n = 0; n < count; ++n) EXPECT_EQ(sets.find(n), slow.least[n]);
    std::uint32_t found = 0;
    const std::vector<std::uint32_t> number = sets.numbered(&found);
    std::uint32_t next = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
      EXPECT_EQ(number[n], slow.least[n] == n ? next++ : number[slow.least[n]]);
    }
    EXPECT_EQ(found, next);
  }
}

}  // namespace
}  // namespace exemplar
