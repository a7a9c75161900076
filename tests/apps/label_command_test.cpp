// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Labels on the command line: voxelize, info, and synth by the model engine.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/file.h"
#include "mesh/image.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/primitives.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

/// Labels as this test reads them, by the format's description alone.
struct Grid {
  int x = 0, y = 0, z = 0;
  std::vector<int> labels;
  int at(int i, int j, int k) const { return labels[(k * x + i) * y + j]; }
};

Grid readGrid(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  for (int n = 0; n < 3; ++n) std::getline(in, line);
  Grid grid;
  in >> grid.x >> grid.y >> grid.z;
  for (int label;
       grid.labels.size() < static_cast<std::size_t>(grid.x) * grid.y * grid.z && in >> label;) {
    grid.labels.push_back(label);
  }
  EXPECT_EQ(grid.labels.size(), static_cast<std::size_t>(grid.x) * grid.y * grid.z);
  return grid;
}

using Pairs = std::set<std::array<int, 3>>;

Pairs pairsOf(const Grid& grid) {
  Pairs pairs;
  for (int k = 0; k < grid.z; ++k) {
    for (int i = 0; i < grid.x; ++i) {
      for (int j = 0; j < grid.y; ++j) {
        if (i + 1 < grid.x) pairs.insert({0, grid.at(i, j, k), grid.at(i + 1, j, k)});
        if (j + 1 < grid.y) pairs.insert({1, grid.at(i, j, k), grid.at(i, j + 1, k)});
        if (k + 1 < grid.z) pairs.insert({2, grid.at(i, j, k), grid.at(i, j, k + 1)});
      }
    }
  }
  return pairs;
}

int violations(const Grid& result, const Grid& example) {
  const Pairs allowed = pairsOf(example);
  int count = 0;
  for (const auto& pair : pairsOf(result)) count += !allowed.contains(pair);
  return count;
}

/// Closed rings (5 to 8, with sides 1 to 4) of any size on empty ground, two layers high.
constexpr const char* kRings =
    "rings\n\n\n8 8 3\n\n"
    "0 0 0 0 0 0 0 0\n0 5 2 2 6 0 0 0\n0 1 0 0 1 0 0 0\n0 1 0 0 1 0 0 0\n"
    "0 7 2 2 8 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n\n"
    "0 0 0 0 0 0 0 0\n0 9 0 0 9 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n"
    "0 9 0 0 9 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n\n"
    "0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n"
    "0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0\n\n"
    "<Objects>\nScene\nside x\n#\nside y\n#\nthree\n#\nfour\n#\ncorner\n#\ncorner\n#\ncorner\n#\n"
    "corner\n#\npost\n#\n";

class LabelCommand : public testing::Test {
 protected:
  LabelCommand() { std::ofstream(folder_ / "rings.txt") << kRings; }
  CommandResult run(const std::string& arguments) const {
    return runExemplar(arguments, folder_.path());
  }
  TestFolder folder_;
};

TEST_F(LabelCommand, SynthMakesAGridOfTheExamplesPairs) {
  const CommandResult result =
      run("synth rings.txt -o out.txt --size 20,17,3 --seed 5 --stats s.json");
  ASSERT_EQ(result.status, 0) << result.err;
  const Grid grid = readGrid(folder_ / "out.txt"), example = readGrid(folder_ / "rings.txt");
  EXPECT_EQ(grid.x, 20);
  EXPECT_EQ(grid.y, 17);
  EXPECT_EQ(grid.z, 3);
  EXPECT_EQ(violations(grid, example), 0);
  EXPECT_THAT(readFile(folder_ / "out.txt"), HasSubstr("<Objects>\nScene\nside x\n#\n"));
  const auto stats = nlohmann::json::parse(readFile(folder_ / "s.json"));
  EXPECT_EQ(stats["result_cells"], (std::vector<int>{20, 17, 3}));
  EXPECT_EQ(stats["engine"], "model");
}

