// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Worlds of heights as a user makes them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "core/file.h"
#include "maps/height_map_file.h"
#include "mesh/mesh_file.h"
#include "tests/apps/run_command.h"
#include "tests/synth/terrain/height_samples.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kTile = 48;

/// One world for all tests: of mountains with cells of 10, smaller tiles than windows.
class HeightWorldCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    if (folder_) {
      fs::remove_all(*folder_ / "w/tiles");
      return;
    }
    folder_ = std::make_unique<TestFolder>();
    writeHeightMap(*folder_ / "e.asc", {testing::ridges(64, 64, 1), 10, true, {}, {}});
    const auto run = world("init e.asc -o w --tile 48 --window 96 --seed 5");
    ASSERT_EQ(run.status, 0) << run.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static CommandResult world(const std::string& arguments) {
    return runExemplar("world " + arguments, folder_->path());
  }
  static HeightMap tile(const std::string& name) {
    return readHeightMap(*folder_ / "w/tiles/0" / name);
  }

  static std::unique_ptr<TestFolder> folder_;
};
std::unique_ptr<TestFolder> HeightWorldCommand::folder_;

TEST_F(HeightWorldCommand, TilesShareARowAndAScaleAndFit) {
  const auto made = world("make w --region -1:1,0:2 --formats tif,png,glb --cache --threads 8");
  ASSERT_EQ(made.status, 0) << made.err;
  const HeightMap west = tile("-1/0.png"), east = tile("0/0.png"), north = tile("-1/1.png");
  ASSERT_EQ(west.width(), kTile + 1);
  ASSERT_EQ(west.height(), kTile + 1);
  for (int k = 0; k <= kTile; ++k) {
    EXPECT_EQ(west.heights(kTile, k), east.heights(0, k));
    EXPECT_EQ(west.heights(k, 0), north.heights(k, kTile));
  }
  EXPECT_EQ(west.steps->size, north.steps->size);
  EXPECT_EQ(west.steps->offset, north.steps->offset);
  EXPECT_EQ(west.corner->west, -10 * kTile);
  EXPECT_EQ(north.corner->south, 10 * kTile);

  const auto sound = world("check w --region -1:1,0:2 --remake 100 --cache");
  EXPECT_EQ(sound.status, 0) << sound.err;
  EXPECT_THAT(sound.out, HasSubstr("196 points of two tiles, 0 not at one height"));
  EXPECT_THAT(sound.out, HasSubstr("12, 12 of them made again, 0 not the same bytes"));
  EXPECT_THAT(sound.out, HasSubstr("384 edges of meshes between tiles, 0 unmatched"));
  // A tile of another place is found out.
  fs::copy_file(*folder_ / "w/tiles/0/0/0.glb", *folder_ / "w/tiles/0/-1/1.glb",
                fs::copy_options::overwrite_existing);
  const auto bad = world("check w --region -1:1,0:2 --remake 100 --cache");
  EXPECT_EQ(bad.status, 3);
  EXPECT_THAT(bad.err, HasSubstr("1.glb is not what this machine makes"));
}

TEST_F(HeightWorldCommand, NormalsAreTheNeighborsToo) {
  // In the files, for readers find their own: the last columns of one tile and the first of the
  // next have the same bytes at the same place of each row.
  const auto made = world("make w --region 0:2,0:1 --formats gltf --cache");
  ASSERT_EQ(made.status, 0) << made.err;
  const auto normalsOf = [&](const char* name) {
    const auto json = nlohmann::json::parse(readFile(*folder_ / "w/tiles/0" / name));
    const auto& primitive = json["meshes"][0]["primitives"][0]["attributes"];
    const auto& accessor = json["accessors"][primitive["NORMAL"].get<int>()];
    const auto& view = json["bufferViews"][accessor["bufferView"].get<int>()];
    EXPECT_EQ(accessor["count"], (kTile + 1) * (kTile + 1));
    const std::string uri = json["buffers"][0]["uri"];
    const std::string text = uri.substr(uri.find(',') + 1);
    std::string bytes;
    std::uint32_t bits = 0;
    int have = 0;
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (const char c : text) {
      if (c == '=') break;
      bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
      if ((have += 6) >= 8) bytes += static_cast<char>(bits >> (have -= 8) & 0xff);
    }
    return bytes.substr(view.value("byteOffset", 0), 12 * (kTile + 1) * (kTile + 1));
  };
  const std::string west = normalsOf("0/0.gltf"), east = normalsOf("1/0.gltf");
  for (int row = 0; row <= kTile; ++row) {
    const std::size_t first = 12 * static_cast<std::size_t>(row * (kTile + 1));
    EXPECT_EQ(west.substr(first + 12 * kTile, 12), east.substr(first, 12)) << row;
  }
  EXPECT_NE(west, east);
}

TEST_F(HeightWorldCommand, ATileIsTheSameAloneWithoutACache) {
  ASSERT_EQ(world("make w --region -1:1,0:2 --formats tif --cache --threads 8").status, 0);
  ASSERT_EQ(world("tile w -1,1 -o alone.tif --threads 1").status, 0);
  EXPECT_TRUE(readFile(*folder_ / "alone.tif") == readFile(*folder_ / "w/tiles/0/-1/1.tif"));
}

