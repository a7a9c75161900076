// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Worlds as a user makes them: tile by tile, in any order, by any number of processes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/file.h"
#include "mesh/mesh_file.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A world of the castle, with few moves and small tiles.
class WorldCommand : public testing::Test {
 protected:
  WorldCommand() {
    const auto run = world("init castle -o w --tile 24 --window 24 --moves 1 --seed 5");
    EXPECT_EQ(run.status, 0) << run.err;
  }

  CommandResult world(const std::string& arguments) const {
    return runExemplar("world " + arguments, folder_.path());
  }
  /// The bytes of each tile's file of an ending.
  std::map<std::string, std::string> tiles(const std::string& ending) const {
    std::map<std::string, std::string> found;
    if (!fs::exists(folder_ / "w/tiles")) return found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "w/tiles"))
      if (entry.path().extension() == ending)
        found[fs::relative(entry.path(), folder_ / "w/tiles").string()] = readFile(entry.path());
    return found;
  }
  void damage(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = readFile(folder_ / file);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, text.npos);
    writeFile(folder_ / file, text.replace(at, from.size(), to));
  }

  TestFolder folder_;
};

TEST_F(WorldCommand, TilesAreTheSameAloneOrTogetherAndWhateverIsCached) {
  ASSERT_EQ(world("make w --region -1:2,-1:2 --formats txt --threads 8").status, 0);
  const auto together = tiles(".txt");
  ASSERT_EQ(together.size(), 9u);
  std::set<std::string> contents;
  for (const auto& [name, bytes] : together) contents.insert(bytes);
  EXPECT_EQ(contents.size(), 9u) << "no tile is another one's copy";

  // Each by a process of its own, in another order, with a cache of which half is deleted.
  fs::remove_all(folder_ / "w/tiles");
  int n = 0;
  for (const char* tile : {"1,1", "0,-1", "1,0", "0,0", "1,-1", "0,1"}) {
    const std::string threads = n % 2 ? "1" : "8";
    ASSERT_EQ(
        world("tile w " + std::string(tile) + " --formats txt --cache --threads " + threads).status,
        0);
    std::vector<fs::path> windows;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "w/cache"))
      if (entry.is_regular_file()) windows.push_back(entry.path());
    EXPECT_FALSE(windows.empty());
    std::sort(windows.begin(), windows.end());
    for (std::size_t w = 0; w < windows.size(); w += 2) fs::remove(windows[w]);
    // And one is cut short.
    if (windows.size() > 1) fs::resize_file(windows[1], fs::file_size(windows[1]) / 2);
    ++n;
  }
  const auto alone = tiles(".txt");
  EXPECT_EQ(alone.size(), 6u);
  for (const auto& [name, bytes] : alone) EXPECT_TRUE(together.at(name) == bytes) << name;
}

TEST_F(WorldCommand, MakeGoesOnWhereItWasAndMakesNothingTwice) {
  ASSERT_EQ(world("make w --region 0:1,0:2 --formats vox").status, 0);
  const auto before = fs::last_write_time(folder_ / "w/tiles/0/0/1.vox");
  const auto run = world("make w --region 0:2,0:2 --formats vox");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("2 tiles made, 2 were there"));
  EXPECT_EQ(fs::last_write_time(folder_ / "w/tiles/0/0/1.vox"), before);
  EXPECT_EQ(tiles(".vox").size(), 4u);
  EXPECT_EQ(world("index w").status, 0);
  const auto index = nlohmann::json::parse(readFile(folder_ / "w/index.json"));
  EXPECT_EQ(index["tiles"].size(), 4u);
}

TEST_F(WorldCommand, CheckFindsThatAllFitsAndWhatDoesNot) {
  ASSERT_EQ(world("make w --region 0:3,0:2 --formats glb,txt").status, 0);
  const auto run = world("check w --region 0:3,0:2 --remake 100");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr(" 0 that the example does not show"));
  EXPECT_THAT(run.out, HasSubstr("12, 12 of them made again, 0 not the same bytes"));
  EXPECT_THAT(run.out, HasSubstr("edges of meshes between tiles, 0 unmatched"));
  EXPECT_EQ(run.out.find(" 0 edges of meshes"), run.out.npos) << "there were some to match";

  // A tile of another place is found out.
  fs::copy_file(folder_ / "w/tiles/0/0/0.glb", folder_ / "w/tiles/0/1/1.glb",
                fs::copy_options::overwrite_existing);
  const auto bad = world("check w --region 0:3,0:2 --remake 100");
  EXPECT_EQ(bad.status, 3);
  EXPECT_THAT(bad.err, HasSubstr("1.glb is not what this machine makes"));
  EXPECT_EQ(bad.out.find("tiles, 0 unmatched"), bad.out.npos);
}

