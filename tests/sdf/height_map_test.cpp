// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/height_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/file.h"
#include "mesh/image.h"
#include "mesh/mesh_health.h"
#include "sdf/triangle_tree.h"
#include "tests/sdf/cancellation.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::inputError;
using test::TemporaryFolder;
using test::withThreads;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

HeightMap makeMap(int width, int height, double cellSize,
                  const std::function<double(double, double)>& f) {
  HeightMap map{width, height, {}, cellSize};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      map.heights.push_back(
          static_cast<float>(f(column * cellSize, (height - 1 - row) * cellSize)));
  return map;
}

// Rolling hills, no steeper than 45 degrees.
double hills(double x, double y) {
  return 3 + 0.6 * std::sin(1.1 * x) + 0.5 * std::cos(0.9 * y + 0.4 * x);
}

std::string wholePgm(int width, int height, bool wide) {
  std::string bytes = "P5\n# a comment\n" + std::to_string(width) + " " + std::to_string(height) +
                      "\n" + (wide ? "65535\n" : "255\n");
  for (int p = 0; p < width * height; ++p) {
    if (wide) bytes += static_cast<char>(p >> 8);
    bytes += static_cast<char>(p & 0xff);
  }
  return bytes;
}

// Reads a file with this content.
HeightMap readBytes(const std::string& name, const std::string& bytes,
                    const HeightMapFileOptions& options = {}) {
  static const TemporaryFolder folder;
  test::writeBytes(folder / name, bytes);
  return readHeightMap(folder / name, options);
}

TEST(HeightMapFile, KnowsItsEndings) {
  for (const char* name : {"a.png", "a.PNG", "a.pgm", "a.Asc"}) EXPECT_TRUE(isHeightMapFile(name));
  for (const char* name : {"a.jpg", "a.obj", "a", "png"}) EXPECT_FALSE(isHeightMapFile(name));
}

TEST(HeightMapFile, ReadsPgmsOfEveryKind) {
  // Row 0 comes first; 16-bit values have their high byte first.
  const HeightMap wide =
      readBytes("a.pgm", wholePgm(30, 20, true), {.cellSize = 2, .heightScale = 0.5});
  EXPECT_EQ(wide.width, 30);
  EXPECT_EQ(wide.height, 20);
  EXPECT_EQ(wide.cellSize, 2);
  EXPECT_EQ(wide.at(7, 15), 0.5f * (15 * 30 + 7));
  const HeightMap narrow = readBytes("a.pgm", wholePgm(5, 4, false), {.cellSize = 1});
  EXPECT_EQ(narrow.at(4, 3), 19);
  const HeightMap text = readBytes(
      "a.pgm", "P2 # plain\n3 2\n# five hundred\n500\n1 2 3\n400 500\t0\n", {.cellSize = 1});
  EXPECT_EQ(text.heights, (std::vector<float>{1, 2, 3, 400, 500, 0}));
}

TEST(HeightMapFile, ReadsGrayPngsOfBothDepthsInTheirOwnSteps) {
  const TemporaryFolder folder;
  Image16 deep{3, 2, 1, {0, 1, 2, 500, 40000, 65535}};
  writePng(folder / "a.png", deep);
  EXPECT_EQ(readHeightMap(folder / "a.png", {.cellSize = 1}).heights,
            (std::vector<float>{0, 1, 2, 500, 40000, 65535}));
  Image8 shallow{3, 2, 1, {0, 1, 2, 50, 200, 255}};
  writePng(folder / "b.png", shallow);
  EXPECT_EQ(readHeightMap(folder / "b.png", {.cellSize = 1}).heights,
            (std::vector<float>{0, 1, 2, 50, 200, 255}));
  // Gray stored as color is gray; color is not.
  Image8 color{2, 2, 3, {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}};
  writePng(folder / "c.png", color);
  EXPECT_EQ(readHeightMap(folder / "c.png", {.cellSize = 1}).heights,
            (std::vector<float>{1, 2, 3, 4}));
  color.pixels[4] = 9;
  writePng(folder / "c.png", color);
  EXPECT_THAT(inputError([&] { readHeightMap(folder / "c.png"); }), HasSubstr("gray"));
}

