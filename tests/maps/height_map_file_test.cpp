// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/height_map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "mesh/image.h"
#include "tests/maps/made_maps.h"

namespace exemplar {
namespace {

using test::ascGrid;
using test::hills;
using test::inputError;
using test::kNan;
using test::makeMap;
using test::Read;
using test::readBytes;
using test::readWarned;
using test::sampleMap;
using test::TemporaryFolder;
using test::tiff;
using test::TiffTags;
using test::wholePgm;
using test::writeBytes;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<float> valuesOf(const HeightMap& map) {
  return {map.heights.values().begin(), map.heights.values().end()};
}

/// Equal to the bit, but that any hole is as any other.
bool sameHeights(const Grid<float>& a, const Grid<float>& b) {
  if (!a.sameSize(b)) return false;
  for (std::size_t p = 0; p < a.count(); ++p)
    if (std::isnan(a[p]) ? !std::isnan(b[p]) : a[p] != b[p]) return false;
  return true;
}

TEST(HeightMapFile, KnowsItsEndings) {
  for (const char* name :
       {"a.png", "a.PNG", "a.pgm", "a.Asc", "a.tif", "a.TIFF", "a.exr", "a.r16", "a.raw"})
    EXPECT_TRUE(isHeightMapFile(name));
  for (const char* name : {"a.jpg", "a.obj", "a", "png"}) EXPECT_FALSE(isHeightMapFile(name));
}

TEST(HeightMapFile, ReadsPgmsOfEveryKind) {
  // Row 0 comes first; 16-bit values have their high byte first.
  const HeightMap wide =
      readBytes("a.pgm", wholePgm(30, 20, true), {.cellSize = 2, .heightScale = 0.5});
  EXPECT_EQ(wide.width(), 30);
  EXPECT_EQ(wide.height(), 20);
  EXPECT_EQ(wide.cellSize, 2);
  EXPECT_EQ(wide.at(7, 15), 0.5f * (15 * 30 + 7));
  const HeightMap narrow = readBytes("a.pgm", wholePgm(5, 4, false), {.cellSize = 1});
  EXPECT_EQ(narrow.at(4, 3), 19);
  const HeightMap text = readBytes(
      "a.pgm", "P2 # plain\n3 2\n# five hundred\n500\n1 2 3\n400 500\t0\n", {.cellSize = 1});
  EXPECT_EQ(valuesOf(text), (std::vector<float>{1, 2, 3, 400, 500, 0}));
}

TEST(HeightMapFile, ReadsGrayPngsOfBothDepthsInTheirOwnSteps) {
  const TemporaryFolder folder;
  Image16 deep{3, 2, 1, {0, 1, 2, 500, 40000, 65535}};
  writePng(folder / "a.png", deep);
  EXPECT_EQ(valuesOf(readHeightMap(folder / "a.png", {.cellSize = 1})),
            (std::vector<float>{0, 1, 2, 500, 40000, 65535}));
  Image8 shallow{3, 2, 1, {0, 1, 2, 50, 200, 255}};
  writePng(folder / "b.png", shallow);
  EXPECT_EQ(valuesOf(readHeightMap(folder / "b.png", {.cellSize = 1})),
            (std::vector<float>{0, 1, 2, 50, 200, 255}));
  // Gray stored as color is gray; color is not.
  Image8 color{2, 2, 3, {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}};
  writePng(folder / "c.png", color);
  EXPECT_EQ(valuesOf(readHeightMap(folder / "c.png", {.cellSize = 1})),
            (std::vector<float>{1, 2, 3, 4}));
  color.pixels[4] = 9;
  writePng(folder / "c.png", color);
  EXPECT_THAT(inputError([&] { readHeightMap(folder / "c.png"); }), HasSubstr("gray"));
}

TEST(HeightMapFile, ReadsEsriGrids) {
  const HeightMap map = readBytes("a.asc",
                                  "NCOLS 3\nnrows 2\nxllcorner -1e3\nyllcenter 5\ncellsize "
                                  "30.5\nNODATA_value -9999\n1.5 -2 3e2\n4 5 +6\n");
  EXPECT_EQ(map.width(), 3);
  EXPECT_EQ(map.height(), 2);
  EXPECT_EQ(map.cellSize, 30.5);
  EXPECT_EQ(valuesOf(map), (std::vector<float>{1.5f, -2, 300, 4, 5, 6}));
}

TEST(HeightMap, FillsCellsWithoutDataFromTheirNeighbors) {
  HeightMap map = readBytes(
      "a.asc",
      "ncols 4\nnrows 3\ncellsize 1\nnodata_value -9999\n2 2 4 4\n2 -9999 -9999 4\n-9999 2 4 4\n");
  EXPECT_EQ(rangeOf(map.heights)->holes, 3u);
  EXPECT_TRUE(std::isnan(map.at(1, 1)));
  EXPECT_EQ(fillHoles(map.heights), 3u);
  EXPECT_FLOAT_EQ(map.at(1, 1), (2 + 2 + 4 + 2 + 2 + 4) / 6.0f);  // its neighbor is open as well
  EXPECT_FLOAT_EQ(map.at(2, 1), (2 + 4 + 4 + 4 + 2 + 4 + 4) / 7.0f);
  EXPECT_EQ(fillHoles(map.heights), 0u);
  // A cell deep within a hole is reached ring by ring.
  std::string text = "ncols 7\nnrows 7\ncellsize 1\nnodata_value nan\n";
  for (int p = 0; p < 49; ++p) text += p % 7 == 0 || p < 7 ? "5 " : "nan ";
  Grid<float> filled = readBytes("a.asc", text).heights;
  fillHoles(filled);
  for (const float h : filled.values()) EXPECT_FLOAT_EQ(h, 5);
  EXPECT_THAT(inputError([] {
                readBytes("a.asc", "ncols 2\nnrows 2\ncellsize 1\nnodata_value 0\n0 0 0 0\n");
              }),
              HasSubstr("NODATA"));
}

TEST(HeightMapFile, WithoutUnitsIsFiveReliefsWide) {
  const HeightMap map = readBytes(
      "a.pgm", "P2 11 3 65535\n" + [] {
        std::string text;
        for (int p = 0; p < 33; ++p) text += std::to_string(446 + 40 * (p % 33)) + " ";
        return text;
      }());
  // Relief 1280 over 10 cells: a fifth of the side.
  EXPECT_DOUBLE_EQ(map.cellSize, 5 * 1280 / 10.0);
  EXPECT_EQ(map.heights[0], 446);
  const HeightMap flat = readBytes("a.pgm", "P2 2 2 9 7 7 7 7");
  EXPECT_EQ(flat.cellSize, 1);
}

TEST(HeightMapFile, BytesAreReadAsTheFileIs) {
  const std::string bytes = wholePgm(6, 5, true);
  const HeightMap file = readBytes("a.pgm", bytes), memory = readHeightMap(bytes, "a.pgm", {});
  EXPECT_EQ(memory.heights, file.heights);
  EXPECT_EQ(memory.cellSize, file.cellSize);
  EXPECT_THAT(inputError([&] { readHeightMap(bytes, "a.obj", {}); }), HasSubstr("a.obj"));
}

TEST(HeightMapFile, TextInOtherEncodingsAndWithDecimalCommasIsRead) {
  const std::string text = ascGrid("NODATA_value -9999\n", "7.5");
  std::string returns = text, commas = text, wide = "\xff\xfe";
  std::replace(returns.begin(), returns.end(), '\n', '\r');
  commas.replace(commas.find("7.5"), 3, "7,5");
  for (const char c : text) wide += std::string{c, '\0'};
  for (const std::string& bytes : {"\xef\xbb\xbf" + text, returns, commas, wide}) {
    EXPECT_EQ(readWarned("a.asc", bytes).map.heights[7], 7.5f);
  }
}

TEST(HeightMapFile, AnEsriGridTakesTheUnitsThatAreSet) {
  const std::string text = ascGrid("", "8");
  const HeightMap map = readHeightMap(text, "a.asc", {.cellSize = 2, .heightScale = 0.5});
  EXPECT_EQ(map.cellSize, 2);
  EXPECT_EQ(map.heights[7], 4);
}

TEST(HeightMapFile, CellsInDegreesBecomeMetersAndAreSaid) {
  const std::string heights = "100 200 300\n400 500 600\n700 800 900\n";
  const std::string degrees =
      "ncols 3\nnrows 3\nxllcorner 7.5\nyllcorner 60\ncellsize 0.001\n" + heights;
  const Read read = readWarned("a.asc", degrees);
  // A degree of a sphere of 6371 km is 111,195 m; at 60 degrees north half of that along x, and the
  // root of one half of it for cells of the same area.
  EXPECT_NEAR(read.map.cellSize, 111.195 * std::sqrt(0.5), 0.01);
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("a.asc: its cells of 0.001 degrees")));
  EXPECT_EQ(readWarned("a.asc", degrees, {.cellSize = 90}).map.cellSize, 90);
  // The same numbers on a national grid are in some other unit, which only the user knows.
  const Read other = readWarned(
      "a.asc", "ncols 3\nnrows 3\nxllcorner 600000\nyllcorner 200000\ncellsize 0.001\n" + heights);
  EXPECT_EQ(other.map.cellSize, 0.001);
  EXPECT_THAT(other.warnings, ElementsAre(HasSubstr("`cell-size`")));
}