TEST_F(LabelCommand, TheCheckFindsAPlantedViolation) {
  const Grid example = readGrid(folder_ / "rings.txt");
  Grid wrong = example;
  std::swap(wrong.labels[9], wrong.labels[10]);
  EXPECT_GT(violations(wrong, example), 0);
}

TEST_F(LabelCommand, TheSameSeedGivesTheSameBytesAtAnyNumberOfThreads) {
  ASSERT_EQ(run("synth rings.txt -o a.txt --size 30,30,3 --seed 3 --threads 1 -q").status, 0);
  ASSERT_EQ(run("synth rings.txt -o b.txt --size 30,30,3 --seed 3 --threads 8 -q").status, 0);
  ASSERT_EQ(run("synth rings.txt -o c.txt --size 30,30,3 --seed 4 -q").status, 0);
  EXPECT_EQ(readFile(folder_ / "a.txt"), readFile(folder_ / "b.txt"));
  EXPECT_NE(readFile(folder_ / "a.txt"), readFile(folder_ / "c.txt"));
}

TEST_F(LabelCommand, WhatIsImpossibleGetsStatusThreeAndNoFile) {
  // A ring's side lies along y here: its corner cannot be beside it along x.
  const CommandResult result =
      run("synth rings.txt -o out.txt --size 9,9,3 --pin 4,4,0=2 --pin 5,4,0=2 --preview p.png "
          "--stats s.json");
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("impossible"));
  EXPECT_EQ(folder_.files(), "rings.txt");
}

TEST_F(LabelCommand, PinsAndWeightsAreKept) {
  ASSERT_EQ(run("synth --weight 6=2 --pin 3,3,0=5 rings.txt -o out.txt --size 12,12,3 -q").status,
            0);
  EXPECT_EQ(readGrid(folder_ / "out.txt").at(3, 3, 0), 5);
  // Without corners there are no rings.
  ASSERT_EQ(run("synth rings.txt -o none.txt --size 12,12,3 --weight corner=0 -q").status, 0);
  const Grid none = readGrid(folder_ / "none.txt");
  EXPECT_EQ(std::count(none.labels.begin(), none.labels.end(), 0), 12 * 12 * 3);
}

TEST_F(LabelCommand, CountsAreKept) {
  ASSERT_EQ(run("synth rings.txt -o out.txt --size 12,12,3 --count post=4..8 -q").status, 0);
  const Grid grid = readGrid(folder_ / "out.txt");
  const auto posts = std::count(grid.labels.begin(), grid.labels.end(), 9);
  EXPECT_GE(posts, 4);
  EXPECT_LE(posts, 8);
  // More posts than cells.
  const CommandResult many = run("synth rings.txt -o no.txt --size 5,5,3 --count post=99..");
  EXPECT_EQ(many.status, 3);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "no.txt"));
}

TEST_F(LabelCommand, MapsSayWhereLabelsAre) {
  // White on the right: rings' corners only there.
  Image8 half{24, 12, 1, {}};
  for (int n = 0; n < 24 * 12; ++n) half.pixels.push_back(n % 24 < 12 ? 0 : 255);
  writePng(folder_ / "half.png", half);
  ASSERT_EQ(run("synth rings.txt -o out.txt --size 24,12,3 --weight-map corner=half.png -q").status,
            0);
  const Grid grid = readGrid(folder_ / "out.txt");
  int right = 0;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 12; ++j) {
      if (grid.at(i, j, 0) < 5 || grid.at(i, j, 0) > 8) continue;
      EXPECT_GE(i, 12);
      ++right;
    }
  }
  EXPECT_GT(right, 0);
  // The same picture is no map of a square, nor is a grid of another size one of this result.
  const CommandResult square =
      run("synth rings.txt -o s.txt --size 12,12,3 --weight-map corner=half.png");
  EXPECT_EQ(square.status, 2);
  EXPECT_THAT(square.err, HasSubstr("not of one shape"));
  const CommandResult other = run("synth rings.txt -o s.txt --size 12,12,3 --mask rings.txt");
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("8 x 8 x 3 cells, and the result 12 x 12 x 3"));
}