TEST(HeightMapFile, ReadsEsriGrids) {
  const HeightMap map = readBytes("a.asc",
                                  "NCOLS 3\nnrows 2\nxllcorner -1e3\nyllcenter 5\ncellsize "
                                  "30.5\nNODATA_value -9999\n1.5 -2 3e2\n4 5 +6\n");
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.height, 2);
  EXPECT_EQ(map.cellSize, 30.5);
  EXPECT_EQ(map.heights, (std::vector<float>{1.5f, -2, 300, 4, 5, 6}));
}

TEST(HeightMapFile, FillsCellsWithoutDataFromTheirNeighbors) {
  const HeightMap map = readBytes(
      "a.asc",
      "ncols 4\nnrows 3\ncellsize 1\nnodata_value -9999\n2 2 4 4\n2 -9999 -9999 4\n-9999 2 4 4\n");
  EXPECT_FLOAT_EQ(map.at(1, 1), (2 + 2 + 4 + 2 + 2 + 4) / 6.0f);  // its neighbor is open as well
  EXPECT_FLOAT_EQ(map.at(2, 1), (2 + 4 + 4 + 4 + 2 + 4 + 4) / 7.0f);
  // A cell deep within a hole is reached ring by ring.
  std::string text = "ncols 7\nnrows 7\ncellsize 1\nnodata_value nan\n";
  for (int p = 0; p < 49; ++p) text += p % 7 == 0 || p < 7 ? "5 " : "nan ";
  const HeightMap filled = readBytes("a.asc", text);
  for (const float h : filled.heights) EXPECT_FLOAT_EQ(h, 5);
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
  EXPECT_EQ(map.heights.front(), 446);
  const HeightMap flat = readBytes("a.pgm", "P2 2 2 9 7 7 7 7");
  EXPECT_EQ(flat.cellSize, 1);
}

TEST(HeightMapFile, ComesBackFromEveryFormat) {
  const TemporaryFolder folder;
  HeightMap map =
      makeMap(9, 7, 2.5, [](double x, double y) { return std::round(10 * hills(x, y)); });
  for (const char* name : {"a.asc", "a.pgm", "a.png"}) {
    writeHeightMap(folder / name, map, {.heightScale = 0.25});
    // An .asc holds world units already.
    HeightMapFileOptions options{.cellSize = 2.5, .heightScale = 0.25};
    if (std::string(name) == "a.asc") options.heightScale.reset();
    const HeightMap back = readHeightMap(folder / name, options);
    EXPECT_EQ(back.width, 9);
    EXPECT_EQ(back.cellSize, 2.5);
    EXPECT_EQ(back.heights, map.heights) << name;
  }
  // Odd floats survive as text; integers clamp.
  map.heights[0] = 0.1f;
  map.heights[1] = -1.17549435e-38f;
  writeHeightMap(folder / "b.asc", map);
  EXPECT_EQ(readHeightMap(folder / "b.asc").heights, map.heights);
  map.heights[2] = 1e9f;
  Warnings warnings;
  writeHeightMap(folder / "b.png", map, {.heightScale = 1, .warnings = &warnings});
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("b.png: 1 of 63 heights are outside of 0 to")));
  const HeightMap clamped = readHeightMap(folder / "b.png");
  EXPECT_EQ(clamped.heights[1], 0);
  EXPECT_EQ(clamped.heights[2], 65535);
  EXPECT_THAT(inputError([&] { writeHeightMap(folder / "a.tif", map); }),
              HasSubstr(".png, .pgm or .asc"));
}

