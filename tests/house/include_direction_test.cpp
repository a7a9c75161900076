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

/// A room (its folder) and the rooms that it may include beside itself, as docs/architecture.md
/// says. `synth/geometry` and its like are rooms of their own.
using Rooms = std::map<std::string, std::set<std::string>>;

/// The rows "| `room` | what | may include |" of a table.
Rooms readRooms(std::istream& text) {
  static const std::regex row(R"re(^\| `([a-z/]+)` \|[^|]*\| ([a-z/, –]+) \|$)re");
  Rooms rooms;
  for (std::string line; std::getline(text, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    std::set<std::string>& may = rooms[match[1]];
    std::istringstream names(match[2]);
    for (std::string name; std::getline(names >> std::ws, name, ',');)
      if (name != "–") may.insert(name);
  }
  return rooms;
}

const Rooms kMayInclude = [] {
  std::ifstream text(fs::path(EXEMPLAR_SOURCE_DIR) / "docs/architecture.md");
  return readRooms(text);
}();

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

TEST(IncludeDirections, EveryFolderOfSourcesIsARoom) {
  // A room that the table does not name would be checked by nobody.
  for (const auto& entry : fs::directory_iterator(EXEMPLAR_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name[0] == '.' || name == "build" || name == "tests" ||
        name == "synth")
      continue;
    bool sources = false;
    for (const auto& file : fs::directory_iterator(entry.path()))
      sources = sources || file.path().extension() == ".cpp";
    EXPECT_EQ(sources, kMayInclude.contains(name)) << name;
  }
  EXPECT_TRUE(kMayInclude.contains("synth/geometry") && kMayInclude.contains("synth/model"));
}

TEST(IncludeDirections, TheTableHasNoCircle) {
  // Each row names rooms of rows above it.
  std::ifstream text(fs::path(EXEMPLAR_SOURCE_DIR) / "docs/architecture.md");
  std::set<std::string> above;
  for (std::string line; std::getline(text, line);) {
    std::istringstream one(line);
    for (const auto& [room, may] : readRooms(one)) {
      for (const std::string& other : may)
        EXPECT_TRUE(above.contains(other)) << room << " " << other;
      above.insert(room);
    }
  }
  EXPECT_EQ(above.size(), kMayInclude.size());
}

TEST(IncludeDirections, AForbiddenIncludeIsFound) {
  std::istringstream text("#include \"core/vec.h\"\n#include \"mesh/triangle_mesh.h\"\n");
  EXPECT_EQ(forbiddenIncludes("search", text), std::vector<std::string>{"mesh/triangle_mesh.h"});
  std::istringstream apps("#include \"apps/command.h\"\n");
  EXPECT_EQ(forbiddenIncludes("sdf", apps), std::vector<std::string>{"apps/command.h"});
}

}  // namespace
