// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The main path as a user runs it: from file to file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "maps/height_map_file.h"
#include "mesh/image.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/scene.h"
#include "sdf/vdb_file.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

/// A small example that each run below can afford.
constexpr const char* kQuick = " --resolution 32 ";
/// The same for the engine blocks.
constexpr const char* kQuickBlocks = " --resolution 32 --engine blocks --block 8 ";

std::string scene(const std::string& name) {
  return std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/" + name + ".toml";
}

// Several results of one reading, and each is what its seed makes alone.
TEST(SynthCommand, MakesSeveralResultsOfOneExample) {
  const TestFolder folder;
  const std::string common = "synth " + scene("chainmail") + kQuick + "--scale 1.5,1.5,1 ";
  const auto run =
      runExemplar(common + "-n 3 --seed 4 -o m.vdb -o m.stl --stats s.json", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.files(),
            "m_000.stl m_000.vdb m_001.stl m_001.vdb m_002.stl m_002.vdb s_000.json s_001.json "
            "s_002.json");
  ASSERT_EQ(runExemplar(common + "--seed 5 -o one.vdb", folder.path()).status, 0);
  EXPECT_EQ(readFile(folder / "m_001.vdb"), readFile(folder / "one.vdb"));
  EXPECT_NE(readFile(folder / "m_000.vdb"), readFile(folder / "one.vdb"));

  const auto input = runExemplar("synth m_001.vdb -n 2 -o m.vdb", folder.path());
  EXPECT_EQ(input.status, 2);
  EXPECT_THAT(input.err, testing::HasSubstr("m_001.vdb: is read or written already"));
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
  for (const std::string engine : {"blocks --block 8", "quilting", "voting"}) {
    const std::string command =
        "synth " + scene("chainmail") + " --resolution 24 --scale 1.5,1,1 --engine " + engine;
    ASSERT_EQ(runExemplar(command + " -o a.ply --threads 1", folder.path()).status, 0);
    ASSERT_EQ(runExemplar(command + " -o b.ply --threads 8", folder.path()).status, 0);
    ASSERT_EQ(runExemplar(command + " -o c.ply --seed 1", folder.path()).status, 0);
    EXPECT_EQ(readFile(folder / "a.ply"), readFile(folder / "b.ply")) << engine;
    EXPECT_NE(readFile(folder / "a.ply"), readFile(folder / "c.ply")) << engine;
  }
}