TEST(HeightMapFile, NamesTheFileAndLineOfWhatIsWrong) {
  const auto error = [](const std::string& name, const std::string& bytes) {
    const std::string message = inputError([&] { readBytes(name, bytes); });
    EXPECT_THAT(message, HasSubstr(name));
    EXPECT_THAT(message, Not(HasSubstr("\n")));
    return message;
  };
  EXPECT_THAT(error("a.pgm", "P6 2 2 255 aaaaaaaaaaaa"), HasSubstr("P2 or P5"));
  EXPECT_THAT(error("a.pgm", "P5 2 2 65536 aaaaaaaa"), HasSubstr("1 to 65535"));
  EXPECT_THAT(error("a.pgm", "P5 2 2 0 aaaaaaaa"), HasSubstr("1 to 65535"));
  EXPECT_THAT(error("a.pgm", "P5 -2 2 255 aaaaaaaa"), HasSubstr("the width"));
  EXPECT_THAT(error("a.pgm", "P5 1 2 255 aa"), HasSubstr("at least 2 x 2"));
  EXPECT_THAT(error("a.pgm", "P5 16000000 16000000 65535 aa"), HasSubstr("ends early"));
  EXPECT_THAT(error("a.pgm", "P5 99999999999999999999 2 255 aa"), HasSubstr("the width"));
  EXPECT_THAT(error("a.pgm", "P2\n2 2\n255\n1 2\n3 x\n"),
              AllOf(HasSubstr("a.pgm:5:"), HasSubstr("\"x\"")));
  EXPECT_THAT(error("a.pgm", "P2 2 2 255 1 2 300 4"), HasSubstr("300"));
  EXPECT_THAT(error("a.pgm", std::string("P5 2 2 9 \1\2\3\4", 13).replace(9, 1, "\xff")),
              HasSubstr("255"));
  EXPECT_THAT(error("a.asc", "ncols 2\nnrows 2\n1 2 3 4\n"), HasSubstr("cellsize is missing"));
  EXPECT_THAT(error("a.asc", "ncols 2\nnrows 2\ncellsize 0\n1 2 3 4\n"), HasSubstr("a.asc:3:"));
  EXPECT_THAT(error("a.asc", "ncols 2\nnrows 2\ndx 1\ndy 2\n1 2 3 4\n"), HasSubstr("square"));
  EXPECT_THAT(error("a.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2\n3 inf\n"), HasSubstr("a.asc:5:"));
  EXPECT_THAT(error("a.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2\n3 1e300\n"), HasSubstr("1e300"));
  EXPECT_THAT(error("a.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2\n3\n"), HasSubstr("3 of 4"));
  EXPECT_THAT(error("a.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2 3 4 5\n"),
              HasSubstr("more than 2 x 2"));
  EXPECT_THAT(error("a.asc", "ncols 16000000\nnrows 16000000\ncellsize 1\n1 2 3 4 5\n"),
              HasSubstr("ends early"));
  EXPECT_THAT(error("a.asc", "hello world"), HasSubstr("hello"));
  EXPECT_THAT(error("a.png", "no picture at all"), testing::_);
  EXPECT_THAT(error("a.pgm", ""), HasSubstr("empty"));
  EXPECT_THAT(inputError([] { readHeightMap("nothing.pgm"); }), HasSubstr("no such file"));
  EXPECT_THAT(inputError([] { readHeightMap("a.pgm", {.cellSize = 0}); }),
              HasSubstr("`cell-size`"));
  EXPECT_THAT(inputError([] { readHeightMap("a.pgm", {.heightScale = -1}); }),
              HasSubstr("`height-scale`"));
}

/// A grid of 5 x 4 heights 1, 2, ..., with `hole` in place of number 7 (counted from 0).
std::string ascGrid(const std::string& keys, const std::string& hole) {
  std::string text = "ncols 5\nnrows 4\ncellsize 10\n" + keys;
  for (int p = 0; p < 20; ++p)
    text += (p == 7 ? hole : std::to_string(p + 1)) + (p % 5 == 4 ? "\n" : " ");
  return text;
}

struct Read {
  HeightMap map;
  Warnings warnings;
};
Read readWarned(const std::string& name, const std::string& bytes,
                HeightMapFileOptions options = {}) {
  Read read;
  options.warnings = &read.warnings;
  read.map = readHeightMap(bytes, name, options);
  return read;
}

TEST(HeightMapFile, BytesAreReadAsTheFileIs) {
  const std::string bytes = wholePgm(6, 5, true);
  const HeightMap file = readBytes("a.pgm", bytes), memory = readHeightMap(bytes, "a.pgm", {});
  EXPECT_EQ(memory.heights, file.heights);
  EXPECT_EQ(memory.cellSize, file.cellSize);
  EXPECT_THAT(inputError([&] { readHeightMap(bytes, "a.tif", {}); }), HasSubstr("a.tif"));
}