TEST_F(WorldCommand, ExportIsWhatItsTilesAre) {
  ASSERT_EQ(world("export w --region 0:2,0:1 -o r.txt").status, 0);
  ASSERT_EQ(world("export w --region 0:2,0:1 -o r.glb").status, 0);
  EXPECT_GT(readMesh(folder_ / "r.glb").triangles.size(), 0u);
  EXPECT_THAT(readFile(folder_ / "r.txt"), HasSubstr("48 24 7"));
}

/// The tiles below a node of a tileset, by the names of their files, and the boxes in which they
/// lie. Each node's box holds its children's.
void collect(const nlohmann::json& node, std::map<std::string, Box3d>& found, const Box3d& outer) {
  const std::vector<double> b = node.at("boundingVolume").at("box");
  Vec3d at{0, 0, 0};
  if (node.contains("transform")) {
    const std::vector<double> m = node["transform"];
    at = {m[12], m[13], m[14]};
  }
  const Vec3d center = Vec3d{b[0], b[1], b[2]} + at, half{b[3], b[7], b[11]};
  const Vec3d slack{1e-4, 1e-4, 1e-4};
  const Box3d box{center - half - slack, center + half + slack};
  EXPECT_TRUE(outer.contains(center - half) && outer.contains(center + half));
  if (node.contains("content")) {
    EXPECT_TRUE(found.emplace(node["content"]["uri"], box).second) << "each tile once";
    EXPECT_EQ(node["geometricError"], 0);
  }
  if (!node.contains("children")) return;
  for (const auto& child : node["children"]) {
    EXPECT_LT(child["geometricError"].get<double>(), node["geometricError"].get<double>());
    collect(child, found, box);
  }
}

TEST_F(WorldCommand, TheTilesetHasEachTileWhereItLies) {
  ASSERT_EQ(world("make w --region -1:2,0:2 --formats glb").status, 0);
  ASSERT_EQ(world("index w").status, 0);
  const auto index = nlohmann::json::parse(readFile(folder_ / "w/index.json"));
  const auto tileset = nlohmann::json::parse(readFile(folder_ / "w/tileset.json"));
  EXPECT_EQ(tileset["asset"]["version"], "1.1");
  EXPECT_GE(tileset["geometricError"], tileset["root"]["geometricError"]);
  std::map<std::string, Box3d> found;
  collect(tileset["root"], found, {{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}});
  ASSERT_EQ(found.size(), 6u);
  const double size = index["tile_size"][0];
  for (int x = -1; x < 2; ++x) {
    for (int y = 0; y < 2; ++y) {
      const std::string name = "tiles/0/" + std::to_string(x) + "/" + std::to_string(y) + ".glb";
      ASSERT_TRUE(found.contains(name)) << name;
      const Box3d& box = found[name];
      for (const Vec3d& p : readMesh(folder_ / "w" / name).positions)
        ASSERT_TRUE(box.contains(p + Vec3d{x * size, y * size, 0})) << name;
    }
  }
}