TEST_F(LabelCommand, ExamplesWithNothingToChooseFromGetAnAnswer) {
  std::ofstream(folder_ / "one.txt") << "a\nb\nc\n1 1 1\n\n1\n";
  std::ofstream(folder_ / "same.txt") << "a\nb\nc\n2 2 1\n\n1 1\n1 1\n";
  std::ofstream(folder_ / "all.txt") << "a\nb\nc\n2 2 1\n\n1 2\n3 4\n";
  const CommandResult one = run("synth one.txt -o o.txt --size 3,3,1");
  EXPECT_EQ(one.status, 2);
  EXPECT_THAT(one.err, HasSubstr("one cell thick"));
  EXPECT_EQ(run("synth all.txt -o o.txt --size 3,3,1").status, 3);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "o.txt"));
  EXPECT_EQ(run("synth one.txt -o o.txt --size 1,1,1").status, 0);
  ASSERT_EQ(run("synth same.txt -o s.txt --size 3,3,1").status, 0);
  const Grid same = readGrid(folder_ / "s.txt");
  EXPECT_EQ(std::count(same.labels.begin(), same.labels.end(), 1), 9);
}

TEST_F(LabelCommand, EveryFormatIsWritten) {
  for (const std::string ending : {".vox", ".vdb", ".obj", ".glb", ".ply"}) {
    const CommandResult result =
        run("synth rings.txt -o out" + ending + " --size 12,12,3 --pin 3,3,0=5 -q");
    EXPECT_EQ(result.status, 0) << ending << result.err;
  }
  EXPECT_TRUE(meshHealth(readMesh(folder_ / "out.obj")).closed());
  // What was written can be an example in turn.
  for (const std::string ending : {".vox", ".vdb"}) {
    const CommandResult again =
        run("synth out" + ending + " --engine model -o again.txt --size 9,9,3 -q");
    EXPECT_EQ(again.status, 0) << ending << again.err;
  }
}

TEST_F(LabelCommand, PicturesComeBackAsPictures) {
  // Stripes two pixels wide.
  Image8 stripes{8, 6, 3, {}};
  for (int n = 0; n < 48; ++n) {
    for (int c = 0; c < 3; ++c) {
      stripes.pixels.push_back(static_cast<std::uint8_t>(n % 8 / 2 % 2 ? 200 : 10 * c));
    }
  }
  writePng(folder_ / "s.png", stripes);
  const CommandResult result =
      run("synth s.png --engine model --piece 2 -o out.png --size 7,5,1 -q");
  ASSERT_EQ(result.status, 0) << result.err;
  const Image8 out = decodeImage(readFile(folder_ / "out.png"), "out.png");
  EXPECT_EQ(out.width, 14);
  EXPECT_EQ(out.height, 10);
  // Pieces that overlap give one pixel more than cells.
  ASSERT_EQ(
      run("synth s.png --engine model --piece 2 --overlap -o over.png --size 9,5,1 -q").status, 0);
  const Image8 over = decodeImage(readFile(folder_ / "over.png"), "over.png");
  EXPECT_EQ(over.width, 10);
  EXPECT_EQ(over.height, 6);
}