TEST(HeightMapFile, NoDataIsKnownHoweverItIsSpelled) {
  // The mean of the eight around it, 2, 3, 4, 7, 9, 12, 13, 14.
  const float filled = 8;
  const auto check = [&](const std::string& keys, const std::string& hole, bool announced) {
    const Read read = readWarned("a.asc", ascGrid(keys, hole));
    EXPECT_EQ(read.map.heights[7], filled) << keys << hole;
    EXPECT_EQ(read.map.heights[8], 9) << keys << hole;
    if (announced) {
      EXPECT_THAT(read.warnings, IsEmpty()) << keys << hole;
    } else {
      EXPECT_THAT(read.warnings,
                  ElementsAre(HasSubstr("a.asc: filling 1 cell without data, which no")))
          << keys << hole;
    }
  };
  check("NODATA_value -9999\n", "-9999", true);
  check("nodata -9999\n", "-9999.000", true);
  check("NODATA_value -9999\n", "-9998.9990234375", true);  // through a float
  check("NODATA_value -3.4028234663852886e+38\n", "-3.40282e+38", true);
  check("NODATA_value nan\n", "-nan", true);
  check("NODATA_value 0\n", "0", true);
  check("NODATA_value -9999\n", "nan", false);
  for (const char* hole :
       {"-9999", "-9999.0", "-32768", "-3.4028235e+38", "nan", "NaN", "-1.#IND", "1.#QNAN"}) {
    check("", hole, false);
  }
  // A height near a round number is a height.
  const Read read = readWarned("a.asc", ascGrid("NODATA_value -9999\n", "-9998"));
  EXPECT_EQ(read.map.heights[7], -9998);
  EXPECT_EQ(readWarned("a.asc", ascGrid("NODATA_value 0\n", "0.0001")).map.heights[7], 0.0001f);
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
  EXPECT_EQ(read.map.heights, std::vector<float>(9, 10));
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("a.png: filling 1 transparent pixel ")));
}

TEST(HeightMapFile, WritesMapsOfFewBitsAsBrightAsTheyWere) {
  const TemporaryFolder folder;
  for (const char* name : {"o.png", "o.pgm"}) {
    Warnings warnings;
    HeightMap map = readHeightMap(wholePgm(16, 16, false), "a.pgm", {.heightScale = 3});
    ASSERT_TRUE(map.steps.has_value());
    EXPECT_EQ(map.steps->largest, 255);
    EXPECT_EQ(map.heights[200], 600);
    writeHeightMap(folder / name, map, {.warnings = &warnings});
    const HeightMap back = readHeightMap(folder / name);
    EXPECT_EQ(back.steps->largest, 65535);
    for (int p = 0; p < 256; ++p) EXPECT_EQ(back.heights[p], 257.0f * p) << name;
    EXPECT_THAT(warnings, IsEmpty());
    // What was not integers fills the whole range, and the scale is said.
    map.steps.reset();
    for (float& h : map.heights) h = h / 765 * 4 - 3;
    writeHeightMap(folder / name, map, {.warnings = &warnings});
    EXPECT_EQ(readHeightMap(folder / name).heights[0], 0);
    EXPECT_EQ(readHeightMap(folder / name).heights[255], 65535);
    EXPECT_THAT(warnings,
                ElementsAre(HasSubstr("the integers 0 to 65535 are heights from -3 to 1")));
    warnings.clear();
    writeHeightMap(folder / name, map, {.heightScale = 1, .warnings = &warnings});
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("heights are outside of 0 to")));
    warnings.clear();
    for (float& h : map.heights) h += 4;
    writeHeightMap(folder / name, map, {.heightScale = 1, .warnings = &warnings});
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("span only 4 steps")));
  }
}

TEST(HeightMapFile, EveryPrefixIsReadOrRefused) {
  const TemporaryFolder folder;
  Image16 image{6, 5, 1, {}};
  for (int p = 0; p < 30; ++p) image.pixels.push_back(static_cast<std::uint16_t>(p * 1999));
  writePng(folder / "a.png", image);
  const std::string asc =
      "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n1 2 3 4\n5 "
      "-9999 7 8\n9 10 11 12\n";
  const std::pair<const char*, std::string> files[] = {
      {"a.pgm", wholePgm(6, 5, true)}, {"a.asc", asc}, {"a.png", readFile(folder / "a.png")}};
  for (const auto& file : files) {
    const auto& name = file.first;  // no binding: lambdas of clang 14 capture none
    const auto& whole = file.second;
    EXPECT_EQ(inputError([&] { readBytes(name, whole); }), "");
    for (std::size_t n = 0; n < whole.size(); ++n) {
      // The last digits of a text may be missing without any trace.
      if (std::string(name) == "a.asc" && n + 3 >= whole.size()) continue;
      // A PNG is whole once its pixels are; some readers do without its last, empty chunk.
      if (std::string(name) == "a.png" && n + 16 >= whole.size()) continue;
      EXPECT_NE(inputError([&] { readBytes(name, whole.substr(0, n)); }), "") << name << " " << n;
    }
  }
}

