// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/height_map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "mesh/image.h"

namespace exemplar {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "exemplar_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

template <class Work>
std::string inputError(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

HeightMap makeMap(int width, int height, double cellSize,
                  const std::function<double(double, double)>& f) {
  HeightMap map{Grid<float>(width, height), cellSize};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      map.heights(column, row) =
          static_cast<float>(f(column * cellSize, (height - 1 - row) * cellSize));
  return map;
}

double hills(double x, double y) {
  return 3 + 0.6 * std::sin(1.1 * x) + 0.5 * std::cos(0.9 * y + 0.4 * x);
}

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

/// What a .tif says about itself; without a value, nothing.
struct TiffTags {
  std::uint32_t width = 2, height = 2;
  std::uint16_t bits = 16, format = 1, photometric = 1, samples = 1;
  std::string noData;
  std::vector<double> scale, tie;
  std::vector<std::uint16_t> keys, colors;
};

/// An uncompressed .tif in one strip.
std::string tiff(const TiffTags& tags, const std::string& data) {
  std::string out = "II*\0", more, entries;
  out.resize(4);
  out[2] = 42;
  int count = 0;
  const auto append = [](std::string& to, auto value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::uint32_t dataAt = 8;
  const auto moreAt = static_cast<std::uint32_t>(dataAt + data.size() + data.size() % 2);
  const auto entry = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t n,
                         const std::string& value) {
    append(entries, tag);
    append(entries, type);
    append(entries, n);
    if (value.size() <= 4) {
      entries += value + std::string(4 - value.size(), '\0');
    } else {
      append(entries, static_cast<std::uint32_t>(moreAt + more.size()));
      more += value + std::string(value.size() % 2, '\0');
    }
    ++count;
  };
  const auto number = [&](std::uint16_t tag, std::uint32_t value) {
    std::string bytes;
    append(bytes, value);
    entry(tag, 4, 1, bytes);
  };
  const auto small = [&](std::uint16_t tag, std::uint16_t value) {
    std::string bytes;
    append(bytes, value);
    entry(tag, 3, 1, bytes);
  };
  const auto list = [&](std::uint16_t tag, std::uint16_t type, const auto& values) {
    if (values.empty()) return;
    std::string bytes;
    for (const auto v : values) append(bytes, v);
    entry(tag, type, static_cast<std::uint32_t>(values.size()), bytes);
  };
  number(256, tags.width);
  number(257, tags.height);
  small(258, tags.bits);
  small(259, 1);
  small(262, tags.photometric);
  number(273, dataAt);
  small(277, tags.samples);
  number(278, tags.height);
  number(279, static_cast<std::uint32_t>(data.size()));
  list(320, 3, tags.colors);
  small(339, tags.format);
  list(33550, 12, tags.scale);
  list(33922, 12, tags.tie);
  list(34735, 3, tags.keys);
  if (!tags.noData.empty())
    entry(42113, 2, static_cast<std::uint32_t>(tags.noData.size() + 1), tags.noData + '\0');
  append(out, static_cast<std::uint32_t>(moreAt + more.size()));
  out += data + std::string(data.size() % 2, '\0') + more;
  append(out, static_cast<std::uint16_t>(count));
  return out + entries + std::string(4, '\0');
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
  writeBytes(folder / name, bytes);
  return readHeightMap(folder / name, options);
}

TEST(HeightMapFile, KnowsItsEndings) {
  for (const char* name : {"a.png", "a.PNG", "a.pgm", "a.Asc", "a.tif", "a.TIFF", "a.exr", "a.r16"})
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
  EXPECT_THAT(inputError([&] { readHeightMap(bytes, "a.obj", {}); }), HasSubstr("a.obj"));
}

TEST(HeightMapFile, NoDataIsKnownHoweverItIsSpelled) {
  const auto check = [&](const std::string& keys, const std::string& hole, bool announced) {
    const Read read = readWarned("a.asc", ascGrid(keys, hole));
    EXPECT_TRUE(std::isnan(read.map.heights[7])) << keys << hole;
    EXPECT_EQ(read.map.heights[8], 9) << keys << hole;
    if (announced) {
      EXPECT_THAT(read.warnings, IsEmpty()) << keys << hole;
    } else {
      EXPECT_THAT(read.warnings,
                  ElementsAre(HasSubstr("a.asc: taking 1 cell for cells without data, which no")))
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

/// A map with negative heights, fractions, a corner and, with `holes`, cells without data.
HeightMap sampleMap(int width, int height, bool whole, bool holes) {
  HeightMap map = makeMap(width, height, 30, [&](double x, double y) {
    const double h = 200 * hills(x / 30, y / 30) - 600;
    return whole ? std::round(h) : h;
  });
  map.cellSizeKnown = true;
  map.corner = MapCorner{500'000.5, -20'000};
  if (holes) map.heights(3, 2) = map.heights(0, 0) = map.heights(width - 1, 4) = kNan;
  return map;
}

std::string written(const std::string& name, int width, int height) {
  const TemporaryFolder folder;
  writeHeightMap(folder / name, sampleMap(width, height, false, true));
  return readFile(folder / name);
}

TEST(HeightMapFile, EqualHeightsStayEqualNumbersThroughEveryPairOfFormats) {
  const char* const names[] = {"a.asc", "a.tif", "a.exr", "a.png", "a.pgm", "a.r16"};
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
              HasSubstr(".png, .pgm or .r16"));
}

TEST(HeightMapFile, AMapOfOneHeightAndOneOfEightBitsAreSaid) {
  EXPECT_THAT(readWarned("a.pgm", "P2 2 2 65535 7 7 7 7").warnings,
              ElementsAre(HasSubstr("all its heights are 7")));
  EXPECT_THAT(readWarned("a.pgm", "P2 2 2 255 7 8 7 7").warnings,
              ElementsAre(HasSubstr("terraces")));
  const TemporaryFolder folder;
  writePng(folder / "a.png", Image16{2, 2, 1, {257, 514, 65535, 0}});
  Warnings warnings;
  readHeightMap(folder / "a.png", {.warnings = &warnings});
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("its 16 bits hold 8-bit heights")));
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

TEST(HeightMapFile, BlocksThatATiffLeavesOutAreHoles) {
  std::string bytes = tiff({.width = 4, .height = 4, .bits = 16}, "");
  const std::size_t offsets = bytes.find(std::string("\x11\x01\x04\x00", 4));
  ASSERT_NE(offsets, std::string::npos);
  bytes.replace(offsets + 8, 4, 4, '\0');
  EXPECT_THAT(inputError([&] { readHeightMap(bytes, "a.tif", {}); }),
              HasSubstr("holds no heights"));
}

TEST(HeightMapFile, SaysWhatIsWrongWithATiff) {
  const std::string data(24, 'a');
  const auto error = [&](const TiffTags& tags) {
    const std::string message = inputError([&] { readHeightMap(tiff(tags, data), "a.tif", {}); });
    EXPECT_THAT(message, AllOf(HasSubstr("a.tif: "), Not(HasSubstr("\n"))));
    return message;
  };
  EXPECT_THAT(error({.width = 6,
                     .height = 4,
                     .bits = 8,
                     .photometric = 3,
                     .colors = std::vector<std::uint16_t>(768)}),
              HasSubstr("palette"));
  EXPECT_THAT(error({.width = 4, .height = 2, .bits = 8, .photometric = 2, .samples = 3}),
              HasSubstr("color"));
  EXPECT_THAT(error({.width = 4, .height = 2, .bits = 8, .samples = 3}), HasSubstr("3 bands"));
  EXPECT_THAT(error({.width = 4, .height = 3, .bits = 12}), HasSubstr("12 bits"));
  EXPECT_THAT(error({.width = 4, .height = 30, .bits = 16}), HasSubstr("cannot be read whole"));
  EXPECT_THAT(error({.width = 1 << 30, .height = 1 << 30, .bits = 16}), HasSubstr("ends early"));
  EXPECT_THAT(error({.width = 1, .height = 12, .bits = 16}), HasSubstr("at least 2 x 2"));
  EXPECT_THAT(inputError([] { readHeightMap("hello", "a.tif", {}); }), HasSubstr("no .tif"));
  EXPECT_THAT(inputError([] { readHeightMap("hello", "a.exr", {}); }), HasSubstr("no whole .exr"));
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

TEST(HeightMapFile, EveryPrefixIsReadOrRefused) {
  const TemporaryFolder folder;
  Image16 image{6, 5, 1, {}};
  for (int p = 0; p < 30; ++p) image.pixels.push_back(static_cast<std::uint16_t>(p * 1999));
  writePng(folder / "a.png", image);
  const std::string asc =
      "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n1 2 3 4\n5 "
      "-9999 7 8\n9 10 11 12\n";
  const std::pair<const char*, std::string> files[] = {
      {"a.pgm", wholePgm(6, 5, true)},
      {"a.asc", asc},
      {"a.png", readFile(folder / "a.png")},
      {"a.tif", written("a.tif", 9, 7)},
      {"a.tif", tiff({.width = 4, .height = 3, .bits = 16}, std::string(24, 'a'))},
      {"a.exr", written("a.exr", 9, 7)}};
  for (const auto& file : files) {
    const auto& name = file.first;  // no binding: lambdas of clang 14 capture none
    const auto& whole = file.second;
    EXPECT_EQ(inputError([&] { readHeightMap(whole, name, {}); }), "");
    for (std::size_t n = 0; n < whole.size(); ++n) {
      // The last digits of a text may be missing without any trace.
      if (std::string(name) == "a.asc" && n + 3 >= whole.size()) continue;
      // A PNG is whole once its pixels are; some readers do without its last, empty chunk.
      if (std::string(name) == "a.png" && n + 16 >= whole.size()) continue;
      // What a .tif says beside its heights may be lost, which is said.
      Warnings warnings;
      const std::string error =
          inputError([&] { readHeightMap(whole.substr(0, n), name, {.warnings = &warnings}); });
      EXPECT_TRUE(!error.empty() || !warnings.empty()) << name << " " << n;
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
      {"a.png", readFile(folder / "a.png")},
      {"a.tif", written("a.tif", 9, 7)},
      {"a.tif", tiff({.width = 4, .height = 3, .bits = 16}, std::string(24, 'a'))},
      {"a.exr", written("a.exr", 9, 7)}};
  constexpr int kFiles = static_cast<int>(std::size(files));
  const Random random(21);
  int refused = 0, read = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    auto [name, bytes] = files[trial % kFiles];
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
      const HeightMap map = readHeightMap(bytes, name, {});
      ++read;
      ASSERT_TRUE(rangeOf(map.heights));
      for (const float h : map.heights.values()) ASSERT_FALSE(std::isinf(h));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 30);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace exemplar