TEST_F(LabelCommand, APeriodicPictureIsThePeriod) {
  // Flowers on meadow: every 3 x 3 pixels of the result, laid side by side, are the example's.
  const std::vector<std::string> drawn{"........", "..a.....", ".aba..c.", "..a..c.c",
                                       "..g...c.", "..g...g.", "..g...g.", "eeeeeeee"};
  Image8 picture{8, 8, 3, {}};
  for (const std::string& row : drawn) {
    for (const char c : row) {
      for (int k = 0; k < 3; ++k)
        picture.pixels.push_back(static_cast<std::uint8_t>((c * (k + 3)) % 251));
    }
  }
  writePng(folder_ / "f.png", picture);
  const CommandResult result =
      run("synth f.png --engine model --piece 3 --overlap --example-periodic xy --periodic xy "
          "-o out.png --size 24,16,1 -q");
  ASSERT_EQ(result.status, 0) << result.err;
  const Image8 out = decodeImage(readFile(folder_ / "out.png"), "out.png");
  ASSERT_EQ(out.width, 24);
  ASSERT_EQ(out.height, 16);
  const auto windows = [](const Image8& image) {
    std::set<std::string> all;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        std::string window;
        for (int n = 0; n < 9; ++n) {
          const auto* p = image.at((x + n % 3) % image.width, (y + n / 3) % image.height);
          for (int k = 0; k < 3; ++k) window.push_back(static_cast<char>(p[k]));
        }
        all.insert(std::move(window));
      }
    }
    return all;
  };
  Image8 colors{out.width, out.height, 3, {}};
  for (int n = 0; n < out.width * out.height; ++n) {
    const auto* p = out.at(n % out.width, n / out.width);
    colors.pixels.insert(colors.pixels.end(), p, p + 3);
  }
  const auto shown = windows(picture), made = windows(colors);
  EXPECT_TRUE(std::includes(shown.begin(), shown.end(), made.begin(), made.end()));
  EXPECT_GT(made.size(), 1u);
}

TEST_F(LabelCommand, OptionsTakeSeveralValues) {
  const CommandResult result =
      run("synth --pin 3,3,0=5 3,3,1=9 rings.txt -o out.txt --size 9,9,3 -q --weight 1=2 2=1");
  ASSERT_EQ(result.status, 0) << result.err;
  const Grid grid = readGrid(folder_ / "out.txt");
  EXPECT_EQ(grid.at(3, 3, 0), 5);
  EXPECT_EQ(grid.at(3, 3, 1), 9);
}

TEST_F(LabelCommand, FramesOfAnExampleBecomeFramesOfAResult) {
  // A ball that moves one cell to the right each frame, round and round.
  std::string frames;
  for (int n = 0; n < 4; ++n) {
    std::ofstream out(folder_ / ("ball" + std::to_string(n) + ".txt"));
    out << "ball\n\n\n4 1 1\n\n";
    for (int x = 0; x < 4; ++x) out << (x == n ? 1 : 0) << "\n";
    frames += " ball" + std::to_string(n) + ".txt";
  }
  const std::string request =
      frames + " --periodic x --size 4,1,1 --frames 4 --loop --pin 0,0,0=1 -q";
  ASSERT_EQ(run("synth -o roll.txt" + request).status, 0);
  ASSERT_EQ(run("synth -o roll.gif" + request).status, 0);
  for (int n = 0; n < 4; ++n) {
    const Grid grid = readGrid(folder_ / ("roll_00" + std::to_string(n) + ".txt"));
    ASSERT_EQ(grid.labels.size(), 4u);
    EXPECT_TRUE(n > 0 || grid.labels[0] == 1);
  }
  EXPECT_EQ(readFile(folder_ / "roll.gif").substr(0, 6), "GIF89a");
}

TEST_F(LabelCommand, SymmetryTakesWhatLabelsAreSaidToBecome) {
  // Corners at small x (5, 6) and at large x (7, 8), at small y (5, 7) and at large y (6, 8).
  ASSERT_EQ(run("synth rings.txt -o out.txt --size 12,11,3 --mirror x --mirrored-x 5=7 "
                "--mirrored-x 6=8 --pin 2,3,0=5 -q")
                .status,
            0);
  const Grid grid = readGrid(folder_ / "out.txt");
  const int image[] = {0, 1, 2, 3, 4, 7, 8, 5, 6, 9};
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < 11; ++j) {
        EXPECT_EQ(grid.at(11 - i, j, k), image[grid.at(i, j, k)]);
      }
    }
  }
}

