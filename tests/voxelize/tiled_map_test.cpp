// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/tiled_map.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/cells.h"
#include "core/file.h"
#include "temporary_files.h"
#include "voxelize/tile_data.h"

namespace exemplar {
namespace {

using Encoding = TiledMap::Encoding;
namespace fs = std::filesystem;

const std::string kHead =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<map version=\"1.10\" orientation=\"orthogonal\" "
    "width=\"3\" height=\"2\" tilewidth=\"16\" tileheight=\"16\" infinite=\"0\">\n"
    " <properties><property name=\"theme\" value=\"a &lt;b&gt;\"/></properties>\n"
    " <tileset firstgid=\"1\" source=\"sets/ground.tsx\"/>\n"
    " <tileset firstgid=\"20\" name=\"walls\" tilewidth=\"16\" tileheight=\"16\">\n"
    "  <image source=\"walls.png\" width=\"64\" height=\"16\"/>\n"
    "  <tile id=\"2\" class=\"gate\"><objectgroup><object id=\"1\" width=\"16\" "
    "height=\"16\"/></objectgroup></tile>\n"
    " </tileset>\n";

std::string layer(const std::string& name, const std::string& data) {
  return " <layer id=\"1\" name=\"" + name + "\" width=\"3\" height=\"2\">\n  <data" + data +
         "</data>\n </layer>\n";
}
std::string twoLayers() {
  return kHead + layer("ground", " encoding=\"csv\">\n1,1,2,\n1,2147483650,2\n") +
         " <objectgroup name=\"doors\"><object id=\"7\" x=\"3\"/></objectgroup>\n" +
         layer("walls", " encoding=\"csv\">\n0,22,0,\n0,0,0\n") + "</map>\n";
}

TiledMap parsed(const std::string& text) { return parseTiledMap(text, "town.tmx"); }
std::string refusal(const std::string& text) {
  return test::inputError([&] { parsed(text); });
}

TEST(TiledMap, CellsAreStacksOfTheirTilesWithTheFirstRowOnTop) {
  const TiledMap map = parsed(twoLayers());
  ASSERT_EQ(map.grid.size(), (Vec3i{3, 2, 1}));
  const auto stack = [&](int x, int y) { return map.stacks[map.grid.cells(x, y, 0)]; };
  using Stack = std::vector<std::uint32_t>;
  EXPECT_EQ(stack(0, 1), (Stack{1, 0}));
  EXPECT_EQ(stack(1, 1), (Stack{1, 22}));
  EXPECT_EQ(stack(1, 0), (Stack{kFlippedX | 2u, 0}));
  EXPECT_EQ(map.grid.cells(0, 1, 0), map.grid.cells(0, 0, 0));
  EXPECT_EQ(map.grid.labels[map.grid.cells(1, 1, 0)].name, "tile 1, gate, tile 22");
  EXPECT_EQ(map.grid.labels[map.grid.cells(1, 0, 0)].name, "tile 2, flipped x");
  EXPECT_EQ(map.stacks[0], (Stack{0, 0}));
  EXPECT_TRUE(isEmpty(map.grid.labels[0]));
  EXPECT_EQ(map.dropped, std::vector<std::string>{"object layers"});
}

TEST(TiledMap, MirrorsAndTurnsAreOtherTilesOfTheMap) {
  // A tile in all eight ways, and one in a single way.
  std::string row;
  for (std::uint32_t bits = 0; bits < 8; ++bits) row += std::to_string(bits << 29 | 5u) + ",";
  const TiledMap map = parsed("<map width=\"9\" height=\"1\"><layer><data encoding=\"csv\">" + row +
                              "9</data></layer></map>");
  const auto tile = [&](Label label) { return map.stacks[label][0]; };
  for (Label label = 1; label < 9; ++label) {
    // Mirrored twice, and turned four times, a tile is itself; turned and mirrored it is the tile
    // flipped along a diagonal.
    EXPECT_EQ(map.mirroredX[map.mirroredX[label]], label);
    EXPECT_EQ(map.mirroredY[map.mirroredY[label]], label);
    const auto& turned = map.turned;
    EXPECT_EQ(turned[turned[turned[turned[label]]]], label);
    EXPECT_NE(turned[turned[label]], label);
    EXPECT_EQ(turned[turned[label]], map.mirroredX[map.mirroredY[label]]);
  }
  EXPECT_EQ(tile(map.mirroredX[1]), kFlippedX | 5u);
  // Tiled's own: turned to the right is flipped diagonally and then in x, to the left in y.
  EXPECT_EQ(tile(map.turned[1]), kFlippedDiagonally | kFlippedY | 5u);
  EXPECT_EQ(map.turned[9], 9);
}

TEST(TiledMap, MirroredStacksKeepTilesThatAreNeverFlipped) {
  // A house of two halves on grass.
  const TiledMap map = parsed(
      "<map width=\"2\" height=\"1\"><layer><data encoding=\"csv\">1,1</data></layer>"
      "<layer><data encoding=\"csv\">20,2147483668</data></layer></map>");
  const Label left = map.grid.cells(0, 0, 0), right = map.grid.cells(1, 0, 0);
  EXPECT_NE(left, right);
  EXPECT_EQ(map.mirroredX[left], right);
  EXPECT_EQ(map.mirroredX[right], left);
  EXPECT_EQ(map.mirroredY[left], left);
  EXPECT_TRUE(map.hasFlips());
}

TEST(TiledMap, EveryEncodingHoldsTheSameTilesAndComesBack) {
  const std::vector<std::uint32_t> tiles{1, 0, kFlippedX | kFlippedDiagonally | 7u, 4, 5, 4};
  const TiledMap csv = parsed("<map width=\"3\" height=\"2\"><layer><data encoding=\"csv\">" +
                              encodeTiles(tiles, Encoding::Csv, 3) + "</data></layer></map>");
  const std::pair<Encoding, std::string> kinds[] = {
      {Encoding::Elements, ""},
      {Encoding::Base64, " encoding=\"base64\""},
      {Encoding::Zlib, " encoding=\"base64\" compression=\"zlib\""},
      {Encoding::Gzip, " encoding=\"base64\" compression=\"gzip\""}};
  for (const auto& [encoding, attributes] : kinds) {
    const TiledMap map = parsed("<map width=\"3\" height=\"2\"><layer><data" + attributes + ">" +
                                encodeTiles(tiles, encoding, 3) + "</data></layer></map>");
    EXPECT_EQ(map.grid.cells, csv.grid.cells) << attributes;
    EXPECT_EQ(map.stacks, csv.stacks) << attributes;
    EXPECT_EQ(map.layers, std::vector{encoding});
  }
}

TEST(TiledMap, WhatIsWrittenReadsAgainInItsNewSizeWithAllElse) {
  const test::TemporaryFolder folder;
  const TiledMap map = parsed(twoLayers());
  LabelGrid grid = map.grid;
  grid.cells = Array3D<Label>({5, 4, 1});
  forEachCell(grid.size(), [&](const Vec3i& p) {
    grid.cells[p] = static_cast<Label>((3 * p.x + p.y) % map.grid.labelCount());
  });
  const fs::path path = folder / "more.tmx";
  writeTiledMap(path, grid, map);
  const std::string text = readFile(path);
  const TiledMap again = readTiledMap(path);
  ASSERT_EQ(again.grid.size(), grid.size());
  forEachCell(grid.size(), [&](const Vec3i& p) {
    EXPECT_EQ(again.stacks[again.grid.cells[p]], map.stacks[grid.cells[p]]);
  });
  for (const char* kept : {"sets/ground.tsx", "walls.png", "class=\"gate\"", "a &lt;b&gt;",
                           "name=\"ground\"", "<object id=\"1\""})
    EXPECT_NE(text.find(kept), text.npos) << kept;
  EXPECT_EQ(text.find("doors"), text.npos);
  EXPECT_EQ(text.find("width=\"3\""), text.npos);
}

TEST(TiledMap, WrittenInAnotherFolderItFindsItsTilesets) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "maps");
  fs::create_directories(folder / "out & more");
  writeFile(folder / "maps/town.tmx", twoLayers());
  const TiledMap map = readTiledMap(folder / "maps/town.tmx");
  const fs::path path = folder / "out & more/more.tmx";
  writeTiledMap(path, map.grid, map);
  EXPECT_NE(readFile(path).find("\"../maps/sets/ground.tsx\""), std::string::npos);
  const fs::path back = folder / "back.tmx";
  writeTiledMap(back, map.grid, readTiledMap(path));
  EXPECT_NE(readFile(back).find("\"out &amp; more/../maps/walls.png\""), std::string::npos);
}