TEST_F(HeightWorldCommand, ExportIsWhatItsTilesAre) {
  ASSERT_EQ(world("make w --region 0:2,0:1 --formats tif --cache").status, 0);
  ASSERT_EQ(world("export w --region 0:2,0:1 -o r.asc --cache").status, 0);
  const HeightMap all = readHeightMap(*folder_ / "r.asc"), east = tile("1/0.tif");
  ASSERT_EQ(all.width(), 2 * kTile + 1);
  int different = 0;
  for (int y = 0; y <= kTile; ++y)
    for (int x = 0; x <= kTile; ++x) different += all.heights(kTile + x, y) != east.heights(x, y);
  EXPECT_EQ(different, 0);
}

TEST_F(HeightWorldCommand, CoarserTilesHaveTheWorldsPointsAndLeaveNoGap) {
  const auto made = world("make w --region -2:1,0:2 --formats glb --lod 2 --cache");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("1 coarser tile made"));
  EXPECT_FALSE(fs::exists(*folder_ / "w/tiles/1/0")) << "only what the region holds whole";
  const TriangleMesh coarse = readMesh(*folder_ / "w/tiles/1/-1/0.glb");
  ASSERT_EQ(world("export w --region -2:0,0:2 -o all.tif --cache").status, 0);
  const HeightMap all = readHeightMap(*folder_ / "all.tif");
  std::map<std::pair<int, int>, double> heights;
  for (const Vec3d& p : coarse.positions) {
    const int i = static_cast<int>(std::lround(p.x / 10)),
              j = static_cast<int>(std::lround(p.y / 10));
    EXPECT_EQ(static_cast<float>(p.z), all.at(i, 2 * kTile - j)) << i << " " << j;
    heights[{i, j}] = p.z;
  }
  for (int i = 0; i <= 2 * kTile; ++i) {
    for (const int j : {0, 2 * kTile}) {
      EXPECT_TRUE(heights.contains({i, j})) << "the border has all points";
      EXPECT_TRUE(heights.contains({j, i}));
    }
  }
  EXPECT_FALSE(heights.contains({1, 1})) << "and the inside every other one";
  const auto said = nlohmann::json::parse(readFile(*folder_ / "w/tiles/1/-1/0.json"));
  const double error = said["error"];
  // Half way along an edge that is in every cut of the coarse surface.
  double largest = 0;
  for (int i = 1; i < 2 * kTile; i += 2) {
    for (int row = 0; row <= 2 * kTile; row += 2) {
      const double between = (static_cast<double>(all.at(i - 1, row)) + all.at(i + 1, row)) / 2;
      largest = std::max(largest, std::abs(between - all.at(i, row)));
    }
  }
  EXPECT_GT(error, 0);
  EXPECT_GE(error, largest - 1e-4);
  EXPECT_LT(error, 3 * largest);

  // The tileset shows it first, where its tiles are, and goes on to them.
  ASSERT_EQ(world("index w").status, 0);
  const auto tileset = nlohmann::json::parse(readFile(*folder_ / "w/tileset.json"));
  int found = 0;
  const auto look = [&](const auto& self, const nlohmann::json& node, double frame) -> void {
    if (node.contains("transform")) frame += node["transform"][12].get<double>();
    if (node.contains("content") && node["content"]["uri"] == "tiles/1/-1/0.glb") {
      ++found;
      EXPECT_EQ(node["refine"], "REPLACE");
      EXPECT_EQ(node["geometricError"], error);
      EXPECT_EQ(node["children"].size(), 4u);
      EXPECT_EQ(frame, -2 * 10 * kTile);
      // Moved against what is above them.
      std::set<double> east;
      for (const auto& tile : node["children"]) east.insert(tile["transform"][12].get<double>());
      EXPECT_EQ(east, (std::set<double>{0, 10 * kTile}));
    }
    if (node.contains("children"))
      for (const auto& child : node["children"]) self(self, child, frame);
  };
  look(look, tileset["root"], 0);
  EXPECT_EQ(found, 1);
  // A tile that is not there any more is not covered up.
  fs::remove(*folder_ / "w/tiles/0/-1/1.glb");
  ASSERT_EQ(world("index w").status, 0);
  EXPECT_EQ(readFile(*folder_ / "w/tileset.json").find("tiles/1/"), std::string::npos);
}

TEST_F(HeightWorldCommand, RefusesInOneLine) {
  const std::pair<const char*, const char*> refused[] = {
      {"init e.asc -o v --window 24", "--window"},
      {"init e.asc -o v --height 4", "--height"},
      {"init e.asc -o v --fill", "whole map"},
      {"init e.asc -o v --keep-holes", "whole map"},
      {"init e.asc -o v --scale 2,2,1", "world"},
      {"init e.asc -o w --tile 48 --window 96 --seed 6", "holds another world already"},
      {"make w --region 0:1,0:1 --formats vox", "vox"},
      {"make w --region 0:2,0:2 --formats tif --lod 1", "glb"},
      {"make w --region 0:2,0:2 --formats glb --lod 5", "--lod"},
      {"make w --region 1048575:1048577,0:1", "1048575"},
      {"plan w --region 0:4 --as json", "0:4"},
      {"check w --region 4:0,0:4", "4:0"},
      {"export w --region 0:1,0:1 -o r.vdb", "vdb"},
  };
  for (const auto& [arguments, part] : refused) {
    const auto run = world(arguments);
    EXPECT_EQ(run.status, 2) << arguments << run.err;
    EXPECT_THAT(run.err, HasSubstr(part)) << arguments;
    EXPECT_FALSE(fs::exists(*folder_ / "v")) << arguments;
  }
}

}  // namespace
}  // namespace exemplar
