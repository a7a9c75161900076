// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/window_cache.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/file.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

class WindowCacheFiles : public testing::Test {
 protected:
  WindowCacheFiles() {
    folder_ =
        fs::temp_directory_path() / ("exemplar_windows_" + std::to_string(::getpid()) +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  ~WindowCacheFiles() override { fs::remove_all(folder_); }

  fs::path folder_;
  const WindowKey key_{2, {-7, 130}};
};

TEST_F(WindowCacheFiles, AnotherProcessFindsWhatWasMade) {
  WindowCache(5, {.folder = folder_}).put(key_, "columns");
  const auto found = WindowCache(5, {.folder = folder_}).find(key_);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, "columns");
  EXPECT_FALSE(WindowCache(5, {.folder = folder_}).find({1, key_.window}));
}

TEST_F(WindowCacheFiles, AForeignOrDamagedFileIsNotThere) {
  WindowCache cache(5, {.folder = folder_});
  cache.put(key_, std::string(100, 'x'));
  const std::string whole = readFile(cache.fileOf(key_));
  EXPECT_FALSE(WindowCache(6, {.folder = folder_}).find(key_)) << "of another world";

  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream(cache.fileOf(key_), std::ios::binary | std::ios::trunc)
        << whole.substr(0, length);
    ASSERT_FALSE(WindowCache(5, {.folder = folder_}).find(key_)) << length;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] ^= 4;
    std::ofstream(cache.fileOf(key_), std::ios::binary | std::ios::trunc) << damaged;
    ASSERT_FALSE(WindowCache(5, {.folder = folder_}).find(key_)) << at;
  }
  // That of another window, too.
  std::ofstream(cache.fileOf(key_), std::ios::binary | std::ios::trunc) << whole;
  fs::copy_file(cache.fileOf(key_), cache.fileOf({2, {-7, 131}}));
  EXPECT_FALSE(WindowCache(5, {.folder = folder_}).find({2, {-7, 131}}));
  EXPECT_TRUE(WindowCache(5, {.folder = folder_}).find(key_));
}

TEST(WindowCache, ForgetsWhatWasNotUsedForLongest) {
  WindowCache cache(1, {.capacity = 250});
  for (int n = 0; n < 2; ++n) cache.put({1, {n, 0}}, std::string(100, 'a'));
  EXPECT_TRUE(cache.find({1, {0, 0}}));
  cache.put({1, {2, 0}}, std::string(100, 'a'));
  EXPECT_TRUE(cache.find({1, {0, 0}}));
  EXPECT_FALSE(cache.find({1, {1, 0}}));
  EXPECT_TRUE(cache.find({1, {2, 0}}));
}

}  // namespace
}  // namespace exemplar