TEST(TiledMap, OfInfiniteMapsTheBoxOfAllTilesIsRead) {
  const TiledMap map = parsed(
      "<map width=\"30\" height=\"20\" infinite=\"1\"><layer name=\"a\"><data encoding=\"csv\">"
      "<chunk x=\"-4\" y=\"0\" width=\"4\" height=\"2\">0,0,3,4,0,0,0,0</chunk>"
      "<chunk x=\"0\" y=\"0\" width=\"4\" height=\"2\">5,0,0,0,0,6,0,0</chunk></data></layer>"
      "</map>");
  ASSERT_EQ(map.grid.size(), (Vec3i{4, 2, 1}));
  const auto tile = [&](int x, int y) { return map.stacks[map.grid.cells(x, y, 0)][0]; };
  EXPECT_EQ(tile(0, 1), 3u);
  EXPECT_EQ(tile(2, 1), 5u);
  EXPECT_EQ(tile(3, 0), 6u);
  const test::TemporaryFolder folder;
  writeTiledMap(folder / "a.tmx", map.grid, map);
  const std::string text = readFile(folder / "a.tmx");
  EXPECT_NE(text.find("infinite=\"0\""), text.npos);
  EXPECT_EQ(text.find("chunk"), text.npos);
  EXPECT_EQ(readTiledMap(folder / "a.tmx").grid.cells, map.grid.cells);
}