TEST(HeightMapFile, DamagedBytesAreReadOrRefusedButNothingElse) {
  const TemporaryFolder folder;
  Image16 image{6, 5, 1, {}};
  for (int p = 0; p < 30; ++p) image.pixels.push_back(static_cast<std::uint16_t>(p * 1999));
  writePng(folder / "a.png", image);
  const std::pair<const char*, std::string> files[] = {
      {"a.pgm", wholePgm(6, 5, true)},
      {"a.pgm", "P2\n3 2\n500\n1 2 3\n400 500 0\n"},
      {"a.asc", "ncols 3\nnrows 2\ncellsize 10\nNODATA_value -9\n1 2 3\n5 -9 7\n"},
      {"a.png", readFile(folder / "a.png")}};
  const Random random(21);
  int refused = 0, read = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    auto [name, bytes] = files[trial % 4];
    const int changes = 1 + static_cast<int>(random.below(4, trial, 0));
    for (int c = 0; c < changes; ++c) {
      const std::size_t at =
          random.below(static_cast<std::uint32_t>(bytes.size()), trial, 3 * c + 1);
      const auto value = static_cast<char>(random.below(256, trial, 3 * c + 2));
      // Some changes keep the text a text.
      bytes[at] = random.below(2, trial, 3 * c + 3)
                      ? value
                      : "0123456789 \n-+.#e"[static_cast<unsigned char>(value) % 17];
    }
    try {
      const HeightMap map = readBytes(name, bytes);
      ++read;
      ASSERT_EQ(map.heights.size(), static_cast<std::size_t>(map.width) * map.height);
      for (const float h : map.heights) ASSERT_TRUE(std::isfinite(h));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 30);
  EXPECT_GT(refused, 100);
}

// The distance to the surface, by brute force over its triangles far past the map's sides.
double exactDistance(const HeightMap& map, const Vec3d& p) {
  const auto mirror = [](int i, int n) {
    while (i < 0 || i >= n) i = i < 0 ? -i : 2 * (n - 1) - i;
    return i;
  };
  const auto point = [&](int c, int r) {
    return Vec3d{c * map.cellSize, r * map.cellSize,
                 map.at(mirror(c, map.width), map.height - 1 - mirror(r, map.height))};
  };
  double nearest = kInfinity;
  for (int r = -map.height; r < 2 * map.height; ++r)
    for (int c = -map.width; c < 2 * map.width; ++c) {
      const Vec3d p00 = point(c, r), p10 = point(c + 1, r), p01 = point(c, r + 1),
                  p11 = point(c + 1, r + 1);
      const bool rising = std::abs(p00.z - p11.z) <= std::abs(p10.z - p01.z);
      nearest = std::min(
          {nearest, squaredDistance(p, rising ? Corners{p00, p10, p11} : Corners{p00, p10, p01}),
           squaredDistance(p, rising ? Corners{p00, p11, p01} : Corners{p10, p11, p01})});
    }
  return std::sqrt(nearest);
}

TEST(HeightMapToSdf, IsTheTrueDistanceOfGroundThatGoesOn) {
  const HeightMap map = makeMap(12, 9, 0.5, hills);
  for (const double halfWidth : {3.0, kInfinity}) {
    const DistanceField field = heightMapToSdf(map, {.resolution = 20, .halfWidth = halfWidth});
    int inside = 0;
    for (std::size_t s = 0; s < field.values.count(); ++s) {
      const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
      const float v = field.values.values()[s];
      ASSERT_NEAR(std::abs(v), std::min<double>(exactDistance(map, p), field.truncation), 1e-5);
      inside += v < 0;
    }
    EXPECT_GT(inside, 500);
  }
}