TEST(SynthCommand, AFieldAndItsOriginsAgree) {
  const TestFolder folder;
  const auto result =
      runExemplar("synth " + scene("chainmail") + kQuickBlocks + "-o o.vdb --origins origins.vdb",
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

TEST(SynthCommand, AHeightMapGivesMoreOfItInItsUnits) {
  const TestFolder folder;
  HeightMap map{Grid<float>(48, 40), 25};
  for (int n = 0; n < 48 * 40; ++n)
    map.heights[n] = static_cast<float>(-3.25 + (n % 48 * 7 + n / 48 * 5) % 90);
  writeHeightMap(folder / "e.asc", map);
  ASSERT_EQ(runExemplar("synth e.asc --scale 1.5,2,1 -o o.asc -o o.obj --preview p.png --stats "
                        "s.json",
                        folder.path())
                .status,
            0);
  const HeightMap result = readHeightMap(folder / "o.asc");
  EXPECT_EQ(result.width(), 72);
  EXPECT_EQ(result.height(), 80);
  EXPECT_EQ(result.cellSize, 25);
  EXPECT_LT(*std::ranges::min_element(result.heights.values()), 20);
  EXPECT_GT(*std::ranges::max_element(result.heights.values()), 50);
  EXPECT_TRUE(meshHealth(readMesh(folder / "o.obj")).manifold());
  EXPECT_GT(readPng16(folder / "p.png").height, 2 * 80);
  const auto stats = nlohmann::json::parse(readFile(folder / "s.json"));
  EXPECT_EQ(stats["engine"], "terrain");
}

TEST(SynthCommand, AHeightMapAsAVolumeGivesAHeightMapOrAMesh) {
  const TestFolder folder;
  HeightMap map{Grid<float>(48, 48), 1};
  for (int n = 0; n < 48 * 48; ++n)
    map.heights[n] = static_cast<float>(100 + (n % 48 * 7 + n / 48 * 5) % 90);
  writeHeightMap(folder / "e.pgm", map, {.heightScale = 1});
  ASSERT_EQ(
      runExemplar(std::string("synth e.pgm --engine geometry --cell-size 10") + kQuick + "-o o.png",
                  folder.path())
          .status,
      0);
  const HeightMap result = readHeightMap(folder / "o.png");
  EXPECT_GT(result.width(), 32);
  ASSERT_EQ(
      runExemplar(std::string("synth e.pgm --engine geometry --cell-size 10") + kQuick + "-o o.obj",
                  folder.path())
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
  const auto other = runExemplar("measure a.vdb b.vdb", folder.path());
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, testing::HasSubstr("voxel"));
}

TEST(SynthCommand, OldSpellingsOfEnginesStillWork) {
  const TestFolder folder;
  const std::string make = "synth " + scene("chainmail") + " --resolution 20 --scale 1,1,1 ";
  for (const auto& [old, now] :
       {std::pair{"--method blocks --block 8 --size 60x40", "--engine blocks --block 8"},
        {"--method optimize", "--engine geometry"},
        {"--engine geometry --method blocks --block 8", "--engine blocks --block 8"}}) {
    ASSERT_EQ(runExemplar(make + old + " -o a.ply", folder.path()).status, 0) << old;
    ASSERT_EQ(runExemplar(make + now + " -o b.ply", folder.path()).status, 0) << now;
    EXPECT_EQ(readFile(folder / "a.ply"), readFile(folder / "b.ply")) << old;
  }
}

TEST(SynthCommand, AnOptionOfAnotherEngineIsRefusedWithTheEnginesThatHaveIt) {
  const TestFolder folder;
  for (const auto& [arguments, says] : std::vector<std::pair<std::string, std::string>>{
           {scene("chainmail") + " --block 8",
            "--block: the engine geometry has no such setting; "
            "blocks, model and continuous have"},
           {scene("chainmail") + " --seeding masked", "blocks has"},
           {scene("chainmail") + " --engine blocks --periodic x",
            "geometry, quilting, voting, model and terrain have"},
           {scene("castle") + " --surface copy",
            "geometry, quilting, voting, blocks and surface have"},
           {"--instances " + scene("chainmail"), "--instances: the engine geometry has no such"}}) {
    const auto run = runExemplar("synth " + arguments + " -o o.glb", folder.path());
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, testing::HasSubstr(says)) << arguments;
    EXPECT_EQ(folder.files(), "");
  }
}

TEST(SynthCommand, AFlagBeforeTheExampleDoesNotChangeTheEngine) {
  const TestFolder folder;
  const auto run = runExemplar("synth --instances " + scene("castle") + " --size 12,12,7 -o o.glb",
                               folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr(" instances"));
}

TEST(SynthCommand, OptionsAreCheckedBeforeAFileIsRead) {
  const TestFolder folder;
  for (const auto& [option, says] :
       {std::pair{"--scale 2x2x1", "--scale 2x2x1: '2x2x1' is not a number"},
        {"--levels 99", "--levels 99: expected 1 to 8"},
        {"--stationary xq", "--stationary xq: expected axes"},
        {"--seed -1.5", "--seed -1.5: expected a whole number"}}) {
    const auto run = runExemplar(std::string("synth none.obj -o o.obj ") + option, folder.path());
    EXPECT_EQ(run.status, 2) << option;
    EXPECT_THAT(run.err, testing::HasSubstr(says)) << option;
  }
}

TEST(SynthCommand, NothingIsOverwrittenThatIsReadOrWrittenAlready) {
  const TestFolder folder;
  ASSERT_EQ(runExemplar("scene balls -o e.ply", folder.path()).status, 0);
  const std::string before = readFile(folder / "e.ply");
  for (const std::string outputs :
       {"-o e.ply", "-o ./e.ply", "-o o.vdb --origins o.vdb", "-o o.png --preview ./o.png"}) {
    const auto run = runExemplar("synth e.ply " + outputs, folder.path());
    EXPECT_EQ(run.status, 2) << outputs;
    EXPECT_THAT(run.err, testing::HasSubstr("is read or written already")) << outputs;
  }
  EXPECT_EQ(folder.files(), "e.ply");
  EXPECT_EQ(readFile(folder / "e.ply"), before);
}

TEST(SynthCommand, SeveralOutputsAreOneRunAndAreCheckedBeforeIt) {
  const TestFolder folder;
  const std::string run = "synth " + scene("chainmail") + kQuick;
  const auto several =
      runExemplar(run + "-o a.glb -o b.vdb -o c.obj --stats s.json", folder.path());
  ASSERT_EQ(several.status, 0) << several.err;
  EXPECT_EQ(folder.files(), "a.glb b.vdb c.mtl c.obj s.json");
  ASSERT_EQ(runExemplar(run + "-o d.glb", folder.path()).status, 0);
  EXPECT_EQ(readFile(folder / "a.glb"), readFile(folder / "d.glb"));
  EXPECT_EQ(readMesh(folder / "c.obj").triangles.size(),
            readMesh(folder / "a.glb").triangles.size());
  const auto stats = nlohmann::json::parse(readFile(folder / "s.json"));
  EXPECT_EQ(stats["outputs"], nlohmann::json({"a.glb", "b.vdb", "c.obj"}));
  // A mistake in the last one costs no work, and no file.
  for (const std::string outputs :
       {"-o n.glb -o n.xyz", "-o n.glb -o ./n.glb", "-o n.glb -o none/n.vdb",
        "-o n_lod1.ply -o n.ply --lods 1", "-o n.glb -o n_lod2.glb --lods 2"}) {
    const auto bad = runExemplar("synth missing.obj " + outputs, folder.path());
    EXPECT_EQ(bad.status, 2) << outputs;
    EXPECT_THAT(bad.err, testing::Not(testing::HasSubstr("missing.obj"))) << outputs;
  }
  EXPECT_EQ(folder.files(), "a.glb b.vdb c.mtl c.obj d.glb s.json");
}

TEST(SynthCommand, CoarserCopiesAndSourcesAreWrittenBesideTheMesh) {
  const TestFolder folder;
  const std::string balls = scene("balls") + " --resolution 24 ";
  const auto run =
      runExemplar("synth " + balls + "--scale 1,1,1 -o o.glb --lods 2 --source", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.files(), "o.glb o_lod1.glb o_lod2.glb");
  std::size_t before = 0;
  for (const char* file : {"o.glb", "o_lod1.glb", "o_lod2.glb"}) {
    const TriangleMesh mesh = readMesh(folder / file);
    const MeshHealth health = meshHealth(mesh);
    EXPECT_TRUE(health.closed() && health.manifold()) << file;
    EXPECT_TRUE(mesh.hasMaterials()) << file;
    EXPECT_EQ(mesh.name, "balls") << "after its example";
    if (before > 0) {
      // A quarter, and what borders of materials cut.
      EXPECT_LT(mesh.triangles.size(), before * 45 / 100) << file;
    }
    before = mesh.triangles.size();
    for (const char* name : {"_SOURCE_FACE", "_SOURCE_WEIGHTS", "_SOURCE_EXAMPLE"})
      EXPECT_THAT(readFile(folder / file), testing::HasSubstr(name)) << file;
  }
  const auto ply = runExemplar("synth " + balls + "--scale 1,1,1 -o o.ply --source", folder.path());
  EXPECT_THAT(ply.err,
              testing::HasSubstr("o.ply: left out, as this format cannot hold it: sources"));
  // Of the volume, too, and to several files.
  ASSERT_EQ(runExemplar("synth " + balls + "--scale 1,1,1 -o v.vdb --origins g.vdb", folder.path())
                .status,
            0);
  const auto mesh = runExemplar(
      "mesh v.vdb --origins g.vdb --example " + balls + "-o m.glb -o m.obj --lods 1 --source",
      folder.path());
  ASSERT_EQ(mesh.status, 0) << mesh.err;
  EXPECT_EQ(readFile(folder / "m.glb"), readFile(folder / "o.glb"));
  EXPECT_TRUE(std::filesystem::exists(folder / "m_lod1.obj"));
  const auto bare = runExemplar("mesh v.vdb -o b.stl --triangles 15000", folder.path());
  EXPECT_EQ(bare.status, 0) << bare.err;
  EXPECT_LE(readMesh(folder / "b.stl").triangles.size(), 15000u);
  EXPECT_EQ(runExemplar("mesh v.vdb -o v.vdb", folder.path()).status, 2);
  EXPECT_EQ(runExemplar("mesh v.vdb -o b.ply --source", folder.path()).status, 2);
  EXPECT_EQ(runExemplar("mesh v.vdb -o b.ply -o ./b.ply", folder.path()).status, 2);
}

TEST(SynthCommand, SaysWhichSettingsHaveNoMeaningForTheExample) {
  const TestFolder folder;
  ASSERT_EQ(
      runExemplar("sdf " + scene("balls") + " --resolution 24 -o e.vdb", folder.path()).status, 0);
  const auto run =
      runExemplar("synth e.vdb --resolution 99 --padding 3 -o o.vdb --stats s.json", folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string says =
      "e.vdb: --resolution and --padding have no meaning for this kind of example";
  EXPECT_THAT(run.err, testing::HasSubstr("warning: " + says));
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "s.json"))["warnings"][0], says);
}

