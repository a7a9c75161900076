// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// A test file that no CMakeLists.txt names is never run, and nobody notices.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// The test files in a folder and below that the CMakeLists.txt of their own folder does not name.
std::vector<std::string> unlistedTests(const fs::path& folder) {
  std::vector<std::string> unlisted;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& file = entry.path();
    if (!file.filename().string().ends_with("_test.cpp")) continue;
    std::ifstream list(file.parent_path() / "CMakeLists.txt");
    const std::string text{std::istreambuf_iterator<char>(list), {}};
    // Named whole: "file_test.cpp" is not in "mesh_file_test.cpp".
    const std::string name = file.filename().string();
    bool found = false;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
      found |= at > 0 && std::string(" \n\t\"").find(text[at - 1]) != std::string::npos;
    if (!found) unlisted.push_back(file.string());
  }
  return unlisted;
}

TEST(TestFiles, AreAllBuilt) {
  for (const std::string& file : unlistedTests(fs::path(EXEMPLAR_SOURCE_DIR) / "tests"))
    ADD_FAILURE() << file << " is not named in the CMakeLists.txt beside it, so it is never run";
}

TEST(TestFiles, AnUnlistedOneIsFound) {
  const fs::path folder = fs::path(testing::TempDir()) / "exemplar_unlisted_test_files";
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const char* name : {"file_test.cpp", "mesh_file_test.cpp", "shapes.cpp"})
    std::ofstream(folder / name) << "\n";
  std::ofstream(folder / "CMakeLists.txt") << "exemplar_test(a SOURCES mesh_file_test.cpp)\n";
  EXPECT_EQ(unlistedTests(folder), std::vector<std::string>{(folder / "file_test.cpp").string()});
  fs::remove_all(folder);
}

}  // namespace
