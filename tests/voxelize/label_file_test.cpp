// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/label_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "core/file.h"
#include "mesh/color.h"
#include "tests/voxelize/error_of.h"
#include "tests/voxelize/hears_cancellation.h"
#include "tests/voxelize/label_samples.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using testing::HasSubstr;

/// A folder of its own, removed with it.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("label_file_test_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

std::string textError(const std::string& text) {
  return errorOf([&] { return parseLabelText(text, "f.txt"); });
}
std::string voxError(const std::string& bytes) {
  return errorOf([&] { return parseVox(bytes, "f.vox"); });
}

TEST(LabelFiles, ReadingAndWritingHearCancellation) {
  const Folder folder;
  LabelGrid grid;
  grid.cells = Array3D<Label>({3, 2, 4}, 1);
  grid.labels = {emptyLook(), LabelLook{}};
  for (const char* name : {"g.txt", "g.vdb"}) {
    test::expectHearsCancellation([&](const Progress& p) { writeLabels(folder / name, grid, p); });
    test::expectHearsCancellation([&](const Progress& p) { (void)readLabels(folder / name, p); });
  }
}

// The text format

TEST(LabelText, CellsComeLayerByLayerWithXSlowestInEach) {
  const LabelGrid grid = parseLabelText("a\nb\nc\n2 3 2\n\n1 2 3\n4 5 6\n\n7 8 9\n10 11 12\n", "f");
  ASSERT_EQ(grid.size(), (Vec3i{2, 3, 2}));
  int expected = 1;
  for (int z = 0; z < 2; ++z) {
    for (int x = 0; x < 2; ++x) {
      for (int y = 0; y < 3; ++y) EXPECT_EQ(grid.cells(x, y, z), expected++);
    }
  }
  EXPECT_EQ(grid.labelCount(), 13);
  EXPECT_TRUE(isEmpty(grid.labels[0]));
  EXPECT_FALSE(isEmpty(grid.labels[1]));
}

TEST(LabelText, TheFirstThreeLinesMayBeAnything) {
  EXPECT_EQ(parseLabelText("9 9 9\n\n\xff\xfe\n1 1 1\n\n5", "f").cells(0, 0, 0), 5);
}

TEST(LabelText, WindowsLineEndsAndLineBreaksAnywhereAreRead) {
  const LabelGrid grid = parseLabelText("a\r\nb\r\nc\r\n1 4 1\r\n\r\n1 2\r\n\r\n3\r\n4\r\n", "f");
  EXPECT_EQ(grid.cells(0, 3, 0), 4);
}

TEST(LabelText, ObjectsNameSceneAndLabels) {
  const LabelGrid grid = parseLabelText(
      "a\nb\nc\n1 2 1\n\n0 1\n\n<Objects>\nScene 7\nwall of stone\n$file wall.obj\n$turn 90\n#\n"
      "never seen\n#\n",
      "f");
  EXPECT_EQ(grid.name, "Scene 7");
  ASSERT_EQ(grid.labelCount(), 3);
  EXPECT_EQ(grid.labels[1].name, "wall of stone");
  EXPECT_EQ(grid.labels[1].objects, (std::vector<std::string>{"$file wall.obj", "$turn 90"}));
  EXPECT_EQ(grid.labels[2].name, "never seen");
}

TEST(LabelText, WhatIsWrittenIsReadBack) {
  LabelGrid grid = randomGrid({5, 4, 3}, 9, 1);
  grid.name = "a scene";
  grid.labels[3].objects = {"$one", "$two"};
  const LabelGrid back = parseLabelText(formatLabelText(grid), "f");
  EXPECT_EQ(back.cells, grid.cells);
  EXPECT_EQ(back.name, grid.name);
  for (int label = 1; label < 9; ++label) {
    EXPECT_EQ(back.labels[label].name, grid.labels[label].name);
    EXPECT_EQ(back.labels[label].objects, grid.labels[label].objects);
  }
  EXPECT_EQ(formatLabelText(back), formatLabelText(grid));
}

