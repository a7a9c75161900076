// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Height map files that are damaged, doubtful or have holes.

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
using test::inputError;
using test::Read;
using test::readBytes;
using test::readWarned;
using test::TemporaryFolder;
using test::tiff;
using test::TiffTags;
using test::wholePgm;
using test::written;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

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

TEST(HeightMapFile, ATiffMayAnnounceNeitherItsHolesNorItsDegrees) {
  std::string integers;
  for (int p = 0; p < 12; ++p) {
    const int h = p == 7 ? -9999 : 100 * p;
    integers += {static_cast<char>(h & 0xff), static_cast<char>(h >> 8)};
  }
  TiffTags tags{.width = 4, .height = 3, .bits = 16, .format = 2};
  tags.scale = {0.001, 0.001, 0};
  tags.tie = {0, 0, 0, 7.5, 60.003, 0};
  const Read read = readWarned("a.tif", tiff(tags, integers));
  EXPECT_TRUE(std::isnan(read.map.heights[7]));
  EXPECT_EQ(read.map.heights[8], 800);
  EXPECT_NEAR(read.map.cellSize, 111.195 * std::sqrt(0.5), 0.01);
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("taking 1 cell for cells without data"),
                                         HasSubstr("a.tif: its cells of 0.001 degrees")));
  // Where a file says what a hole holds, another number is a height; ours always say it then.
  tags.noData = "-1";
  HeightMap depths = readHeightMap(tiff(tags, integers), "a.tif", {});
  EXPECT_EQ(depths.heights[7], -9999);
  const TemporaryFolder folder;
  writeHeightMap(folder / "b.tif", depths);
  EXPECT_EQ(readHeightMap(folder / "b.tif").heights[7], -9999);
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

TEST(HeightMapFile, BlocksThatATiffLeavesOutAreHoles) {
  const auto without = [](std::uint32_t side) {
    std::string bytes = tiff({.width = side, .height = side, .bits = 16}, "");
    const std::size_t offsets = bytes.find(std::string("\x11\x01\x04\x00", 4));
    return bytes.replace(offsets + 8, 4, 4, '\0');
  };
  EXPECT_THAT(inputError([&] { readHeightMap(without(4), "a.tif", {}); }),
              HasSubstr("holds no heights"));
  // No file of some bytes holds gigabytes of them.
  EXPECT_THAT(inputError([&] { readHeightMap(without(1 << 15), "a.tif", {}); }),
              HasSubstr("ends early"));
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

TEST(HeightMapFile, AnExrThatPromisesTooMuchIsRefused) {
  std::string bytes = written("a.exr", 9, 7);
  // The data window's largest x and y, after its name, type and size.
  const std::string window("dataWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0", 29);
  const std::size_t at = bytes.find(window);
  ASSERT_NE(at, std::string::npos);
  for (const std::size_t place : {at + 29, at + 33})
    bytes.replace(place, 4, std::string("\0\0\1\0", 4));
  EXPECT_THAT(inputError([&] { readHeightMap(bytes, "a.exr", {}); }),
              AllOf(HasSubstr("a.exr: "), Not(HasSubstr("\n"))));
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