TEST(HeightMapFile, EqualHeightsStayEqualNumbersThroughEveryPairOfFormats) {
  const char* const names[] = {"a.asc", "a.tif", "a.exr", "a.png", "a.pgm", "a.r16", "a.raw"};
  const TemporaryFolder folder;
  for (const bool whole : {false, true}) {
    for (const bool holes : {false, true}) {
      const HeightMap map = sampleMap(13, 9, whole, holes);
      for (const std::string first : names) {
        for (const std::string second : names) {
          SCOPED_TRACE(first + " " + second + (whole ? " whole" : "") + (holes ? " holes" : ""));
          writeHeightMap(folder / ("1" + first), map);
          const HeightMap once = readHeightMap(folder / ("1" + first));
          writeHeightMap(folder / ("2" + second), once);
          const HeightMap twice = readHeightMap(folder / ("2" + second));
          writeHeightMap(folder / ("1" + first), twice);
          const HeightMap again = readHeightMap(folder / ("1" + first));
          // A file of integers rounds fractions once, to half a step; nothing changes after that.
          const auto step = [](const HeightMap& m) { return m.steps ? m.steps->size : 0; };
          const double rounding = whole ? 0 : step(once) / 2;
          const double more = once.steps || whole ? 0 : step(twice) / 2;
          for (std::size_t p = 0; p < map.heights.count(); ++p) {
            if (std::isnan(map.heights[p])) {
              ASSERT_TRUE(std::isnan(once.heights[p]) && std::isnan(twice.heights[p]));
            } else {
              ASSERT_NEAR(once.heights[p], map.heights[p], rounding);
              ASSERT_NEAR(twice.heights[p], once.heights[p], more);
            }
          }
          ASSERT_TRUE(sameHeights(again.heights, twice.heights));
          for (const HeightMap* m : {&once, &twice, &again}) {
            ASSERT_TRUE(m->cellSizeKnown);
            ASSERT_EQ(m->cellSize, 30);
            ASSERT_EQ(m->corner, map.corner);
          }
        }
      }
    }
  }
}