TEST(SynthCommand, ProgramsGetJsonFromTheFirstErrorToTheLastFile) {
  const TestFolder folder;
  const auto last = [&](const std::string& arguments) {
    const auto run = runExemplar(arguments + " --progress json", folder.path());
    const std::size_t end = run.err.find_last_not_of('\n');
    const std::size_t begin = run.err.rfind('\n', end);
    return nlohmann::json::parse(run.err.substr(begin + 1));
  };
  EXPECT_EQ(last("synth e.obj --frobnicate")["event"], "error");
  EXPECT_EQ(last("synth e.obj -o o.obj")["status"], 2);
  EXPECT_EQ(last("scene balls -o e.ply")["event"], "done");
  EXPECT_EQ(last("sdf e.ply --resolution 16 -o e.vdb")["event"], "done");
  EXPECT_EQ(last("engines")["event"], "done");
}

TEST(EnginesCommand, ListsEveryEngineAndSettingForProgramsToo) {
  const TestFolder folder;
  const auto text = runExemplar("engines", folder.path());
  ASSERT_EQ(text.status, 0);
  for (const char* name : {"geometry", "quilting", "voting", "blocks", "model"})
    EXPECT_THAT(text.out, testing::HasSubstr(name));
  const auto json = nlohmann::json::parse(runExemplar("engines --json", folder.path()).out);
  for (const auto& engine : json) {
    EXPECT_FALSE(engine.at("settings").empty());
    for (const auto& setting : engine.at("settings")) EXPECT_NE(setting.at("meaning"), "");
  }
}