TEST_F(WorldCommand, TilesetsOfManyTilesHaveEachOnceInFilesOfTheirOwn) {
  // One tile, 65 x 64 times around 0,0: what is in them is not what is asked here.
  ASSERT_EQ(world("tile w 0,0 --formats glb").status, 0);
  for (int x = -3; x < 62; ++x) {
    fs::create_directories(folder_ / "w/tiles/0" / std::to_string(x));
    for (int y = -60; y < 4; ++y) {
      const fs::path path =
          folder_ / "w/tiles/0" / std::to_string(x) / (std::to_string(y) + ".glb");
      if (!fs::exists(path)) fs::create_hard_link(folder_ / "w/tiles/0/0/0.glb", path);
    }
  }
  const auto run = world("index w");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("4,160 tiles in 5 files"));
  const Box3d everywhere{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
  const auto top = nlohmann::json::parse(readFile(folder_ / "w/tileset.json"));
  const double size = nlohmann::json::parse(readFile(folder_ / "w/index.json"))["tile_size"][0];
  std::set<std::string> tiles;
  int files = 0;
  const auto read = [&](const auto& self, const nlohmann::json& node) -> void {
    if (node.contains("children"))
      for (const auto& child : node["children"]) self(self, child);
    if (!node.contains("content")) return;
    ++files;
    const fs::path path = folder_ / "w" / node["content"]["uri"].get<std::string>();
    const auto part = nlohmann::json::parse(readFile(path));
    EXPECT_LE(part["geometricError"].get<double>(), node["geometricError"].get<double>());
    std::map<std::string, Box3d> found;
    collect(part["root"], found, everywhere);
    const std::vector<double> b = node["boundingVolume"]["box"];
    const Vec3d center{b[0], b[1], b[2]}, half{b[3] + 1e-4, b[7] + 1e-4, b[11] + 1e-4};
    for (const auto& [name, box] : found) {
      // Names are relative to the part's file.
      const fs::path file = fs::weakly_canonical(path.parent_path() / name);
      EXPECT_TRUE(fs::exists(file)) << name;
      EXPECT_TRUE(tiles.insert(file.string()).second) << name;
      const double x = std::stod(file.parent_path().filename().string()) * size;
      EXPECT_TRUE(box.min.x >= x - 1e-3 && box.max.x <= x + size + 1e-3) << name;
      const Box3d outer{center - half, center + half};
      EXPECT_TRUE(outer.contains(box.min + Vec3d{1e-4, 1e-4, 1e-4}) &&
                  outer.contains(box.max - Vec3d{1e-4, 1e-4, 1e-4}))
          << name;
    }
  };
  read(read, top["root"]);
  EXPECT_EQ(files, 4);
  EXPECT_EQ(tiles.size(), 4160u);
}

TEST_F(WorldCommand, PlansHoldEachTileOnce) {
  const auto json = world("plan w --region 0:9,0:5 --as json");
  ASSERT_EQ(json.status, 0) << json.err;
  std::int64_t count = 0;
  const auto plan = nlohmann::json::parse(json.out);
  for (const auto& job : plan["jobs"]) count += job["tiles"].get<int>();
  EXPECT_EQ(count, 45);
  const auto lines = world("plan w --region 0:9,0:5 --as parallel");
  EXPECT_EQ(std::count(lines.out.begin(), lines.out.end(), '\n'),
            static_cast<std::ptrdiff_t>(plan["jobs"].size()));
  const auto slurm = world("plan w --region 0:9,0:5 --as slurm");
  EXPECT_THAT(slurm.out, HasSubstr("#SBATCH --array=0-" + std::to_string(plan["jobs"].size() - 1)));
}

TEST_F(WorldCommand, TheSameRequestOpensAnotherOneIsRefused) {
  const std::string same = "init castle -o w --tile 24 --window 24 --moves 1 --seed 5";
  EXPECT_EQ(world(same).status, 0);
  for (const char* other : {" --tile 32", " --seed 6", " --moves 2"}) {
    std::string request = same;
    const std::string key = std::string(other).substr(0, std::string(other).rfind(' '));
    const std::size_t at = request.find(key);
    request.erase(at, request.find(" --", at + 1) - at);
    const auto run = world(request + other);
    EXPECT_EQ(run.status, 2) << other;
    EXPECT_THAT(run.err, HasSubstr("holds another world already"));
  }
}