TEST(HeightMapFile, OddFloatsSurviveWhereThereAreFloats) {
  const TemporaryFolder folder;
  HeightMap map = makeMap(4, 3, 2.5, hills);
  map.cellSizeKnown = true;
  map.heights[0] = 0.1f;
  map.heights[1] = -1.17549435e-38f;
  map.heights[2] = -9999;
  map.heights[3] = -32768;
  map.heights[4] = 9e14f;
  map.heights[5] = kNan;
  for (const char* name : {"a.asc", "a.tif", "a.exr"}) {
    writeHeightMap(folder / name, map);
    EXPECT_TRUE(sameHeights(readHeightMap(folder / name).heights, map.heights)) << name;
  }
  EXPECT_THAT(inputError([&] { writeHeightMap(folder / "a.obj", map); }),
              HasSubstr(".pgm, .r16 or .raw"));
}

TEST(HeightMapFile, ASquareOfIntegersNeedsNothingBesideIt) {
  std::string bytes;
  for (int p = 0; p < 9; ++p) bytes += {static_cast<char>(p), 1};
  const HeightMap map = readHeightMap(bytes, "a.r16", {});
  EXPECT_EQ(map.width(), 3);
  EXPECT_EQ(map.at(2, 1), 256 + 5);
  EXPECT_THAT(inputError([&] { readHeightMap(bytes.substr(2), "a.r16", {}); }),
              HasSubstr("no square"));
}