TEST_F(LabelCommand, SeveralExamplesAreOneStyle) {
  std::ofstream(folder_ / "a.txt") << "a\nb\nc\n2 1 1\n\n1\n2\n";
  std::ofstream(folder_ / "b.txt") << "a\nb\nc\n2 1 1\n\n2\n1\n";
  ASSERT_EQ(run("synth a.txt b.txt -o out.txt --size 5,1,1 -q").status, 0);
  const Grid grid = readGrid(folder_ / "out.txt");
  for (int i = 0; i + 1 < 5; ++i) EXPECT_NE(grid.at(i, 0, 0), grid.at(i + 1, 0, 0));
  EXPECT_EQ(run("synth a.txt -o alone.txt --size 5,1,1 -q").status, 3);
}

TEST_F(LabelCommand, AMeshIsTakenApartAndPutTogether) {
  TriangleMesh mesh;
  for (int n = 0; n < 2; ++n) append(mesh, makeBox({{5.0 * n, 0, 0}, {5.0 * n + 3, 3, 2}}));
  writeMesh(folder_ / "m.ply", mesh);
  const CommandResult result = run(
      "synth m.ply --engine model --cell 1 -o out.ply --size 16,12,4 --pin 8,6,0=0 --seed 1 -q");
  ASSERT_EQ(result.status, 0) << result.err;
  const CommandResult instances =
      run("synth m.ply --engine model --cell 1 -o out.glb --instances --size 16,12,4 --seed 1 -q");
  ASSERT_EQ(instances.status, 0) << instances.err;
  const MeshHealth health = meshHealth(readMesh(folder_ / "out.ply"));
  EXPECT_TRUE(health.closed() && health.oriented());
}

TEST_F(LabelCommand, VoxelizeWritesCellsOfMaterials) {
  writeMesh(folder_ / "m.ply", makeBox({{0, 0, 0}, {4, 3, 2}}));
  const CommandResult result = run("voxelize m.ply -o out.txt --cell 1 --air 1");
  ASSERT_EQ(result.status, 0) << result.err;
  const Grid grid = readGrid(folder_ / "out.txt");
  EXPECT_EQ(grid.x, 6);
  EXPECT_EQ(std::count(grid.labels.begin(), grid.labels.end(), 1), 24);
  EXPECT_THAT(result.out, HasSubstr("24 of 90 cells not empty"));
}