TEST(HeightMapToSdf, HasNoWallsAndNoFloor) {
  const HeightMap map = makeMap(40, 30, 0.25, hills);
  const DistanceField field = heightMapToSdf(map, {.resolution = 40});
  const Vec3i n = field.size();
  for (int j = 0; j < n.y; ++j)
    for (int i = 0; i < n.x; ++i) {
      // Down at the floor all is ground, far from any surface; up at the ceiling all is air.
      EXPECT_EQ(field.values(i, j, 0), -field.truncation);
      EXPECT_EQ(field.values(i, j, n.z - 1), field.truncation);
      // And each column goes from one to the other once.
      int changes = 0;
      for (int k = 0; k + 1 < n.z; ++k)
        changes += (field.values(i, j, k) < 0) != (field.values(i, j, k + 1) < 0);
      EXPECT_EQ(changes, 1);
    }
}

TEST(HeightMapToSdf, SizesTheBoxByTheReliefAndTheOptions) {
  const HeightMap map =
      makeMap(41, 21, 0.1, [](double x, double) { return 7 + x / 4; });  // 4 x 2 x 1
  const DistanceField field = heightMapToSdf(map, {.resolution = 40, .air = 5, .ground = 3});
  EXPECT_NEAR(field.voxelSize, 0.1, 1e-9);
  EXPECT_EQ(field.size(), (Vec3i{40, 20, 18}));
  const Box3d box = field.box();
  EXPECT_NEAR(length(box.min - Vec3d{0, 0, 7 - 0.3}), 0, 1e-6);
  // Where the relief is the longest side, it and its air and ground have the samples.
  const HeightMap steep = makeMap(5, 5, 1, [](double x, double) { return 10 * x; });
  const DistanceField tall = heightMapToSdf(steep, {.resolution = 48});
  EXPECT_EQ(tall.size().z, 48);
  EXPECT_NEAR(tall.voxelSize, 1, 1e-9);
  EXPECT_NEAR(heightMapToSdf(map, {.voxelSize = 0.2}).voxelSize, 0.2, 1e-12);
}

TEST(HeightMapToSdf, AndBackIsWithinHalfAVoxel) {
  const HeightMap map = makeMap(50, 40, 0.2, hills);
  for (const int resolution : {25, 49, 120}) {
    const DistanceField field = heightMapToSdf(map, {.resolution = resolution});
    const HeightMap back = sdfToHeightMap(field);
    ASSERT_EQ(back.width, field.size().x);
    ASSERT_EQ(back.height, field.size().y);
    EXPECT_EQ(back.cellSize, field.voxelSize);
    for (int row = 0; row < back.height; ++row)
      for (int column = 0; column < back.width; ++column) {
        const Vec3d p = field.position({double(column), double(back.height - 1 - row), 0});
        ASSERT_NEAR(back.at(column, row), hills(p.x, p.y), 0.5 * field.voxelSize);
      }
  }
}

TEST(HeightMapToSdf, AveragesMapsThatAreMuchFinerThanTheSamples) {
  // Noise of one cell on a slope: what is left of it at the samples' scale is small.
  const Random random(4);
  HeightMap map = makeMap(320, 240, 0.01, [](double x, double) { return 0.3 * x; });
  for (std::size_t p = 0; p < map.heights.size(); ++p)
    map.heights[p] += static_cast<float>(random.uniform(-0.05, 0.05, p));
  const DistanceField field = heightMapToSdf(map, {.resolution = 32});
  const HeightMap back = sdfToHeightMap(field);
  for (int column = 2; column + 2 < back.width; ++column)
    EXPECT_NEAR(back.at(column, 5), 0.3 * field.position({double(column), 0, 0}).x,
                0.25 * field.voxelSize);
}

TEST(HeightMapToSdf, IsTheSameAtAnyNumberOfThreads) {
  const HeightMap map = makeMap(60, 50, 0.2, hills);
  const auto run = [&] { return heightMapToSdf(map, {.resolution = 48}).values; };
  EXPECT_EQ(withThreads(1, run), withThreads(8, run));
}