TEST(TiledMap, RowsOfNumbersAreReadAndWrittenAsTiledDoes) {
  const test::TemporaryFolder folder;
  const std::string rows = "0,1,-1\n2147483653,7,0\n";
  const TiledMap map = parseTileRows(rows, "town.csv");
  ASSERT_EQ(map.grid.size(), (Vec3i{3, 2, 1}));
  EXPECT_EQ(map.grid.cells(2, 1, 0), 0);
  EXPECT_EQ(map.grid.cells(0, 1, 0), map.grid.cells(2, 0, 0));
  EXPECT_EQ(map.grid.labels[map.grid.cells(0, 0, 0)].name, "tile 5, flipped x");
  writeTiledMap(folder / "a.csv", map.grid, map);
  EXPECT_EQ(readFile(folder / "a.csv"), rows);
  EXPECT_NE(test::inputError([&] {
              writeTiledMap(folder / "a.tmx", map.grid, map);
            }).find("write a .csv"),
            std::string::npos);
}

TEST(TiledMap, WhatIsMalformedIsRefusedByLine) {
  const auto map = [](const std::string& inside) {
    return "<map width=\"2\" height=\"2\">\n" + inside + "</map>";
  };
  const auto data = [&](const std::string& text) {
    return map("<layer name=\"a\"><data" + text + "</data></layer>");
  };
  const std::pair<std::string, std::string> cases[] = {
      {"", "is not a map of Tiled"},
      {"<svg/>", "is not a map of Tiled: it begins with <svg>"},
      {"<map width=\"2\">", "town.tmx:1: <map> needs a whole number \"height\""},
      {"<map width=\"2\" height=\"0\">", "needs a whole number \"height\""},
      {"<map orientation=\"hexagonal\" width=\"2\" height=\"2\">", "is a hexagonal map"},
      {map(""), "has no layer of tiles"},
      {map("<layer name=\"a\"></layer>"), "town.tmx:2: layer a has no tiles"},
      {data(" encoding=\"csv\">1,2,3"), "layer a: has 3 tiles, not the 4"},
      {data(" encoding=\"csv\">1,2,3,4,5"), "has more than 4 tiles, not the 4"},
      {data(" encoding=\"csv\">1,b,3,4"), "'b,3,4' is not the number of a tile"},
      {data(" encoding=\"base64\">AAAA*"), "are not base64"},
      {data(" encoding=\"base64\" compression=\"zlib\">AAAAAAAA"), "tiles are damaged"},
      {data(" encoding=\"base64\" compression=\"zstd\">AAAA"), "save the map with zlib or gzip"},
      {data("><tile gid=\"x\"/>"), "'x' is not the number of a tile"},
      {data(" encoding=\"csv\">1,2,3,4").substr(0, 60), "ends within"},
      {"<map width=2>", "expected a quoted value in <map>"}};
  for (const auto& [text, message] : cases)
    EXPECT_NE(refusal(text).find(message), std::string::npos) << text << "\n" << refusal(text);
  const auto rows = [](const std::string& text) {
    return test::inputError([&] { parseTileRows(text, "town.csv"); });
  };
  EXPECT_NE(rows("1,2\n1\n").find("town.csv:2: has 1 tiles, and the first row has 2"),
            std::string::npos);
  EXPECT_NE(rows("1,two\n").find("town.csv:1: 'two' is not the number"), std::string::npos);
  EXPECT_NE(rows("\n\n").find("has no tiles"), std::string::npos);
}

TEST(TiledMap, ABombOfTilesIsNotUnpacked) {
  // Zeros that would fill a hundred times what the size says.
  const std::string packed =
      encodeTiles(std::vector<std::uint32_t>(100'000, 0), Encoding::Zlib, 100);
  EXPECT_NE(refusal("<map width=\"10\" height=\"10\"><layer name=\"a\"><data encoding=\"base64\" "
                    "compression=\"zlib\">" +
                    packed + "</data></layer></map>")
                .find("has more than 100 tiles"),
            std::string::npos);
}

}  // namespace
}  // namespace exemplar