TEST(LabelText, NamesCannotBreakTheFormat) {
  LabelGrid grid = randomGrid({2, 2, 2}, 3, 1);
  grid.labels[1].name = "two\nlines";
  grid.labels[2].name = "</Objects>";
  const LabelGrid back = parseLabelText(formatLabelText(grid), "f");
  EXPECT_EQ(back.cells, grid.cells);
  EXPECT_EQ(back.labels[1].name, "two lines");
  EXPECT_EQ(back.labels[2].name, "label 2");
}

TEST(LabelText, ErrorsNameTheLineAndWhatWouldBeRight) {
  const std::string head = "a\nb\nc\n";
  EXPECT_THAT(textError("a\nb"), HasSubstr("f.txt:2: the file ends"));
  EXPECT_THAT(textError(head), HasSubstr("the grid's size, three numbers on line 4"));
  EXPECT_THAT(textError(head + "2 2\n\n1 1 1 1"),
              HasSubstr("f.txt:4: the size along z is missing"));
  EXPECT_THAT(textError(head + "2 2 2 2\n\n1"), HasSubstr("f.txt:4: expected three numbers alone"));
  EXPECT_THAT(textError(head + "0 2 2\n\n1"), HasSubstr("f.txt:4: the size along x should be 1"));
  EXPECT_THAT(textError(head + "2 -2 2\n\n1"), HasSubstr("f.txt:4: the size along y should be 1"));
  EXPECT_THAT(textError(head + "x 2 2\n\n1"), HasSubstr("f.txt:4: the size along x should be a"));
  EXPECT_THAT(textError(head + "30000 30000 30000\n\n1 1"), HasSubstr("than the file has room"));
  EXPECT_THAT(textError(head + "1 3 1\n\n100 2000"),
              HasSubstr("f.txt:6: the file ends after 2 of 3"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1\n-2"),
              HasSubstr("f.txt:7: a label should be 0 to 65535"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1 65536"), HasSubstr("65536"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1 1.5"), HasSubstr("should be a whole number"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1 two"), HasSubstr("f.txt:6: a label should be a whole"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1 2 3"), HasSubstr("'3' follows the last of 2 labels"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1 2\n\n3 4"), HasSubstr("f.txt:8: expected <Objects>"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1 2\n<Objects>\ns\nwall\n$a"),
              HasSubstr("before its '#'"));
  EXPECT_THAT(textError(head + "1 2 1\n\n1 2\n<Objects>\ns\nwall\nx\n#"), HasSubstr("f.txt:10: "));
}

// MagicaVoxel

TEST(Vox, AModelIsReadWithItsColors) {
  std::string palette(1024, '\0');
  palette.replace(4 * 6, 4, "\x10\x80\xf0\xff", 4);  // color 7 is the seventh entry
  const LabelGrid grid = parseVox(
      voxFile(voxModel({2, 3, 4}, std::string("\1\2\3\7\0\0\0\x9", 8)) + voxChunk("RGBA", palette)),
      "f.vox");
  ASSERT_EQ(grid.size(), (Vec3i{2, 3, 4}));
  ASSERT_EQ(grid.labelCount(), 3);
  EXPECT_EQ(grid.cells(1, 2, 3), 1);
  EXPECT_EQ(grid.cells(0, 0, 0), 2);
  EXPECT_EQ(grid.cells(1, 0, 0), 0);
  EXPECT_TRUE(isEmpty(grid.labels[0]));
  EXPECT_EQ(grid.labels[1].color, (std::array<float, 4>{srgb8ToLinear(0x10), srgb8ToLinear(0x80),
                                                        srgb8ToLinear(0xf0), 1}));
}

TEST(Vox, WithoutAPaletteTheDefaultOneIsMeant) {
  // Known entries: 1 is white, 2 pale yellow, 216 the first red of the ramps, 255 the last gray.
  const LabelGrid grid = parseVox(
      voxFile(voxModel({4, 1, 1}, std::string("\0\0\0\1\1\0\0\2\2\0\0\xd8\3\0\0\xff", 16))), "f");
  const auto srgb = [&](int label) {
    const auto& c = grid.labels[label].color;
    return std::array<int, 3>{linearToSrgb8(c[0]), linearToSrgb8(c[1]), linearToSrgb8(c[2])};
  };
  EXPECT_EQ(srgb(1), (std::array<int, 3>{255, 255, 255}));
  EXPECT_EQ(srgb(2), (std::array<int, 3>{255, 255, 204}));
  EXPECT_EQ(srgb(3), (std::array<int, 3>{0xee, 0, 0}));
  EXPECT_EQ(srgb(4), (std::array<int, 3>{0x11, 0x11, 0x11}));
}

TEST(Vox, TheSceneMovesAndTurnsModels) {
  // Model 0: 3 x 1 x 1, color 1 at its low end. Turned a quarter about z, (x, y) to (-y, x): the
  // first row takes y with a minus, the second x: bits 1 | 0 << 2 | 1 << 4 = 17.
  const std::string models = voxModel({3, 1, 1}, std::string("\0\0\0\1\1\0\0\2\2\0\0\2", 12));
  const std::string scene = voxTransform(0, 1, "", "") + voxGroup(1, {2, 4}) +
                            voxTransform(2, 3, "", "0 0 0") + voxShape(3, 0) +
                            voxTransform(4, 5, "17", "5 0 2") + voxShape(5, 0);
  const LabelGrid grid = parseVox(voxFile(models + scene), "f");
  // Model 0 turns about cell 1's low corner: cells -1, 0, 1 along x; turned, -1, 0, 1 along y. The
  // model is one cell thick: its y, 0 to 1, becomes x from -1 to 0, moved to 4.
  ASSERT_EQ(grid.size(), (Vec3i{6, 3, 3}));
  EXPECT_EQ(grid.cells(0, 1, 0), 1);
  EXPECT_EQ(grid.cells(1, 1, 0), 2);
  EXPECT_EQ(grid.cells(2, 1, 0), 2);
  EXPECT_EQ(grid.cells(5, 0, 2), 1);
  EXPECT_EQ(grid.cells(5, 1, 2), 2);
  EXPECT_EQ(grid.cells(5, 2, 2), 2);
}

TEST(Vox, HiddenNodesAreLeftOutAndSceneLessFilesShowTheFirstModel) {
  const std::string models = voxModel({1, 1, 1}, std::string("\0\0\0\1", 4)) +
                             voxModel({2, 1, 1}, std::string("\0\0\0\2", 4));
  EXPECT_EQ(parseVox(voxFile(models), "f").size(), (Vec3i{1, 1, 1}));
  const std::string hidden =
      voxChunk("nTRN", little(2) + little(1) + voxString("_hidden") + voxString("1") + little(3) +
                           little(-1) + little(-1) + little(1) + little(0));
  const std::string scene = voxTransform(0, 1, "", "") + voxGroup(1, {2, 4}) + hidden +
                            voxShape(3, 0) + voxTransform(4, 5, "", "") + voxShape(5, 1);
  EXPECT_EQ(parseVox(voxFile(models + scene), "f").size(), (Vec3i{2, 1, 1}));
}

TEST(Vox, WhatIsWrittenIsReadBack) {
  const LabelGrid grid = randomGrid({7, 5, 6}, 40, 2);
  const LabelGrid back = parseVox(formatVox(grid, "f"), "f");
  EXPECT_EQ(back.cells, grid.cells);
  for (int label = 1; label < 40; ++label) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(linearToSrgb8(back.labels[label].color[c]),
                linearToSrgb8(grid.labels[label].color[c]));
    }
  }
}