TEST(SynthCommand, QuietSaysNothing) {
  const TestFolder folder;
  const auto result =
      runExemplar("synth " + scene("chainmail") + kQuick + "-q -o o.obj", folder.path());
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST(SynthCommand, SaysAlongWhichAxesPartsMoved) {
  const TestFolder folder;
  const auto found =
      runExemplar("synth " + scene("terrain") + kQuick + "-o o.vdb --stats o.json", folder.path());
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.out, testing::HasSubstr("found from the example"));
  EXPECT_EQ(nlohmann::json::parse(readFile(folder / "o.json"))["stationary"], "x, y");
  const auto given = runExemplar(
      "synth " + scene("terrain") + kQuick + "--stationary none -o p.vdb", folder.path());
  ASSERT_EQ(given.status, 0) << given.err;
  EXPECT_THAT(given.out, testing::HasSubstr("stationary none"));
  EXPECT_NE(readFile(folder / "o.vdb"), readFile(folder / "p.vdb"));
}

TEST(SynthCommand, APeriodicResultContinuesAtItsOtherSide) {
  const TestFolder folder;
  const auto across = [&](const std::string& more) {
    EXPECT_EQ(runExemplar("synth " + scene("terrain") + kQuick + "--scale 1 -o o.vdb" + more,
                          folder.path())
                  .status,
              0);
    const Array3D<float> f = readVdb(folder / "o.vdb").values;
    double sum = 0;
    for (int k = 0; k < f.size().z; ++k) {
      for (int j = 0; j < f.size().y; ++j) {
        sum += std::abs(f(0, j, k) - f(f.size().x - 1, j, k));
      }
    }
    return sum;
  };
  EXPECT_LT(across(" --periodic x,y"), 0.7 * across(""));
}

TEST(SynthCommand, AMeshOfAPeriodicVolumeIsTheOneThatSynthWrites) {
  const TestFolder folder;
  const std::string make = "synth " + scene("balls") + kQuick + "--scale 1 --periodic x,y ";
  ASSERT_EQ(runExemplar(make + "-o o.ply", folder.path()).status, 0);
  ASSERT_EQ(runExemplar(make + "-o o.vdb --origins from.vdb", folder.path()).status, 0);
  const auto plain = runExemplar("mesh o.vdb -o plain.ply", folder.path());
  ASSERT_EQ(plain.status, 0) << plain.err;
  EXPECT_THAT(plain.out, testing::HasSubstr("tiles along x, y"));
  ASSERT_EQ(runExemplar("mesh o.vdb -o dressed.ply --origins from.vdb --resolution 32 --example " +
                            scene("balls"),
                        folder.path())
                .status,
            0);
  EXPECT_EQ(readFile(folder / "dressed.ply"), readFile(folder / "o.ply"));
  // Open where the copies join, and what closes the surface elsewhere is there.
  const MeshHealth open = meshHealth(readMesh(folder / "plain.ply"));
  EXPECT_GT(open.boundaryEdges, 0);
  ASSERT_EQ(runExemplar("sdf o.vdb -o copy.vdb", folder.path()).status, 0);
  ASSERT_EQ(runExemplar("mesh copy.vdb -o copy.ply", folder.path()).status, 0);
  EXPECT_EQ(readFile(folder / "copy.ply"), readFile(folder / "plain.ply"));
}

