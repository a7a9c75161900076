// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/error.h"

namespace exemplar {
namespace {

TEST(RequireMemory, RefusesWhatNoMachineHas) {
  try {
    requireMemory(1e18, "resolution 100000", "use --resolution 512 or less");
    FAIL() << "a billion gigabytes were granted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("resolution 100000 needs about 1000 PB"));
    EXPECT_THAT(e.what(), testing::HasSubstr("use --resolution 512 or less"));
  }
}

TEST(RequireMemory, GrantsAMegabyte) { EXPECT_NO_THROW(requireMemory(1e6, "this", "")); }

TEST(PeakResidentBytes, IsWhatAProcessCanHave) {
  EXPECT_GT(peakResidentBytes(), 100'000u);
  EXPECT_LT(peakResidentBytes(), 1'000'000'000'000u);
}

TEST(ResetPeakResident, ForgetsWhatIsNoLongerHeld) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers hold on to what is freed";
#endif
  constexpr std::size_t kHeld = 64 << 20;
  { const std::vector<char> held(kHeld, 1); }
  const std::uint64_t before = peakResidentBytes();
  if (!resetPeakResident()) GTEST_SKIP() << "this system does not offer it";
  EXPECT_LT(peakResidentBytes() + kHeld / 2, before);
}

}  // namespace
}  // namespace exemplar
