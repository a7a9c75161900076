// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Terrain as a user asks for it: what stays, what guides, what gets detail.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "maps/height_map_file.h"
#include "mesh/image.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::Not;

class TerrainCommand : public testing::Test {
 protected:
  TerrainCommand() { writeHeightMap(folder_ / "e.asc", hills(64, 64, 10)); }

  static HeightMap hills(int width, int height, double cell, double phase = 0) {
    HeightMap map{Grid<float>(width, height), cell, true};
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        map.heights(x, y) = static_cast<float>(
            200 + 60 * std::sin(0.11 * x + phase) * std::cos(0.09 * y) +
            20 * std::sin(0.31 * x + 0.27 * y) + 6 * std::cos(0.7 * x - 0.5 * y + phase));
      }
    }
    return map;
  }
  void paint(const char* name, int side, const std::function<bool(int, int)>& white) const {
    Image8 picture{side, side, 1, {}};
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        picture.pixels.push_back(white(x, y) ? std::uint8_t{255} : std::uint8_t{0});
    writePng(folder_ / name, picture);
  }
  HeightMap synth(const std::string& arguments) const {
    const auto run = runExemplar("synth e.asc " + arguments + " -o o.asc", folder_.path());
    EXPECT_EQ(run.status, 0) << run.err;
    return readHeightMap(folder_ / "o.asc");
  }

  TestFolder folder_;
};

TEST_F(TerrainCommand, KeepsWhatIsWhiteToTheBit) {
  paint("keep.png", 64, [](int x, int y) { return x >= 20 && x < 44 && y >= 24 && y < 40; });
  const HeightMap example = hills(64, 64, 10), middle = synth("--keep keep.png --blend 8"),
                  corner = synth("--keep keep.png --keep-at 0,64");
  int different = 0;
  for (int y = 24; y < 40; ++y) {
    for (int x = 20; x < 44; ++x) {
      ASSERT_EQ(middle.at(x + 32, y + 32), example.at(x, y));
      ASSERT_EQ(corner.at(x, y + 64), example.at(x, y));
      different += corner.at(x + 32, y + 32) != example.at(x, y);
    }
  }
  EXPECT_GT(different, 300);
}

TEST_F(TerrainCommand, ComparesEnginesByHeights) {
  const auto run = runExemplar(
      "compare e.asc -o c --seeds 2 --scale 1.5,1.5,1 --size 160x120 --engines "
      "terrain,terrain:keep-hollows=true,model",
      folder_.path());
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(readFile(folder_ / "c" / "compare.json"));
  ASSERT_EQ(json.at("runs").size(), 6u);
  for (const auto& one : json.at("runs")) {
    if (one.at("engine") == "model") {
      EXPECT_EQ(one.at("status"), "refused");
      EXPECT_THAT(one.at("why").get<std::string>(), HasSubstr("makes no heights"));
      continue;
    }
    ASSERT_EQ(one.at("status"), "complete") << one;
    const HeightMap made = readHeightMap(folder_ / "c" / one.at("heights").get<std::string>());
    EXPECT_EQ(made.width(), 96);
    EXPECT_EQ(made.cellSize, 10);
    // The same figures as of the file.
    const auto& terrain = one.at("figures").at("terrain");
    const double relief = terrain.at("relief");
    EXPECT_NEAR(relief, rangeOf(made.heights)->relief(), 1e-3 * relief);
    // Hills between hollows, of which a result has as many.
    const double flooded = terrain.at("flooded_share"),
                 wanted = terrain.at("flooded_share_example");
    EXPECT_GT(wanted, 0.05);
    if (one.at("engine") == "terrain") {
      EXPECT_LE(flooded, 2 * wanted);
    }
  }
  // Seeds of terrain are land of their own.
  EXPECT_THAT(run.out, HasSubstr("Div of 2 seeds"));
  ASSERT_EQ(json.at("seeds").size(), 2u);
  for (const auto& seeds : json.at("seeds")) {
    EXPECT_EQ(seeds.at("results"), 2);
    EXPECT_GT(seeds.at("rolled_diversity"), 0.3);
    EXPECT_LE(seeds.at("rolled_diversity"), seeds.at("diversity"));
    EXPECT_TRUE(seeds.at("equal").empty());
  }
  for (const char* file :
       {"example.png", "compare.png", "terrain-1.png", "terrain-seeds.png", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "c" / file)) << file;
}