TEST(HeightMapFile, RawIsOfTheSizeAndTypeThatAreSaid) {
  const TemporaryFolder folder;
  const float heights[] = {0.5f, -2, 3, 1e6f, 7, 8};
  const auto path = folder / "a.raw";
  writeBytes(path, std::string(reinterpret_cast<const char*>(heights), sizeof heights));
  const auto say = [&](const std::string& more) {
    writeBytes(folder / "a.raw.json", R"({"kind": "exemplar height map", )" + more + "}");
  };
  say(R"("width": 3, "height": 2, "type": "float32", "cell_size": 5)");
  const HeightMap map = readHeightMap(path);
  EXPECT_EQ(valuesOf(map), std::vector<float>(std::begin(heights), std::end(heights)));
  EXPECT_EQ(map.width(), 3);
  EXPECT_EQ(map.cellSize, 5);
  EXPECT_FALSE(map.steps);
  say(R"("width": 4, "height": 3, "type": "uint16")");
  EXPECT_EQ(readHeightMap(path).width(), 4);
  say(R"("width": 4, "height": 2, "type": "float32")");
  EXPECT_THAT(inputError([&] { readHeightMap(path); }), HasSubstr("24 bytes are no 4 x 2 floats"));
  say(R"("width": 3, "height": 2, "type": "int8")");
  EXPECT_THAT(inputError([&] { readHeightMap(path); }), HasSubstr("\"type\" must be"));
}

TEST(HeightMapFile, WhatHasNoHeaderSaysBesideThatItIsNoSquare) {
  const TemporaryFolder folder;
  HeightMap map;
  map.heights = Grid<float>(5, 3);
  for (std::size_t p = 0; p < map.heights.count(); ++p) map.heights[p] = static_cast<float>(p);
  for (const char* name : {"a.r16", "a.raw"}) {
    writeHeightMap(folder / name, map);
    EXPECT_EQ(readHeightMap(folder / name).heights, map.heights) << name;
  }
}

TEST(HeightMapFile, ReadsTiffsOfEveryKind) {
  // Integers of either sign, in strips and in either byte order.
  std::string ints;
  for (int p = 0; p < 12; ++p) ints += {static_cast<char>(p), static_cast<char>(p < 6 ? 0 : 0xff)};
  const HeightMap plain =
      readHeightMap(tiff({.width = 4, .height = 3, .bits = 16}, ints), "a.tif", {});
  EXPECT_EQ(plain.at(1, 0), 1);
  EXPECT_EQ(plain.at(3, 2), 0xff00 + 11);
  EXPECT_EQ(plain.steps->largest, 65535);
  EXPECT_FALSE(plain.cellSizeKnown);
  const HeightMap negative =
      readHeightMap(tiff({.width = 4, .height = 3, .bits = 16, .format = 2}, ints), "a.tif", {});
  EXPECT_EQ(negative.at(3, 2), -256 + 11);
  // What GDAL writes: cells, where they lie, and the height of holes.
  TiffTags tags{.width = 4, .height = 3, .bits = 16, .format = 2};
  tags.noData = "-245";
  tags.scale = {30, 30, 0};
  tags.tie = {0, 0, 0, 1000, 2000, 0};
  const HeightMap placed = readHeightMap(tiff(tags, ints), "a.tif", {});
  EXPECT_TRUE(std::isnan(placed.at(3, 2)));
  EXPECT_EQ(placed.at(2, 2), -246);
  EXPECT_TRUE(placed.cellSizeKnown);
  EXPECT_EQ(placed.cellSize, 30);
  EXPECT_EQ(placed.corner, (MapCorner{1000, 2000 - 90}));
  // Degrees; cells that are not square.
  tags.scale = {0.001, 0.001, 0};
  tags.tie = {0, 0, 0, 7.5, 60.003, 0};
  tags.keys = {1, 1, 0, 1, 1024, 0, 1, 2};
  const Read degrees = readWarned("a.tif", tiff(tags, ints));
  EXPECT_NEAR(degrees.map.cellSize, 111.195 * std::sqrt(0.5), 0.01);
  EXPECT_THAT(degrees.warnings, ElementsAre(HasSubstr("a.tif: its cells of 0.001 degrees")));
  tags.scale = {30, 20, 0};
  EXPECT_THAT(inputError([&] { readHeightMap(tiff(tags, ints), "a.tif", {}); }),
              HasSubstr("must be square"));
  EXPECT_EQ(readHeightMap(tiff(tags, ints), "a.tif", {.cellSize = 25}).cellSize, 25);
}