TEST(Vox, GridsLongerThanAModelAreWrittenAsSeveral) {
  const LabelGrid grid = randomGrid({300, 3, 257}, 5, 3);
  EXPECT_EQ(parseVox(formatVox(grid, "f"), "f").cells, grid.cells);
}

TEST(Vox, MoreLabelsThanColorsAreRefusedUnlessCellsHaveFewer) {
  LabelGrid grid = randomGrid({10, 10, 10}, 300, 4);
  EXPECT_THAT(errorOf([&] { formatVox(grid, "f.vox"); }), HasSubstr("a .vox has 255 colors"));
  for (Label& label : grid.cells.values()) label = label < 150 ? 0 : 299;
  const LabelGrid back = parseVox(formatVox(grid, "f.vox"), "f");
  EXPECT_EQ(back.labelCount(), 2);
}

TEST(Vox, ErrorsSayWhatIsWrong) {
  const std::string voxel("\0\0\0\1", 4);
  EXPECT_THAT(voxError("not a vox file"), HasSubstr("f.vox: not a MagicaVoxel file"));
  EXPECT_THAT(voxError("VOX " + little(7) + "MAIN" + little(0) + little(0)),
              HasSubstr("version 7"));
  EXPECT_THAT(voxError(voxFile("")), HasSubstr("holds no model"));
  EXPECT_THAT(voxError(voxFile(voxModel({0, 1, 1}, voxel))), HasSubstr("0 cells long"));
  EXPECT_THAT(voxError(voxFile(voxModel({1, 999, 1}, voxel))), HasSubstr("999 cells long"));
  EXPECT_THAT(voxError(voxFile(voxModel({1, 1, 1}, std::string("\1\0\0\1", 4)))),
              HasSubstr("a voxel at (1, 0, 0) is outside its model of 1 x 1 x 1 cells"));
  EXPECT_THAT(voxError(voxFile(voxModel({1, 1, 1}, std::string(4, '\0')))),
              HasSubstr("0; expected 1 to 255"));
  EXPECT_THAT(voxError(voxFile(voxChunk("SIZE", little(1) + little(1) + little(1)) +
                               voxChunk("XYZI", little(2000000000) + voxel))),
              HasSubstr("2000000000 items"));
  EXPECT_THAT(voxError(voxFile(voxChunk("SIZE", little(1) + little(1) + little(1)))),
              HasSubstr("a size and no voxels"));
  const std::string model = voxModel({1, 1, 1}, voxel);
  EXPECT_THAT(voxError(voxFile(model + voxTransform(0, 1, "", "") + voxGroup(1, {0}))),
              HasSubstr("holds itself"));
  EXPECT_THAT(voxError(voxFile(model + voxTransform(0, 9, "", ""))), HasSubstr("no node"));
  EXPECT_THAT(voxError(voxFile(model + voxTransform(0, 1, "", "") + voxShape(1, 3))),
              HasSubstr("shows model 3 of 1"));
  EXPECT_THAT(voxError(voxFile(model + voxTransform(0, 1, "5", "") + voxShape(1, 0))),
              HasSubstr("rotation"));
  EXPECT_THAT(voxError(voxFile(model + voxTransform(0, 1, "", "1 2") + voxShape(1, 0))),
              HasSubstr("translation"));
  const std::string far = voxTransform(0, 1, "", "") + voxGroup(1, {2, 4}) +
                          voxTransform(2, 3, "", "0 0 0") + voxShape(3, 0) +
                          voxTransform(4, 5, "", "2000000000 0 0") + voxShape(5, 0);
  EXPECT_THAT(voxError(voxFile(model + far)), HasSubstr("at most 32767 fit"));
}

