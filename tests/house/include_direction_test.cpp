// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Which room may include which: data flows one way, and the rooms below know nothing of those
// above.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A room (its folder) and the rooms that it may include beside itself. `synth/geometry` and its
/// like are rooms of their own.
const std::map<std::string, std::set<std::string>> kMayInclude{
    {"core", {}},
    {"mesh", {"core"}},
    {"sdf", {"core", "mesh"}},
    {"voxelize", {"core", "mesh", "sdf"}},
    {"search", {"core"}},
    {"synth/geometry", {"core", "sdf", "search"}},
    {"synth/model", {"core", "voxelize"}},
    {"synth/continuous", {"core", "mesh"}},
    {"synth/layered", {"core", "search"}},
    {"reconstruct", {"core", "mesh", "sdf"}},
    {"measure", {"core", "mesh", "sdf", "voxelize"}},
    {"preview", {"core", "mesh"}},
    {"report", {"core", "mesh", "sdf", "reconstruct", "measure", "preview"}},
};

std::string roomOf(const std::string& path) {
  for (const auto& [room, allowed] : kMayInclude) {
    if (path.rfind(room + "/", 0) == 0) return room;
  }
  return "";
}

/// Each include in `text`, a source of `room`, that points where it may not.
std::vector<std::string> forbiddenIncludes(const std::string& room, std::istream& text) {
  static const std::regex include(R"re(^\s*#\s*include\s*"([^"]+)")re");
  std::vector<std::string> forbidden;
  for (std::string line; std::getline(text, line);) {
    std::smatch match;
    if (!std::regex_search(line, match, include)) continue;
    const std::string target = roomOf(match[1]);
    if (target != room && !kMayInclude.at(room).contains(target)) forbidden.push_back(match[1]);
  }
  return forbidden;
}

TEST(IncludeDirections, PointDownOnly) {
  int files = 0;
  for (const auto& [room, allowed] : kMayInclude) {
    const fs::path folder = fs::path(EXEMPLAR_SOURCE_DIR) / room;
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      ++files;
      std::ifstream text(entry.path());
      for (const std::string& include : forbiddenIncludes(room, text)) {
        ADD_FAILURE() << entry.path() << " includes \"" << include << "\", which " << room
                      << " may not";
      }
    }
  }
  EXPECT_GT(files, 10);
}

TEST(IncludeDirections, AForbiddenIncludeIsFound) {
  std::istringstream text("#include \"core/vec.h\"\n#include \"mesh/triangle_mesh.h\"\n");
  EXPECT_EQ(forbiddenIncludes("search", text), std::vector<std::string>{"mesh/triangle_mesh.h"});
  std::istringstream apps("#include \"apps/command.h\"\n");
  EXPECT_EQ(forbiddenIncludes("sdf", apps), std::vector<std::string>{"apps/command.h"});
}

}  // namespace
