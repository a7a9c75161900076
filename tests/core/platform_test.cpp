// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What every system has to do, in the words of core/platform.h. Built twice: with this system's
// file, and with the one that does with C++ alone.

#include "core/platform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace exemplar {
namespace {

namespace fs = std::filesystem;

class PlatformTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("exemplar_platform_test_" + std::string(test->name()) +
                                           std::string(platform::name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::ptrdiff_t filesInFolder() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator{});
  }
  static std::string textOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

TEST_F(PlatformTest, IsTheOneThatWasAskedFor) {
  EXPECT_EQ(platform::name(), EXEMPLAR_EXPECTED_PLATFORM);
}

TEST_F(PlatformTest, AlignedMemoryIsAlignedAndHoldsItsBytes) {
  for (const std::size_t alignment : {std::size_t{64}, std::size_t{4096}, std::size_t{1} << 21}) {
    for (const std::size_t bytes : {std::size_t{64}, std::size_t{1000}, std::size_t{3} << 20}) {
      void* const memory = platform::allocateAligned(bytes, alignment);
      ASSERT_NE(memory, nullptr);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % alignment, 0u);
      std::memset(memory, 0x5a, bytes);
      platform::adviseHugePages(memory, bytes);
      EXPECT_EQ(static_cast<const unsigned char*>(memory)[bytes - 1], 0x5a);
      platform::freeAligned(memory);
    }
  }
  platform::freeAligned(nullptr);
}

TEST_F(PlatformTest, AnUnseenFileIsGoneUnlessItIsMovedIntoPlace) {
  const fs::path place = folder_ / "a file.txt";
  {
    platform::UnseenFile file(place);
    file.append("lost");
    EXPECT_FALSE(fs::exists(place));
  }
  EXPECT_EQ(filesInFolder(), 0);
  platform::UnseenFile file(place);
  file.append("first");
  file.clear();
  file.append("the ");
  file.append(std::string_view("who\0le", 6));
  file.append("");
  EXPECT_FALSE(fs::exists(place));
  file.moveIntoPlace();
  EXPECT_EQ(textOf(place), std::string("the who\0le", 10));
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(PlatformTest, AnUnseenFileReplacesWhatIsThereAtOnce) {
  const fs::path place = folder_ / "f.sh";
  std::ofstream(place) << "old";
  platform::UnseenFile file(place), other(place);  // two at once do not meet
  file.setPermissions(fs::perms(0750));
  file.append("new");
  other.append("newer");
  EXPECT_EQ(textOf(place), "old");
  file.moveIntoPlace();
  EXPECT_EQ(textOf(place), "new");
  EXPECT_EQ(fs::status(place).permissions(), fs::perms(0750));
  other.moveIntoPlace();
  EXPECT_EQ(textOf(place), "newer");
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(PlatformTest, AnUnseenFileNeedsItsFolder) {
  try {
    platform::UnseenFile file(folder_ / "no" / "f.txt");
    FAIL();
  } catch (const std::system_error& e) {
    EXPECT_EQ(e.code(), std::errc::no_such_file_or_directory);
  }
  // A folder in its place: nothing is left, there or beside it.
  fs::create_directories(folder_ / "taken" / "in");
  {
    platform::UnseenFile file(folder_ / "taken");
    EXPECT_THROW(file.moveIntoPlace(), std::system_error);
  }
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(PlatformTest, WhatMayBeWrittenStaysAsItIs) {
  std::ofstream(folder_ / "f.txt") << "here";
  EXPECT_FALSE(platform::mayWrite(folder_ / "f.txt"));
  EXPECT_EQ(textOf(folder_ / "f.txt"), "here");
  EXPECT_TRUE(platform::mayWrite(folder_ / "no" / "f.txt"));
}

TEST_F(PlatformTest, SaysWhatItKnows) {
  EXPECT_EQ(platform::processId(), platform::processId());
  EXPECT_FALSE(platform::arithmetic().empty());
  // A file is no terminal.
  std::FILE* const file = std::fopen((folder_ / "f").string().c_str(), "wb");
  ASSERT_NE(file, nullptr);
  EXPECT_FALSE(platform::isTerminal(file));
  std::fclose(file);
  if (platform::name() != "linux") return;
  EXPECT_THAT(platform::programFile().value().filename().string(), testing::HasSubstr("test"));
  EXPECT_GT(platform::availableMemory().value(), std::uint64_t{1} << 20);
  EXPECT_GT(platform::peakResident().value(), std::uint64_t{1} << 20);
}

}  // namespace
}  // namespace exemplar
