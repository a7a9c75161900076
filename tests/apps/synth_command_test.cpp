// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The main path as a user runs it: from file to file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/scene.h"
#include "sdf/height_map.h"
#include "sdf/vdb_file.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

/// A small example that each run below can afford.
constexpr const char* kQuick = " --resolution 32 --block 8 ";

std::string scene(const std::string& name) {
  return std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/" + name + ".toml";
}

TEST(SynthCommand, WritesASoundMeshAPictureAndFigures) {
  const TestFolder folder;
  const auto result =
      runExemplar("synth " + scene("chainmail") + kQuick +
                      "-o o.glb --preview o.png --size 160x120 --samples 4 --stats o.json",
                  folder.path());
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(folder.files(), "o.glb o.json o.png");
  const TriangleMesh mesh = readMesh(folder / "o.glb");
  const MeshHealth health = meshHealth(mesh);
  EXPECT_TRUE(health.closed());
  EXPECT_TRUE(health.manifold());
  EXPECT_TRUE(health.oriented());
  EXPECT_TRUE(mesh.hasMaterials());
  const auto stats = nlohmann::json::parse(readFile(folder / "o.json"));
  EXPECT_GT(stats["seconds"]["total"].get<double>(), 0);
  EXPECT_GT(stats["peak_rss_bytes"].get<double>(), 1e6);
  EXPECT_EQ(stats["mesh"]["triangles"].get<std::size_t>(), mesh.triangles.size());
}

TEST(SynthCommand, GivesTheSameBytesAtOneAndEightThreadsAndOthersForAnotherSeed) {
  const TestFolder folder;
  for (const std::string method : {"blocks", "optimize"}) {
    const std::string command = "synth " + scene("chainmail") + kQuick + "--method " + method;
    ASSERT_EQ(runExemplar(command + " -o a.ply --threads 1", folder.path()).status, 0);
    ASSERT_EQ(runExemplar(command + " -o b.ply --threads 8", folder.path()).status, 0);
    ASSERT_EQ(runExemplar(command + " -o c.ply --seed 1", folder.path()).status, 0);
    EXPECT_EQ(readFile(folder / "a.ply"), readFile(folder / "b.ply")) << method;
    EXPECT_NE(readFile(folder / "a.ply"), readFile(folder / "c.ply")) << method;
  }
}

TEST(SynthCommand, AFieldAndItsOriginsAgree) {
  const TestFolder folder;
  const auto result = runExemplar(
      "synth " + scene("chainmail") + kQuick + "--method blocks -o o.vdb --origins origins.vdb",
      folder.path());
  ASSERT_EQ(result.status, 0) << result.err;
  ASSERT_EQ(
      runExemplar("sdf " + scene("chainmail") + " --resolution 32 -o e.vdb", folder.path()).status,
      0);
  const DistanceField field = readVdb(folder / "o.vdb"), example = readVdb(folder / "e.vdb");
  const Origins origins = readOriginsVdb(folder / "origins.vdb");
  ASSERT_EQ(origins.size(), field.size());
  for (std::size_t n = 0; n < origins.count(); ++n) {
    ASSERT_EQ(field.values.values()[n], example.values[origins.values()[n].cell()]);
  }
}

TEST(SynthCommand, AHeightMapGivesAHeightMapOrAMesh) {
  const TestFolder folder;
  HeightMap map{48, 48, std::vector<float>(48 * 48), 1};
  for (int n = 0; n < 48 * 48; ++n)
    map.heights[n] = static_cast<float>(100 + (n % 48 * 7 + n / 48 * 5) % 90);
  writeHeightMap(folder / "e.pgm", map);
  ASSERT_EQ(
      runExemplar(std::string("synth e.pgm --cell-size 10") + kQuick + "-o o.png", folder.path())
          .status,
      0);
  const HeightMap result = readHeightMap(folder / "o.png");
  EXPECT_GT(result.width, 32);
  ASSERT_EQ(
      runExemplar(std::string("synth e.pgm --cell-size 10") + kQuick + "-o o.obj", folder.path())
          .status,
      0);
  EXPECT_TRUE(meshHealth(readMesh(folder / "o.obj")).closed());
}

TEST(SdfAndMeshCommands, GoThereAndBack) {
  const TestFolder folder;
  ASSERT_EQ(runExemplar("scene balls -o e.ply", folder.path()).status, 0);
  ASSERT_EQ(runExemplar("sdf e.ply --resolution 48 -o e.vdb", folder.path()).status, 0);
  ASSERT_EQ(runExemplar("mesh e.vdb -o m.obj", folder.path()).status, 0);
  const MeshHealth health = meshHealth(readMesh(folder / "m.obj"));
  EXPECT_TRUE(health.closed() && health.manifold() && health.oriented());
  EXPECT_GT(health.signedVolume, 0);
}

TEST(MeasureCommand, AnExampleIsLikeItselfAndUnlikeAnother) {
  const TestFolder folder;
  const auto share = [&](const std::string& example, const std::string& result) {
    const auto run =
        runExemplar("measure " + example + " " + result + " --json f.json", folder.path());
    EXPECT_EQ(run.status, 0) << run.err;
    return nlohmann::json::parse(readFile(folder / "f.json"))["likeness"]["lp_dense"].get<double>();
  };
  ASSERT_EQ(
      runExemplar("sdf " + scene("chainmail") + " --resolution 32 -o a.vdb", folder.path()).status,
      0);
  ASSERT_EQ(runExemplar("sdf " + scene("grid") + " --resolution 32 -o b.vdb", folder.path()).status,
            0);
  EXPECT_EQ(share("a.vdb", "a.vdb"), 1.0);
  // Voxel sizes differ, and that is said.
  const auto other = runExemplar("measure a.vdb b.vdb --json f.json", folder.path());
  EXPECT_TRUE(other.status == 2 || share("a.vdb", "b.vdb") < 0.2) << other.err;
}

TEST(SynthCommand, QuietSaysNothing) {
  const TestFolder folder;
  const auto result =
      runExemplar("synth " + scene("chainmail") + kQuick + "-q -o o.obj", folder.path());
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
}

}  // namespace
}  // namespace exemplar
