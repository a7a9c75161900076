// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "core/file.h"
#include "fuzz_reader.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

struct Reader {
  std::string name;
  void (*read)(std::string_view);
};

void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

std::vector<Reader>& readers() {
  static std::vector<Reader> all;
  return all;
}

class FuzzCorpus : public testing::TestWithParam<Reader> {};

/// What the fuzzers found worth keeping is read without a crash, and refused in one line.
TEST_P(FuzzCorpus, IsReadOrRefused) {
  const fs::path folder = fs::path(EXEMPLAR_FUZZ_CORPUS) / GetParam().name;
  ASSERT_TRUE(fs::is_directory(folder)) << folder;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  EXPECT_FALSE(files.empty());
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    GetParam().read(readFile(file));
  }
  GetParam().read("");
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzCorpus, testing::ValuesIn(readers()),
                         [](const auto& reader) { return reader.param.name; });

}  // namespace

bool fuzz::addReplay(const char* name, void (*read)(std::string_view)) {
  readers().push_back({name, read});
  return true;
}

}  // namespace exemplar