TEST_F(WorldCommand, RefusesInOneLine) {
  const std::pair<const char*, const char*> refused[] = {
      {"init castle -o v --count 3=1..2", "--count"},
      {"init castle -o v --connect 3", "--connect"},
      {"init castle -o v --mirror x", "--mirror"},
      {"init castle -o v --size 20,20,7", "world"},
      {"init castle -o v --side left=free", "--side"},
      {"init chainmail -o v", "makes no worlds"},
      {"init nothing.txt -o v", "nothing.txt"},
      {"tile w 1048576,0 -o t.txt", "1048575"},
      {"tile w 1 -o t.txt", "two whole numbers"},
      {"tile w 0,0 -o t.bmp", "t.bmp"},
      {"make w --region 0:0,0:4", "holds no tile"},
      {"make w", "--region"},
      {"make nowhere --region 0:1,0:1", "is no world"},
      {"make w --region 0:1,0:1 --formats tiff", "tiff"},
      {"make w --region 0:2,0:2 --formats glb --lod 1", "one level"},
      {"make w --region 0:1048577,0:1", "1048575"},
      {"make w --tiles none.txt", "none.txt"},
      {"plan w --region 0:2,0:2 --as condor", "--as"},
      {"export w --region 0:2,0:2 -o r.xyz", "xyz"},
      {"init castle -o v --turns 4", "--turns"},
      {"init castle -o v --periodic x", "--periodic"},
      {"init castle -o v --frames 4", "--frames"},
      {"init castle -o v --pin 0,0,0=1", "--pin"},
      {"init castle -o v --window 600", "--window"},
      {"init castle -o v --tile 4", "--tile"},
  };
  for (const auto& [arguments, part] : refused) {
    const auto run = world(arguments);
    EXPECT_EQ(run.status, 2) << arguments << run.err;
    EXPECT_THAT(run.err, HasSubstr(part)) << arguments;
    // One line beside those that say how far it is.
    const std::size_t message = run.err.find("exemplar: ");
    ASSERT_NE(message, run.err.npos) << arguments;
    EXPECT_EQ(run.err.find('\n', message), run.err.size() - 1) << run.err;
    EXPECT_FALSE(fs::exists(folder_ / "v")) << arguments;
  }
}

TEST_F(WorldCommand, AnExampleThatRepeatsNowhereIsRefused) {
  // Each label is followed by the next one, and the last by none.
  writeFile(folder_ / "row.txt", "a\nb\nc\n4 2 1\n\n1 2\n3 4\n5 6\n7 8\n");
  const auto run = world("init row.txt -o v");
  EXPECT_EQ(run.status, 3) << run.out;
  EXPECT_THAT(run.err, HasSubstr("repeats over the plane"));
}

TEST_F(WorldCommand, AMachineThatMakesOtherBytesIsRefused) {
  const auto json = nlohmann::json::parse(readFile(folder_ / "w/world.json"));
  const std::string canary = json["canary"]["xxh3"];
  damage("w/world.json", "\"fingerprint\": \"exemplar", "\"fingerprint\": \"another exemplar");
  // The same bytes on another kind of machine: found out once, and believed then.
  EXPECT_EQ(world("make w --region 0:1,0:1 --formats txt").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "w/verified"));
  fs::remove_all(folder_ / "w/verified");
  fs::remove_all(folder_ / "w/tiles");
  damage("w/world.json", canary, "0123456789abcdef");
  const auto run = world("make w --region 0:1,0:1 --formats txt");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("makes other tiles"));
  EXPECT_TRUE(tiles(".txt").empty());
}

TEST_F(WorldCommand, AnotherExampleInItsPlaceIsRefused) {
  std::ofstream(folder_ / "w/example/castle.toml", std::ios::app) << "# more\n";
  const auto run = world("tile w 0,0 -o t.txt");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("is not what the world was made of"));
}

TEST_F(WorldCommand, InterruptedItLeavesWholeTiles) {
  const auto run = interruptExemplar(
      {"world", "make", "w", "--region", "0:40,0:40", "--formats", "txt", "--job", "2"},
      folder_.path(), SIGINT, std::chrono::milliseconds(1500));
  EXPECT_EQ(run.status, 4) << run.err;
  const auto some = tiles(".txt");
  EXPECT_LT(some.size(), 1600u);
  // What is there is what is made without being interrupted.
  fs::remove_all(folder_ / "w/tiles");
  ASSERT_EQ(world("make w --region 0:2,0:2 --formats txt").status, 0);
  for (const auto& [name, bytes] : tiles(".txt")) {
    if (some.contains(name)) {
      EXPECT_TRUE(some.at(name) == bytes) << name;
    }
  }
}

}  // namespace
}  // namespace exemplar