/// The bytes that hexadecimal digits encode.
std::string fromHex(const std::string& digits) {
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return bytes;
}

TEST(HeightMapFile, APalettesDepthIsNotThatOfItsGrays) {
  // 4 x 4 pixels, gray 100 to 115, as indices of 4 and of 8 bits into the same palette.
  const std::string four = fromHex(
      "89504e470d0a1a0a0000000d49484452000000040000000404030000005bdf834d00000030504c5445646464"
      "6565656666666767676868686969696a6a6a6b6b6b6c6c6c6d6d6d6e6e6e6f6f6f7070707171717272727373"
      "73101dd2ee000000144944415478da63605466704d67e85ccd70f63d000e5003c1290f76060000000049454e"
      "44ae426082");
  const std::string eight = fromHex(
      "89504e470d0a1a0a0000000d49484452000000040000000408030000009e2f6e4c00000030504c5445646464"
      "6565656666666767676868686969696a6a6a6b6b6b6c6c6c6d6d6d6e6e6e6f6f6f7070707171717272727373"
      "73101dd2ee0000001c4944415478da6360606462666061656367e0e0e4e266e0e1e5e307000320007995fb03"
      "960000000049454e44ae426082");
  for (const std::string& bytes : {four, eight}) {
    const HeightMap map = readHeightMap(bytes, "a.png", {});
    for (int p = 0; p < 16; ++p) EXPECT_EQ(map.heights[p], 100 + p);
    EXPECT_DOUBLE_EQ(map.cellSize, 5 * 15 / 3.0);
    EXPECT_EQ(map.steps->largest, 255);
  }
}

TEST(HeightMapFile, TransparentPixelsHaveNoHeight) {
  const TemporaryFolder folder;
  Image8 image{3, 3, 2, {}};
  for (int p = 0; p < 9; ++p) {
    image.pixels.push_back(static_cast<std::uint8_t>(p == 4 ? 0 : 10));
    image.pixels.push_back(p == 4 ? 0 : 255);
  }
  writePng(folder / "a.png", image);
  const Read read = readWarned("a.png", readFile(folder / "a.png"));
  for (int p = 0; p < 9; ++p) EXPECT_EQ(std::isnan(read.map.heights[p]), p == 4);
  EXPECT_EQ(read.map.heights[3], 10);
}

TEST(HeightMapFile, WritesMapsOfFewBitsAsBrightAsTheyWere) {
  for (const char* name : {"o.png", "o.pgm"}) {
    const TemporaryFolder folder;
    Warnings warnings;
    HeightMap map = readHeightMap(wholePgm(16, 16, false), "a.pgm", {.heightScale = 3});
    ASSERT_TRUE(map.steps.has_value());
    EXPECT_EQ(map.steps->largest, 255);
    EXPECT_EQ(map.heights[200], 600);
    writeHeightMap(folder / name, map, {.warnings = &warnings});
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("its integers count steps of")));
    EXPECT_TRUE(sameHeights(readHeightMap(folder / name).heights, map.heights)) << name;
    std::filesystem::remove(heightSidecarPath(folder / name));
    const HeightMap back = readHeightMap(folder / name);
    EXPECT_EQ(back.steps->largest, 65535);
    for (int p = 0; p < 256; ++p) EXPECT_EQ(back.heights[p], 257.0f * p) << name;
  }
}