TEST(SynthCommand, WhatIsKeptStaysAsItIs) {
  const TestFolder folder;
  ASSERT_EQ(
      runExemplar("sdf " + scene("balls") + " --resolution 32 -o e.vdb", folder.path()).status, 0);
  const DistanceField example = readVdb(folder / "e.vdb");
  DistanceField half = example;  // all of it but a slab at its end
  for (std::size_t s = 0; s < half.values.count(); ++s) {
    half.values.values()[s] = half.values.ijk(s).x < 20 ? -1.0f : 1.0f;
  }
  writeVdb(folder / "half.vdb", half);
  const auto result = runExemplar(
      "synth e.vdb --scale 1.25,1,1 --keep half.vdb -o o.vdb --origins origins.vdb", folder.path());
  ASSERT_EQ(result.status, 0) << result.err;
  const DistanceField field = readVdb(folder / "o.vdb");
  const Origins origins = readOriginsVdb(folder / "origins.vdb");
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const Vec3i p = origins.ijk(s);
    ASSERT_LT(origins.values()[s].i, 20);
    if (p.x < 20) {
      ASSERT_EQ(field.values[p], example.values[p]);
    }
  }
  const auto missing = runExemplar("synth e.vdb --keep nothing.vdb -o p.vdb", folder.path());
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, testing::HasSubstr("nothing.vdb"));
}

TEST(SynthCommand, AMixHasTheSharesThatAreAskedForOrSaysSo) {
  const TestFolder folder;
  const auto result = runExemplar("synth " + scene("balls") + kQuick + "--with " + scene("fibers") +
                                      " --mix 0.3 --scale 1.5,1,1 -o o.vdb --stats s.json",
                                  folder.path());
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, testing::HasSubstr("of the surface"));
  const auto stats = nlohmann::json::parse(readFile(folder / "s.json"));
  const double second = stats.at("surface_share_2");
  EXPECT_NEAR(stats.at("surface_share_1").get<double>() + second, 1, 1e-6);
  const bool said = result.err.find("do not have the shares") != std::string::npos;
  EXPECT_EQ(said, std::abs(second - 0.3) > 0.1);
  // Painted: the left half of the box is the first example's, the right half the second's.
  writePng(folder / "map.png", Image8{2, 1, 1, {0, 255}});
  const auto painted =
      runExemplar("synth " + scene("balls") + kQuick + "--with " + scene("fibers") +
                      " --mix-map map.png --scale 1.5,1,1 -o p.vdb --origins from.vdb",
                  folder.path());
  ASSERT_EQ(painted.status, 0) << painted.err;
  const Origins origins = readOriginsVdb(folder / "from.vdb");
  const int n = origins.size().x;
  std::int64_t right[2] = {}, all[2] = {};
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const int side = origins.ijk(s).x >= n / 2;
    ++all[side];
    right[side] += origins.values()[s].example == side;
  }
  EXPECT_GT(static_cast<double>(right[0]) / static_cast<double>(all[0]), 0.8);
  EXPECT_GT(static_cast<double>(right[1]) / static_cast<double>(all[1]), 0.8);
}

TEST(SynthCommand, SeveralExamplesAndTurnsComeOutInOneResult) {
  const TestFolder folder;
  const auto result = runExemplar("synth " + scene("balls") + kQuick + "--scale 1 --with " +
                                      scene("grid") + " --rotations -o o.glb --origins o.vdb",
                                  folder.path());
  ASSERT_EQ(result.status, 0) << result.err;
  const Origins origins = readOriginsVdb(folder / "o.vdb");
  std::int64_t second = 0, turned = 0;
  for (const Origin& origin : origins.values()) {
    second += origin.example == 1;
    turned += origin.turns != 0;
  }
  EXPECT_GT(second, 100);
  EXPECT_GT(turned, 100);
  EXPECT_TRUE(meshHealth(readMesh(folder / "o.glb")).closed());
}

