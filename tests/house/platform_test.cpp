// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What differs between operating systems is in core/platform_*.cpp and nowhere else in the library
// and its programs.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Lines that only some systems understand: their headers, their files and their macros.
std::vector<std::string> systemLines(std::istream& text) {
  static const std::regex own(
      R"re(#\s*include\s*<(sys/|unistd|fcntl|spawn|malloc|dlfcn|pthread|sched|termios|poll|signal\.h)re"
      R"re(|gnu/|mach/|windows|io\.h|process\.h|direct\.h|link\.h|netinet|arpa))re"
      R"re(|"/(proc|sys|dev)/|__(linux|APPLE|unix|GLIBC)__|_WIN32|__builtin_cpu_)re");
  std::vector<std::string> found;
  for (std::string line; std::getline(text, line);)
    if (std::regex_search(line, own)) found.push_back(line);
  return found;
}

TEST(Platform, IsKnownToItsOwnFilesOnly) {
  int files = 0, own = 0;
  for (const auto& room : fs::directory_iterator(EXEMPLAR_SOURCE_DIR)) {
    const std::string name = room.path().filename().string();
    if (!room.is_directory() || name[0] == '.' || name == "build" || name == "tests") continue;
    for (const auto& entry : fs::recursive_directory_iterator(room.path())) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      ++files;
      std::ifstream text(entry.path());
      const auto lines = systemLines(text);
      if (name == "core" && entry.path().filename().string().starts_with("platform_")) {
        own += static_cast<int>(lines.size());
      } else {
        for (const std::string& line : lines) ADD_FAILURE() << entry.path() << ": " << line;
      }
    }
  }
  EXPECT_GT(files, 300);
  EXPECT_GT(own, 10);  // or what is looked for is not what they say
}

TEST(Platform, ALineForOneSystemIsFound) {
  std::istringstream text(
      "#include <sys/mman.h>\n#include <vector>\n#ifdef __linux__\nread(\"/proc/self/exe\");\n");
  EXPECT_EQ(systemLines(text).size(), 3u);
}

}  // namespace