TEST(HeightMapFile, IntegersAreNeverStretched) {
  const TemporaryFolder folder;
  Warnings warnings;
  HeightMap map = makeMap(16, 16, 1, [](double x, double y) { return (16 * y + x) / 256 * 4 - 3; });
  writeHeightMap(folder / "o.png", map, {.warnings = &warnings});
  // 4 in steps of a power of two: 2^-13 makes 32,768 of them, so that 2^-14 hold it.
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("count steps of 6.103515625e-05 from a height of")));
  const HeightMap back = readHeightMap(folder / "o.png");
  for (int p = 0; p < 256; ++p) EXPECT_NEAR(back.heights[p], map.heights[p], 6.2e-5 / 2);
  // What the user asks for is done, and what it costs is said.
  warnings.clear();
  map.heights[0] = 1e9f;
  writeHeightMap(folder / "o.png", map, {.heightScale = 1, .warnings = &warnings});
  EXPECT_THAT(warnings, Contains(HasSubstr("o.png: 1 of 256 heights are outside of ")));
  warnings.clear();
  map.heights[0] = 0;
  writeHeightMap(folder / "o.png", map, {.heightScale = 1, .warnings = &warnings});
  EXPECT_THAT(warnings, Contains(HasSubstr("span only")));
  // Whole heights stay whole; where nothing has to be said, nothing is beside the file.
  for (float& h : map.heights.values()) h = std::round(100 * h + 300);
  writeHeightMap(folder / "o.png", map);
  EXPECT_FALSE(std::filesystem::exists(heightSidecarPath(folder / "o.png")));
  EXPECT_TRUE(sameHeights(readHeightMap(folder / "o.png").heights, map.heights));
}

TEST(HeightMapFile, WhatStandsBesideAFileIsKeptApart) {
  const TemporaryFolder folder;
  HeightMap map = makeMap(16, 16, 30, [](double x, double y) { return x / 7 - y; });
  map.cellSizeKnown = true;
  // Something else of that name is not overwritten.
  writeBytes(folder / "o.png.json", "{\"mine\": 1}");
  EXPECT_THAT(inputError([&] { writeHeightMap(folder / "o.png", map); }),
              HasSubstr("is there and is something else"));
  EXPECT_FALSE(std::filesystem::exists(folder / "o.png"));
  writeHeightMap(folder / "p.png", map);
  EXPECT_EQ(readHeightMap(folder / "p.png").cellSize, 30);
  // What the user says counts more.
  const HeightMap said = readHeightMap(folder / "p.png", {.cellSize = 5, .heightScale = 2});
  EXPECT_EQ(said.cellSize, 5);
  EXPECT_EQ(said.steps->size, 2);
  EXPECT_EQ(said.steps->offset, 0);
  // Another picture's: not used, and said.
  writePng(folder / "p.png", Image16{2, 2, 1, {1, 2, 3, 4}});
  Warnings warnings;
  EXPECT_EQ(readHeightMap(folder / "p.png", {.warnings = &warnings}).at(1, 1), 4);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("the .json beside it is for 16 x 16 points")));
  // Damaged: said.
  const std::string kind = "{\"kind\": \"exemplar height map\", ";
  for (const char* bad : {"\"height_step\": 0}", "\"cell_size\": \"x\"}", "\"no_data\": 70000}",
                          "\"height_offset\": null}"}) {
    writeBytes(folder / "p.png.json", kind + bad);
    EXPECT_THAT(inputError([&] { readHeightMap(folder / "p.png"); }), HasSubstr("p.png.json"));
  }
  writeBytes(folder / "p.png.json", "no json");
  EXPECT_EQ(readHeightMap(folder / "p.png").at(1, 1), 4);
}

}  // namespace
}  // namespace exemplar