// OpenVDB

TEST(LabelVdb, KeepsEverything) {
  const Folder folder;
  LabelGrid grid = randomGrid({5, 6, 7}, 300, 5);
  grid.cells(0, 0, 0) = grid.cells(4, 5, 6) = 0;
  grid.cellSize = {0.5, 1.5, 2};
  grid.origin = {-3, 0.25, 8};
  grid.name = "town";
  grid.labels[7].objects = {"$wall.obj"};
  grid.labels[8].color = {0.1f, 0.2f, 1 / 3.0f, 0.5f};
  writeLabels(folder / "g.vdb", grid);
  const LabelGrid back = readLabels(folder / "g.vdb");
  EXPECT_EQ(back.cells, grid.cells);
  EXPECT_EQ(back.name, "town");
  ASSERT_EQ(back.labelCount(), 300);
  for (int label = 0; label < 300; ++label) {
    EXPECT_EQ(back.labels[label].name, grid.labels[label].name);
    EXPECT_EQ(back.labels[label].color, grid.labels[label].color);
    EXPECT_EQ(back.labels[label].objects, grid.labels[label].objects);
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_DOUBLE_EQ(back.cellSize[axis], grid.cellSize[axis]);
    EXPECT_NEAR(back.origin[axis], grid.origin[axis], 1e-12);
  }
  const std::string bytes = readFile(folder / "g.vdb");
  writeLabels(folder / "h.vdb", grid);
  EXPECT_EQ(readFile(folder / "h.vdb"), bytes);
}