TEST_F(LabelCommand, InfoReportsLabelsAndAdjacency) {
  const CommandResult result = run("info rings.txt --list --json i.json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("8 that cells have"));
  EXPECT_THAT(result.out, HasSubstr("adjacency"));
  const auto json = nlohmann::json::parse(readFile(folder_ / "i.json"));
  EXPECT_EQ(json["labels_used"], 8);
  // Eight labels: of 64 ordered pairs along x these are neighbors.
  const Pairs pairs = pairsOf(readGrid(folder_ / "rings.txt"));
  const auto alongX = std::count_if(pairs.begin(), pairs.end(), [](auto& p) { return p[0] == 0; });
  EXPECT_DOUBLE_EQ(json["adjacency_density"]["x"], static_cast<double>(alongX) / 64);
}

TEST_F(LabelCommand, InfoSaysWhatAnExampleIs) {
  writeMesh(folder_ / "m.ply", makeBox({{0, 0, 0}, {4, 3, 2}}));
  const CommandResult result = run("info m.ply --resolution 24 --json i.json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("it stands free"));
  EXPECT_THAT(result.out, HasSubstr("along z"));
  const auto json = nlohmann::json::parse(readFile(folder_ / "i.json"))["distances"];
  EXPECT_TRUE(json["free_standing"]);
  EXPECT_EQ(json["sides"]["+x"]["kind"], "air");
  EXPECT_TRUE(json["axes"]["x"]["stationary"].is_boolean());
  // Of 24 voxels along the longest side, some are air on either side.
  EXPECT_GT(json["solid_share"], 0.1);
}

TEST_F(LabelCommand, LabelsAreRenderedAndMeshed) {
  ASSERT_EQ(run("render rings.txt -o p.png --size 64x48 --samples 1 -q").status, 0);
  ASSERT_EQ(run("mesh rings.txt -o m.obj -q").status, 0);
  EXPECT_TRUE(meshHealth(readMesh(folder_ / "m.obj")).closed());
}

struct BadRequest {
  const char* name;
  const char* arguments;
  const char* says;
};
void PrintTo(const BadRequest& bad, std::ostream* out) { *out << bad.name; }

class BadLabelRequest : public testing::TestWithParam<BadRequest> {};

TEST_P(BadLabelRequest, GetsOneLineAndStatusTwoAndNoFile) {
  const TestFolder folder;
  std::ofstream(folder / "e.txt") << kRings;
  const CommandResult result =
      runExemplar(std::string("synth ") + GetParam().arguments, folder.path());
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr(GetParam().says));
  const std::string last = result.err.substr(result.err.find("exemplar: "));
  EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << result.err;
  EXPECT_EQ(folder.files(), "e.txt");
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, BadLabelRequest,
    testing::Values(
        BadRequest{"NoSuchFile", "no.txt -o o.txt", "no.txt"},
        BadRequest{"SizeAndScale", "e.txt -o o.txt --size 3,3,3 --scale 2", "--size and --scale"},
        BadRequest{"HalfACell", "e.txt -o o.txt --size 3.5,3,3", "--size 3.5,3,3"},
        BadRequest{"TwoNumbers", "e.txt -o o.txt --size 3,3", "--size 3,3"},
        BadRequest{"HugeSize", "e.txt -o o.txt --size 30000,30000,30000", "memory"},
        BadRequest{"UnknownLabel", "e.txt -o o.txt --pin 1,1,0=99", "there is no label '99'"},
        BadRequest{"UnknownName", "e.txt -o o.txt --weight tree=2", "there is no label 'tree'"},
        BadRequest{"PinOutside", "e.txt -o o.txt --size 5,5,3 --pin 9,1,0=1", "pin"},
        BadRequest{"BadPin", "e.txt -o o.txt --pin here", "--pin here: expected X,Y,Z=LABEL"},
        BadRequest{"BadSide", "e.txt -o o.txt --side up=free", "--side up=free"},
        BadRequest{"NegativeWeight", "e.txt -o o.txt --weight 1=-2", "a weight is 0 or more"},
        BadRequest{"BadAxis", "e.txt -o o.txt --periodic xw", "--periodic xw"},
        BadRequest{"RoundsWithoutBlocks", "e.txt -o o.txt --rounds 2", "only --method blocks"},
        BadRequest{"FramesOfOne", "e.txt -o o.txt --frames 3", "--frames"},
        BadRequest{"StillGif", "e.txt -o o.gif", "o.gif"},
        BadRequest{"TwoImages", "e.txt -o o.txt --mirror x --mirrored-x 1,2=3",
                   "one label on each side"},
        BadRequest{"NoMask", "e.txt -o o.txt --mask no.png", "no.png"},
        BadRequest{"DeepPicture", "e.txt -o o.png", "a picture has one layer"},
        BadRequest{"UnknownOutput", "e.txt -o o.xyz", "o.xyz"},
        BadRequest{"InstancesOfBoxes", "e.txt -o o.glb --instances", "--instances"},
        BadRequest{"GeometryOption", "e.txt -o o.txt --seeding random", "--seeding"},
        BadRequest{"LabelsForGeometry", "e.txt -o o.obj --engine geometry", "e.txt"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace exemplar
