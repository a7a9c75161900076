// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/file.h"
#include "mesh/image.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

const std::string kScene = std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/chainmail.toml";
const std::string kMeasure = "measure e.vdb ";

/// Samples the scene once, so that each command reads it fast.
void makeExample(const TestFolder& folder) {
  ASSERT_EQ(runExemplar("sdf " + kScene + " --resolution 32 -o e.vdb", folder.path()).status, 0);
}

nlohmann::json figures(const TestFolder& folder, const std::string& arguments) {
  const auto run = runExemplar(kMeasure + arguments + " --json -", folder.path());
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out, nullptr, false);
}

TEST(MeasureCommand, ScoresAMeshAsTheFieldItWasContouredFrom) {
  const TestFolder folder;
  makeExample(folder);
  const auto made =
      runExemplar("synth e.vdb --scale 1.5,1.5,1 -o o.vdb --origins origins.vdb", folder.path());
  ASSERT_EQ(made.status, 0) << made.err;
  ASSERT_EQ(runExemplar("mesh o.vdb -o o.obj", folder.path()).status, 0);
  ASSERT_EQ(runExemplar("mesh o.vdb -o o.glb", folder.path()).status, 0);
  const auto field = figures(folder, "o.vdb")["likeness"];
  EXPECT_GT(field["lp_dense"].get<double>(), 0.1);
  for (const std::string result :
       {"o.obj", "o.glb", "o.obj --scale 1.5,1.5,1", "o.glb --origins origins.vdb"}) {
    const auto mesh = figures(folder, result)["likeness"];
    // Samples beside the surface may change sides, and windows come and go with them.
    for (const char* key : {"lp_dense", "coverage", "lp_dense_mean_iou", "coverage_mean_iou",
                            "occupancy_ratio", "surface_ratio"}) {
      EXPECT_NEAR(mesh[key].get<double>(), field[key].get<double>(), 0.05) << result << " " << key;
    }
    // Rings that rest on each other are one body in the mesh: no figure rather than a wrong one.
    EXPECT_TRUE(mesh["broken_share"].is_null());
    EXPECT_FALSE(field["broken_share"].is_null());
  }
}

TEST(MeasureCommand, MeasuresWhatLabelsHold) {
  const TestFolder folder;
  const std::string castle = std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/castle.toml";
  for (const std::string made : {"r.txt", "r.vdb"}) {
    ASSERT_EQ(runExemplar("synth " + castle + " -o " + made, folder.path()).status, 0);
    const auto run = runExemplar("measure " + castle + " " + made + " --json -", folder.path());
    ASSERT_EQ(run.status, 0) << run.err;
    const auto content = nlohmann::json::parse(run.out)["content"];
    EXPECT_GT(content["labels_used"].get<double>(), 0.4);
    EXPECT_GT(content["density"].get<double>(), 0.3);
    EXPECT_LT(content["copy8"].get<double>(), 0.5);
    EXPECT_FALSE(content["js3_halves"].is_null());
  }
  // An example against itself, by its own cells: nothing differs and everything is copied.
  ASSERT_EQ(runExemplar("voxelize " + castle + " -o c.txt", folder.path()).status, 0);
  const auto same = runExemplar("measure c.txt c.txt --json -", folder.path());
  ASSERT_EQ(same.status, 0) << same.err;
  const auto content = nlohmann::json::parse(same.out)["content"];
  EXPECT_EQ(content["js3"], 0.0);
  EXPECT_EQ(content["copy8"], 1.0);
  const auto report = runExemplar("measure c.txt c.txt --report r.html", folder.path());
  EXPECT_EQ(report.status, 2);
  EXPECT_THAT(report.err, HasSubstr("--report: has no meaning for a result of labels"));
}

TEST(MeasureCommand, RefusesASizeThatCannotBe) {
  const TestFolder folder;
  makeExample(folder);
  ASSERT_EQ(runExemplar("mesh e.vdb -o o.obj", folder.path()).status, 0);
  for (const auto& [arguments, error] : std::vector<std::pair<std::string, std::string>>{
           {"o.obj --scale 0.5", "o.obj: the mesh lies at"},
           {"o.obj --scale 0", "--scale"},
           {"e.vdb --scale 1.5,1.5,1", "e.vdb has a size of its own"},
           {"nothing.obj", "nothing.obj"}}) {
    const auto run = runExemplar(kMeasure + arguments, folder.path());
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(error));
  }
}

/// An .asc of waves over a slope that falls to the west; `pits` are dug into it.
std::string waves(int side, bool pits, const std::string& cell = "30") {
  std::string text = "ncols " + std::to_string(side) + "\nnrows " + std::to_string(side) +
                     "\ncellsize " + cell + "\n";
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double h = 2 * x + 9 * std::sin(y * 0.31) - (pits && x % 8 == 4 && y % 8 == 4) * 40;
      text += std::to_string(h) + (x + 1 < side ? " " : "\n");
    }
  }
  return text;
}

TEST(MeasureCommand, MeasuresHeightMapsAsTerrain) {
  const TestFolder folder;
  writeFile(folder / "e.asc", waves(96, false));
  writeFile(folder / "pits.asc", waves(96, true));
  const auto run = runExemplar("measure e.asc pits.asc --json -", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  const auto terrain = nlohmann::json::parse(run.out)["terrain"];
  EXPECT_EQ(terrain["depressions_per_km2_example"], 0);
  EXPECT_NEAR(terrain["depressions_per_km2"].get<double>(), 144 / (96 * 96 * 0.0009), 1e-6);
  EXPECT_EQ(terrain["flooded_share_example"], 0);
  EXPECT_GT(terrain["flooded_share"], 0.01);
  // A table: the example, its halves, the result.
  const auto table = runExemplar("measure e.asc pits.asc", folder.path());
  EXPECT_THAT(table.out, HasSubstr("example   its half other half     result"));
  // Cells of another size are another resolution.
  writeFile(folder / "other.asc", waves(96, false, "60"));
  const auto other = runExemplar("measure e.asc other.asc", folder.path());
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("one resolution"));
}

TEST(RenderCommand, DrawsHeightMapsAsRelief) {
  const TestFolder folder;
  writeFile(folder / "e.asc", waves(96, false));
  const auto run = runExemplar(
      "render e.asc e.asc -o r.png --light 315,45 --streams 50 --size 96x96", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  const Image8 image = decodeImage(readFile(folder / "r.png"), "r.png");
  EXPECT_EQ(image.width, 96 + 8 + 96);
  EXPECT_EQ(image.height, 96 + 8 + 96);
  const auto surface =
      runExemplar("render e.asc -o s.png --view top --streams 50 --size 96x96", folder.path());
  EXPECT_EQ(surface.status, 2);
  EXPECT_THAT(surface.err, HasSubstr("--streams: only relief has it"));
}

}  // namespace
}  // namespace exemplar