TEST(LabelVdb, AnEmptyGridKeepsItsSize) {
  const Folder folder;
  LabelGrid grid = randomGrid({3, 4, 5}, 1, 5);
  writeLabels(folder / "g.vdb", grid);
  EXPECT_EQ(readLabels(folder / "g.vdb").cells, grid.cells);
}

// By ending

TEST(LabelFile, EveryEndingThatIsWrittenIsRead) {
  const Folder folder;
  const LabelGrid grid = randomGrid({6, 5, 1}, 4, 6);
  for (const std::string ending : {".txt", ".vox", ".vdb", ".png"}) {
    writeLabels(folder / ("g" + ending), grid);
    const LabelGrid back = readLabels(folder / ("g" + ending));
    ASSERT_EQ(back.size(), grid.size()) << ending;
    // A picture renumbers its labels.
    if (ending != ".png") {
      EXPECT_EQ(back.cells, grid.cells) << ending;
    }
  }
}

TEST(LabelFile, WhatAFormatCannotHoldIsRefusedAndNothingIsWritten) {
  const Folder folder;
  const LabelGrid deep = randomGrid({2, 2, 2}, 4, 6);
  EXPECT_THAT(errorOf([&] { writeLabels(folder / "g.png", deep); }), HasSubstr("2 layers"));
  EXPECT_THAT(errorOf([&] { writeLabels(folder / "g.xyz", deep); }), HasSubstr("g.xyz"));
  LabelGrid wrong = deep;
  wrong.cells(1, 1, 0) = 9;
  EXPECT_THAT(errorOf([&] { writeLabels(folder / "g.txt", wrong); }),
              HasSubstr("cell (1, 1, 0) has label 9 of 4"));
  EXPECT_FALSE(fs::exists(folder / "g.png"));
  EXPECT_FALSE(fs::exists(folder / "g.txt"));
}

TEST(LabelFile, RealFilesAreReadWhereTheyAreAtHand) {
  const fs::path data = fs::path(EXEMPLAR_SOURCE_DIR) / "../shared/data/vox";
  if (!fs::exists(data)) GTEST_SKIP() << "no sample files at " << data;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    if (entry.path().extension() != ".vox") continue;
    const LabelGrid grid = readLabels(entry.path());
    EXPECT_GT(grid.cells.count(), 0u);
    EXPECT_EQ(parseVox(formatVox(grid, "f"), "f").cells, grid.cells) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 10);
}

TEST(DistinctColor, NeighborsDiffer) {
  for (int label = 1; label < 500; ++label) {
    const auto a = distinctColor(label), b = distinctColor(label + 1);
    float most = 0;
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(a[c], 0);
      EXPECT_LE(a[c], 1);
      most = std::max(most, std::abs(a[c] - b[c]));
    }
    EXPECT_GT(most, 0.05f) << label;
  }
}

}  // namespace
}  // namespace exemplar