TEST_F(TerrainCommand, AMaskLeavesTheBaseWhereItIsBlack) {
  const HeightMap base = hills(96, 96, 10, 2);
  writeHeightMap(folder_ / "b.asc", base);
  paint("mask.png", 96, [](int x, int) { return x >= 60; });
  const HeightMap result = synth("--base b.asc --mask mask.png --size 96,96,1 --seed 3");
  int different = 0;
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (x < 60) {
        ASSERT_EQ(result.at(x, y), base.at(x, y));
      } else {
        different += result.at(x, y) != base.at(x, y);
      }
    }
  }
  EXPECT_GT(different, 96 * 30);
}

TEST_F(TerrainCommand, GivesACoarseTerrainTheExamplesDetail) {
  HeightMap coarse = hills(30, 24, 40);
  coarse.corner = MapCorner{500, 700};
  writeHeightMap(folder_ / "c.asc", coarse);
  const HeightMap result = synth("--detail-of c.asc --keep-hollows");
  ASSERT_EQ(result.width(), 120);
  ASSERT_EQ(result.height(), 96);
  EXPECT_EQ(result.cellSize, 10);
  EXPECT_EQ(result.corner, coarse.corner);
  double error = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 30; ++x) {
      double mean = 0;
      for (int v = 0; v < 4; ++v)
        for (int u = 0; u < 4; ++u) mean += result.at(4 * x + u, 4 * y + v) / 16;
      error += std::abs(mean - coarse.at(x, y)) / (24 * 30);
    }
  }
  // Of a relief of about 170.
  EXPECT_LT(error, 12);
}

TEST_F(TerrainCommand, ScalesOnlyFilesOfTheExamplesKind) {
  HeightMap gray = hills(64, 64, 10);
  writeHeightMap(folder_ / "e.pgm", gray);
  writeHeightMap(folder_ / "c.asc", hills(30, 24, 40));
  const auto run = runExemplar(
      "synth e.pgm --height-scale 0.01 --cell-size 10 --detail-of c.asc -o o.asc", folder_.path());
  ASSERT_EQ(run.status, 0) << run.err;
  const HeightRange made = *rangeOf(readHeightMap(folder_ / "o.asc").heights),
                    wanted = *rangeOf(hills(30, 24, 40).heights);
  // Detail and outlets go beyond the coarse heights by some tens; a hundredth of them is far off.
  EXPECT_NEAR(made.low, wanted.low, 60);
  EXPECT_NEAR(made.high, wanted.high, 60);
}

TEST_F(TerrainCommand, FollowsPaintedHeightsAndLines) {
  paint("guide.png", 32, [](int x, int) { return x >= 16; });
  const HeightMap painted = synth("--guide guide.png --follow 1");
  // x from the west, y from the south: cells of 10, 128 x 128 points.
  writeFile(folder_ / "lines.csv",
            "# one of each\nridge 320,60 320,1200\nvalley 960,1200 960,60,120\n");
  const HeightMap lines = synth("--guide lines.csv --follow 1");
  double west = 0, east = 0, ridge = 0, valley = 0;
  for (int y = 10; y < 118; ++y) {
    for (int x = 20; x < 44; ++x) west += painted.at(x, y), ridge += lines.at(x, y);
    for (int x = 84; x < 108; ++x) east += painted.at(x, y), valley += lines.at(x, y);
  }
  constexpr int kCount = 108 * 24;
  EXPECT_GT((east - west) / kCount, 60);
  EXPECT_GT((ridge - valley) / kCount, 30);
}

