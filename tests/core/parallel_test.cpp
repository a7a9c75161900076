// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/parallel.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "core/random.h"

namespace exemplar {
namespace {

float sumOfNoise() {
  const Random random(1);
  return parallelSum<float>(0, 100000, 777, [&](std::size_t begin, std::size_t end) {
    float sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += static_cast<float>(random.normal(i));
    return sum;
  });
}

TEST(ParallelSum, IsTheSameBytesAtOneAndEightThreads) {
  tbb::task_arena one(1), eight(8);
  const float expected = one.execute(sumOfNoise);
  for (int trial = 0; trial < 20; ++trial) EXPECT_EQ(eight.execute(sumOfNoise), expected);
}

TEST(ParallelSum, CountsEveryItemOnce) {
  for (std::size_t n : {0, 1, 5, 6, 7, 1000}) {
    const auto sum = parallelSum<std::size_t>(10, 10 + n, 6, [](std::size_t b, std::size_t e) {
      std::size_t s = 0;
      for (std::size_t i = b; i < e; ++i) s += i;
      return s;
    });
    EXPECT_EQ(sum, n * 10 + (n ? n * (n - 1) / 2 : 0));
  }
}

}  // namespace
}  // namespace exemplar
