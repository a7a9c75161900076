// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("exemplar_file_test_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::ptrdiff_t filesInFolder() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator{});
  }
  fs::path folder_;
};

TEST_F(FileTest, WhatIsWrittenIsRead) {
  const std::string bytes("a\0b\n", 4);
  writeFile(folder_ / "f.bin", bytes);
  EXPECT_EQ(readFile(folder_ / "f.bin"), bytes);
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(FileTest, WithoutCommitNothingIsLeftAndTheOldFileStays) {
  writeFile(folder_ / "f.txt", "old");
  {
    OutputFile out(folder_ / "f.txt");
    out.write("new");
    EXPECT_EQ(out.temporaryPath().extension(), ".txt");
    EXPECT_EQ(filesInFolder(), 2);
  }
  EXPECT_EQ(filesInFolder(), 1);
  EXPECT_EQ(readFile(folder_ / "f.txt"), "old");
}

TEST_F(FileTest, AFolderThatIsNotThereIsSaid) {
  try {
    OutputFile out(folder_ / "no" / "f.obj");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("no/f.obj: cannot be written: No such file"));
  }
}

TEST_F(FileTest, AFullDiskIsSaid) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  OutputFile out(folder_ / "f.bin");
  fs::remove(out.temporaryPath());
  fs::create_symlink("/dev/full", out.temporaryPath());
  EXPECT_THROW(out.write("bytes"), InputError);
}

TEST_F(FileTest, EmptyMissingAndFolderAreRefused) {
  std::ofstream(folder_ / "empty").close();
  EXPECT_THROW(readFile(folder_ / "empty"), InputError);
  EXPECT_THROW(readFile(folder_ / "missing"), InputError);
  EXPECT_THROW(readFile(folder_), InputError);
}

TEST(LowerExtension, IsLowerCaseWithItsDot) {
  EXPECT_EQ(lowerExtension("a/B.OBJ"), ".obj");
  EXPECT_EQ(lowerExtension("a.b/none"), "");
}

}  // namespace
}  // namespace exemplar