TEST_F(TerrainCommand, FillsHolesOrKeepsThem) {
  HeightMap holed = hills(96, 96, 10);
  holed.corner = MapCorner{10, 20};
  for (int y = 40; y < 64; ++y)
    for (int x = 30; x < 58; ++x) holed.heights(x, y) = std::nanf("");
  writeHeightMap(folder_ / "h.asc", holed);
  const auto of = [&](const std::string& arguments) {
    const auto run = runExemplar("synth h.asc " + arguments + " -o o.asc", folder_.path());
    EXPECT_EQ(run.status, 0) << run.err;
    return readHeightMap(folder_ / "o.asc");
  };
  const HeightMap filled = of("--fill");
  ASSERT_EQ(filled.width(), 96);
  EXPECT_EQ(filled.corner, holed.corner);
  for (int y = 0; y < 96; ++y) {
    for (int x = 0; x < 96; ++x) {
      ASSERT_FALSE(std::isnan(filled.at(x, y)));
      if (!std::isnan(holed.at(x, y))) {
        ASSERT_EQ(filled.at(x, y), holed.at(x, y));
      }
    }
  }
  // No step at the hole's border beyond those of the land.
  double across = 0, usual = 0;
  for (int y = 40; y < 64; ++y) {
    across += std::abs(filled.at(30, y) - filled.at(29, y));
    usual += std::abs(filled.at(29, y) - filled.at(28, y));
  }
  EXPECT_LT(across, 2.5 * usual);
  const auto holes = [](const HeightMap& map) {
    std::size_t count = 0;
    for (const float h : map.heights.values()) count += std::isnan(h);
    return static_cast<double>(count) / static_cast<double>(map.heights.count());
  };
  EXPECT_EQ(holes(of("--seed 1")), 0);
  const double kept = holes(of("--keep-holes --seed 1"));
  EXPECT_GT(kept, 0.2 * holes(holed));
  EXPECT_LT(kept, 5 * holes(holed));
}

TEST_F(TerrainCommand, JoinsTilesAndSaysWhichDoNotLineUp) {
  const HeightMap whole = hills(120, 64, 10);
  const auto tile = [&](const char* name, double west, float times) {
    HeightMap part{Grid<float>(60, 64), 10, true};
    const int from = west < 600 ? 0 : 60;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 60; ++x) part.heights(x, y) = times * whole.at(from + x, y);
    part.corner = MapCorner{west, 0};
    writeHeightMap(folder_ / name, part);
  };
  tile("west.asc", 0, 1);
  tile("east.asc", 600, 1);
  tile("off.asc", 604, 1);
  tile("feet.asc", 600, 3.28f);
  const auto of = [&](const std::string& other) {
    const auto run =
        runExemplar("synth west.asc --with " + other + " --scale 1,1,1 -o o.asc", folder_.path());
    EXPECT_EQ(run.status, 0) << run.err;
    return run;
  };
  const auto joined = of("east.asc");
  EXPECT_THAT(joined.out, HasSubstr("2 tiles side by side, joined: height map of 120 x 64"));
  EXPECT_THAT(joined.err, Not(HasSubstr("warning")));
  EXPECT_EQ(readHeightMap(folder_ / "o.asc").width(), 120);
  EXPECT_THAT(of("off.asc").err,
              HasSubstr("off.asc: lies 60.4 cells east and 0 north of west.asc, not whole"));
  EXPECT_EQ(readHeightMap(folder_ / "o.asc").width(), 60);
  EXPECT_THAT(of("feet.asc").err, HasSubstr("feet.asc: its heights differ by"));
}

