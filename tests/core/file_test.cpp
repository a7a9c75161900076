// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "tests/file_size_limit.h"

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

TEST_F(FileTest, AFullDiskIsSaidAndLeavesTheOldFile) {
  writeFile(folder_ / "f.bin", "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_THROW(writeFile(folder_ / "f.bin", std::string(100000, 'x')), InputError);
    EXPECT_THROW(writeFile(folder_ / "g.bin", std::string(100000, 'x')), InputError);
  }
  EXPECT_EQ(readFile(folder_ / "f.bin"), "old");
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(FileTest, BeforeItIsWholeAFileHasNoName) {
  OutputFile out(folder_ / "f.bin");
  out.write("bytes");
  if (filesInFolder() == 1) GTEST_SKIP() << "no files without names in " << folder_;
  EXPECT_EQ(filesInFolder(), 0);
  out.commit();
  EXPECT_EQ(readFile(folder_ / "f.bin"), "bytes");
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(FileTest, OverwritingKeepsPermissions) {
  writeFile(folder_ / "f.sh", "old");
  fs::permissions(folder_ / "f.sh", fs::perms(0750));
  writeFile(folder_ / "f.sh", "new");
  EXPECT_EQ(readFile(folder_ / "f.sh"), "new");
  EXPECT_EQ(fs::status(folder_ / "f.sh").permissions(), fs::perms(0750));
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(FileTest, LinksAreFollowed) {
  fs::create_directory(folder_ / "there");
  fs::create_symlink("there/f.txt", folder_ / "link.txt");  // of what is not there yet
  writeFile(folder_ / "link.txt", "one");
  writeFile(folder_ / "link.txt", "two");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(readFile(folder_ / "there" / "f.txt"), "two");
  fs::create_symlink("round.txt", folder_ / "round.txt");
  EXPECT_THROW(writeFile(folder_ / "round.txt", "x"), InputError);
}

TEST_F(FileTest, DevicesAndPipesAreNeitherReadNorReplaced) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(writeFile(folder_ / "pipe", "x"), InputError);
  EXPECT_THROW(readFile(folder_ / "pipe"), InputError);
  EXPECT_EQ(fs::status(folder_ / "pipe").type(), fs::file_type::fifo);
  EXPECT_THROW(writeFile("/dev/null", "x"), InputError);
}

TEST_F(FileTest, ReadOnlyFoldersAndFilesAreSaid) {
  // Root may write everywhere, so root is nobody for a while.
  constexpr uid_t kNobody = 65534;
  const bool root = geteuid() == 0;
  if (root) {
    ASSERT_EQ(chown(folder_.c_str(), kNobody, kNobody), 0);
    ASSERT_EQ(seteuid(kNobody), 0);
  }
  writeFile(folder_ / "f.txt", "old");
  fs::permissions(folder_ / "f.txt", fs::perms(0444));
  EXPECT_THROW(writeFile(folder_ / "f.txt", "new"), InputError);
  fs::permissions(folder_, fs::perms(0555));
  EXPECT_THROW(writeFile(folder_ / "g.txt", "new"), InputError);
  fs::permissions(folder_, fs::perms(0755));
  EXPECT_EQ(readFile(folder_ / "f.txt"), "old");
  if (root) {
    ASSERT_EQ(seteuid(0), 0);
  }
}

TEST_F(FileTest, AFileThatShrinksWhileItIsReadIsSaid) {
  const fs::path path = folder_ / "f.bin";
  writeFile(path, std::string(40 << 20, 'x'));
  const auto shrink = [&](std::string_view, double fraction) {
    if (fraction > 0) fs::resize_file(path, 1000);
  };
  try {
    readFile(path, Progress(shrink));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("could not be read to its end"));
  }
}

TEST_F(FileTest, NamesMayHaveSpacesAndUmlauts) {
  const fs::path path = folder_ / u8"ein Grüß Gott \u00e9.obj";
  writeFile(path, "bytes");
  EXPECT_EQ(readFile(path), "bytes");
  EXPECT_EQ(lowerExtension(path), ".obj");
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
