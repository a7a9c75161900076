// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/huge_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <numeric>

namespace exemplar {
namespace {

std::uintptr_t addressOf(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory); }

TEST(HugePages, LargeArraysStartOnOne) {
  const HugeVector<int> small(1000), large(1 << 20);
  EXPECT_EQ(addressOf(small.data()) % 64, 0u);
  EXPECT_EQ(addressOf(large.data()) % (1 << 21), 0u);
}

TEST(HugePages, HoldWhatIsWrittenUpToTheLast) {
  // Neither a whole number of pages nor of huge pages.
  for (std::size_t count : {std::size_t{0}, std::size_t{3}, std::size_t{777777}}) {
    HugeVector<std::uint64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 5u);
    HugeVector<std::uint64_t> copy = numbers;
    copy.resize(2 * count, 1);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(copy[i], i + 5);
    EXPECT_EQ(copy.size(), 2 * count);
  }
}

TEST(HugePages, ThrowWhenThereIsNotEnoughMemory) {
  EXPECT_THROW(allocateInHugePages(std::size_t{1} << 60), std::bad_alloc);
  HugePageAllocator<std::uint64_t> allocator;
  EXPECT_THROW(allocator.allocate(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

}  // namespace
}  // namespace exemplar