TEST(HeightMapToSdf, RefusesOptionsAndMapsThatMakeNoSense) {
  const HeightMap map = makeMap(4, 4, 1, hills);
  const auto error = [&](const HeightMapToSdfOptions& options) {
    return inputError([&] { heightMapToSdf(map, options); });
  };
  EXPECT_THAT(error({.resolution = 0}), HasSubstr("resolution"));
  EXPECT_THAT(error({.resolution = 100000}), HasSubstr("1..4096"));
  EXPECT_THAT(error({.voxelSize = -1}), HasSubstr("voxelSize"));
  EXPECT_THAT(error({.voxelSize = 1e-9}), HasSubstr("lower `resolution`"));
  EXPECT_THAT(error({.air = -1}), HasSubstr("air"));
  EXPECT_THAT(error({.halfWidth = 0}), HasSubstr("halfWidth"));
  EXPECT_THAT(inputError([] { heightMapToSdf({}); }), HasSubstr("2 x 2"));
  HeightMap broken = map;
  broken.heights[3] = std::nanf("");
  EXPECT_THAT(inputError([&] { heightMapToSdf(broken); }), HasSubstr("finite"));
  broken = map;
  broken.cellSize = 0;
  EXPECT_THAT(inputError([&] { heightMapToSdf(broken); }), HasSubstr("cellSize"));
}

TEST(SdfToHeightMap, TakesTheTopmostSurface) {
  // Ground below 1, a slab from 2 to 3 above half of it.
  const test::Shape shape = [](const Vec3d& p) {
    const double slab = std::max({std::abs(p.z - 2.5) - 0.5, p.x - 2.0});
    return std::min(p.z - 1.0, slab);
  };
  const DistanceField field = test::sampled(shape, {40, 5, 45}, 0.1, {0.05, 0.05, -0.45}, 0.3);
  const HeightMap map = sdfToHeightMap(field);
  EXPECT_NEAR(map.at(5, 2), 3, 1e-5);
  EXPECT_NEAR(map.at(35, 2), 1, 1e-5);
}

TEST(SdfToHeightMap, OfColumnsWithoutACrossingIsTheFloorOrTheCeiling) {
  DistanceField field{Array3D<float>({2, 1, 3}, 1), 0.5, {0, 0, 10}, 1};
  for (int k = 0; k < 3; ++k) field.values(1, 0, k) = -1;
  const HeightMap map = sdfToHeightMap(field);
  EXPECT_FLOAT_EQ(map.at(0, 0), 9.75f);
  EXPECT_FLOAT_EQ(map.at(1, 0), 11.25f);
}

TEST(SdfToHeightMap, PutsTheNorthFirst) {
  const test::Shape slope = [](const Vec3d& p) { return (p.z - p.y) / std::sqrt(2.0); };
  const HeightMap map = sdfToHeightMap(test::sampled(slope, {4, 10, 20}, 0.1, {0, 0, -0.5}, 10));
  EXPECT_NEAR(map.at(2, 0), 0.9, 1e-5);
  EXPECT_NEAR(map.at(2, 9), 0, 1e-5);
}

TEST(HeightMapToSdf, ReportsItsProgressAndStopsWhereItIsCancelled) {
  HeightMap map;
  map.width = map.height = 40;
  for (int p = 0; p < 40 * 40; ++p) {
    map.heights.push_back(static_cast<float>(3 * std::sin(p % 40 * 0.3)));
  }
  DistanceField field;
  expectReportsAndStops(
      [&](const Progress& progress) { field = heightMapToSdf(map, {.resolution = 40}, progress); },
      10);
  expectReportsAndStops([&](const Progress& progress) { sdfToHeightMap(field, progress); }, 10);
}

TEST(HeightMapFile, RealTerrainIsRead) {
  const std::filesystem::path file = std::filesystem::path(EXEMPLAR_SOURCE_DIR) /
                                     "../shared/data/terrain/bigtujunga_srtm_30m_400.pgm";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file << " beside the checkout";
  const HeightMap map = readHeightMap(file);
  EXPECT_EQ(map.width, 400);
  EXPECT_EQ(map.height, 400);
  const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
  EXPECT_NEAR((*high - *low) / (399 * map.cellSize), 0.2, 1e-6);
  const HeightMap back = sdfToHeightMap(heightMapToSdf(map, {.resolution = 128}));
  EXPECT_EQ(back.width, 128);
}

}  // namespace
}  // namespace exemplar