TEST(MeshCommand, TakesMaterialsAndDetailThroughOrigins) {
  const TestFolder folder;
  const std::string balls = scene("balls") + kQuick;
  ASSERT_EQ(
      runExemplar("synth " + balls + "--scale 1 -o o.vdb --origins origins.vdb", folder.path())
          .status,
      0);
  const std::string dress = "mesh o.vdb --resolution 32 --origins origins.vdb --example ";
  ASSERT_EQ(runExemplar("mesh o.vdb -o bare.glb", folder.path()).status, 0);
  ASSERT_EQ(runExemplar(dress + scene("balls") + " -o one.glb", folder.path()).status, 0);
  ASSERT_EQ(runExemplar(dress + scene("balls") + " --detail 2 -o two.glb", folder.path()).status,
            0);
  const TriangleMesh bare = readMesh(folder / "bare.glb"), one = readMesh(folder / "one.glb"),
                     two = readMesh(folder / "two.glb");
  EXPECT_FALSE(bare.materials.size() > 1);
  EXPECT_GT(one.materials.size(), 1u);
  EXPECT_GT(two.triangles.size(), 2 * one.triangles.size());
  const double volume = meshHealth(one).signedVolume;
  EXPECT_NEAR(meshHealth(two).signedVolume, volume, 0.1 * volume);
  EXPECT_TRUE(meshHealth(two).closed());
  // Another example, or the same sampled otherwise, is refused.
  for (const auto& [command, says] : std::vector<std::pair<std::string, std::string>>{
           {dress + scene("chainmail"), "sampled with voxels of"},
           {"mesh o.vdb --origins origins.vdb --example " + scene("balls"),
            "give the --resolution and --padding of the synthesis"},
           {"mesh o.vdb --origins origins.vdb", "--origins and --example go together"},
           {"mesh o.vdb --detail 2", "--detail needs --origins and --example"}}) {
    const auto run = runExemplar(command + " -o no.glb", folder.path());
    EXPECT_EQ(run.status, 2) << command;
    EXPECT_THAT(run.err, testing::HasSubstr(says)) << command;
  }
}

TEST(SynthCommand, AModelInMapCoordinatesComesBackWhereItWas) {
  const TestFolder folder;
  // A wall of 4 by 0.5 by 2, turned by 20 degrees; its near corner at UTM coordinates.
  const Vec3d corner{500000.25, 4649776.5, 1200};
  const double c = std::cos(0.349), s = std::sin(0.349);
  TriangleMesh wall;
  for (int v = 0; v < 8; ++v) {
    const double x = v & 1 ? 4 : 0, y = v & 2 ? 0.5 : 0;
    wall.positions.push_back(corner + Vec3d{c * x - s * y, s * x + c * y, v & 4 ? 2.0 : 0.0});
  }
  wall.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  writeMesh(folder / "wall.ply", wall);
  const double voxel = 4.0 / 24;
  for (const std::string ending : {"glb", "ply", "obj", "off", "stl", "vdb"}) {
    const std::string name = "o." + ending;
    const auto result =
        runExemplar("synth wall.ply --resolution 24 --scale 3,1,1 -o " + name, folder.path());
    ASSERT_EQ(result.status, 0) << result.err;
    if (ending == "vdb") {
      ASSERT_EQ(runExemplar("mesh o.vdb -o again.ply", folder.path()).status, 0);
    }
    const TriangleMesh mesh = readMesh(folder / (ending == "vdb" ? "again.ply" : name));
    // .stl has floats of half a unit there, and a warning says so.
    const bool exact = ending != "stl";
    EXPECT_EQ(result.err.find("write .obj, .ply or .glb") == std::string::npos, exact) << name;
    const double near = exact ? 2 * voxel : 1;
    // Along the wall and across it.
    Vec3d low{1e9, 1e9, 1e9}, high = -low;
    for (const Vec3d& p : mesh.positions) {
      const Vec3d d = p - corner, q{c * d.x + s * d.y, c * d.y - s * d.x, d.z};
      low = min(low, q);
      high = max(high, q);
    }
    EXPECT_LT(length(low), near) << name;
    EXPECT_LT(length(high - Vec3d{12, 0.5, 2}), near) << name;
  }
}

}  // namespace
}  // namespace exemplar
