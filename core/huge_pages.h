// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace exemplar {

/// Memory for `bytes`, aligned to 64. From two megabytes on it is aligned to that, and Linux is
/// asked to back it with huge pages: what is read here and there in a large array then costs fewer
/// walks through page tables (docs/matching.md measures it), and what is written first costs up to
/// 512 times fewer faults. Throws `std::bad_alloc`.
void* allocateInHugePages(std::size_t bytes);
void freeHugePages(void* memory) noexcept;

/// Lets a container take its memory from `allocateInHugePages`.
template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocateInHugePages(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t) noexcept { freeHugePages(memory); }

  template <class U>
  bool operator==(const HugePageAllocator<U>&) const noexcept {
    return true;
  }
};

/// A vector for large arrays.
template <class T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace exemplar
