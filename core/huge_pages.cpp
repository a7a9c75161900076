// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/huge_pages.h"

#include <algorithm>
#include <new>

#include "core/platform.h"

namespace exemplar {

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
constexpr std::size_t kLine = 64;

}  // namespace

void* allocateInHugePages(std::size_t bytes) {
  const bool huge = bytes >= kHugePage;
  void* const memory = platform::allocateAligned(std::max(bytes, kLine), huge ? kHugePage : kLine);
  if (memory == nullptr) throw std::bad_alloc();
  // The last, broken page stays as it is.
  if (huge) platform::adviseHugePages(memory, bytes / kHugePage * kHugePage);
  return memory;
}

void freeHugePages(void* memory) noexcept { platform::freeAligned(memory); }

}  // namespace exemplar