TEST_F(TerrainCommand, SaysWhatIsDoubtfulAboutAMapAndWhatToDo) {
  HeightMap holed = hills(64, 64, 10), flat = holed;
  for (int x = 20; x < 40; ++x) holed.heights(x, 30) = std::nanf("");
  for (float& h : flat.heights.values()) h = 7;
  writeHeightMap(folder_ / "holes.asc", holed);
  writeHeightMap(folder_ / "flat.asc", flat);
  Image8 gray{64, 64, 1, {}}, palette{64, 64, 3, {}};
  for (int p = 0; p < 64 * 64; ++p) {
    const auto h =
        static_cast<std::uint8_t>(hills(64, 64, 10).heights[static_cast<std::size_t>(p)] / 2);
    gray.pixels.push_back(h);
    for (const int share : {1, 2, 3})
      palette.pixels.push_back(static_cast<std::uint8_t>(h / share));
  }
  writePng(folder_ / "gray.png", gray);
  writePng(folder_ / "color.png", palette);
  const auto err = [&](const std::string& arguments, int status) {
    const auto run = runExemplar("synth " + arguments + " -o o.tif", folder_.path());
    EXPECT_EQ(run.status, status) << arguments << run.err;
    return run.err;
  };
  EXPECT_THAT(err("holes.asc", 0), HasSubstr("nothing is made of its 20 points without data; "
                                             "--fill makes land of them"));
  EXPECT_THAT(err("holes.asc --fill", 0), Not(HasSubstr("nothing is made")));
  EXPECT_THAT(err("holes.asc --keep-holes", 0), Not(HasSubstr("nothing is made")));
  EXPECT_THAT(err("flat.asc", 0), HasSubstr("all its heights are 7"));
  EXPECT_THAT(err("gray.png", 0), HasSubstr("terraces on slopes; save it with 16 bits"));
  EXPECT_THAT(err("color.png --engine terrain", 2), HasSubstr("a height map must be gray"));
  writeHeightMap(folder_ / "coarse.asc", hills(64, 64, 20));
  EXPECT_THAT(err("e.asc --with coarse.asc", 2), HasSubstr("have cells of one size"));
  writeHeightMap(folder_ / "small.asc", hills(12, 40, 10));
  EXPECT_THAT(err("small.asc", 2), HasSubstr("at least 16 x 16 samples"));
  writeFile(folder_ / "rect.asc", "ncols 2\nnrows 2\ndx 1\ndy 2\n1 2 3 4\n");
  EXPECT_THAT(err("rect.asc", 2), HasSubstr("cells must be square"));
}

TEST_F(TerrainCommand, RefusesWhatCannotBeInOneLine) {
  writeFile(folder_ / "bad.csv", "ridge 1,2 3,4\nriver 1,2\n");
  writeFile(folder_ / "odd.csv", "ridge 1,2,3,4\n");
  writeFile(folder_ / "none.csv", "# nothing\n");
  writeHeightMap(folder_ / "fine.asc", hills(40, 40, 5));
  paint("black.png", 16, [](int, int) { return false; });
  for (const auto& [arguments, says] : std::vector<std::pair<std::string, std::string>>{
           {"--base e.asc", "--base: say with --mask"},
           {"--keep-at 3,4", "--keep-at: say with --keep"},
           {"--detail-of e.asc --scale 2,2,1", "says the size already"},
           {"--detail-of fine.asc", "with cells 1.2 to 64 times as large"},
           {"--guide bad.csv", "bad.csv:2: 'river'; expected ridge or valley"},
           {"--guide odd.csv", "odd.csv:1: '1,2,3,4'; expected a point"},
           {"--guide none.csv", "no ridge and no valley"},
           {"--guide shape.obj", "is a height map"},
           {"--keep black.png", "nothing of it is white"},
           {"--mask black.png --size 70,70,1", "has the size of the result, 70 x 70"},
           {"--orientations 3", "--orientations 3: expected 1, 2, 4 or 8"},
           {"--size 10,40,1", "the result would have 10"},
           {"--fill", "has data everywhere"},
           {"--fill --scale 2,2,1", "at its own size"},
           {"--fill --keep black.png", "have no meaning beside it"},
           {"--piece-size 4", "8"},
           {"--periodic z", "height maps tile along x and y"}}) {
    const auto run = runExemplar("synth e.asc " + arguments + " -o o.tif", folder_.path());
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(says)) << arguments;
  }
}

}  // namespace
}  // namespace exemplar
