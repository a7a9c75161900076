// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/scene.h"
#include "mesh/self_intersection.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// Runs `work` and returns the fractions that it reports; cancels it at report number `cancelAt`.
std::vector<double> fractionsOf(const std::function<void(const Progress&)>& work,
                                std::size_t cancelAt = std::numeric_limits<std::size_t>::max()) {
  std::vector<double> fractions;
  std::atomic<bool> cancel = cancelAt == 0;
  work(Progress(
      [&](std::string_view, double fraction) {
        fractions.push_back(fraction);
        if (fractions.size() >= cancelAt) cancel = true;
      },
      &cancel));
  return fractions;
}

/// Work reports a fraction that never falls, often enough, and ends by `Cancelled` wherever it is
/// cancelled; `after` then checks what it left.
void expectHeard(
    const std::string& name, std::size_t leastReports,
    const std::function<void(const Progress&)>& work, const std::function<void()>& after = [] {}) {
  const std::vector<double> fractions = fractionsOf(work);
  EXPECT_GE(fractions.size(), leastReports) << name;
  double last = 0;
  for (const double f : fractions) {
    EXPECT_GE(f, last) << name;
    EXPECT_LE(f, 1) << name;
    last = f;
  }
  for (const std::size_t at : {std::size_t{0}, std::size_t{1}, fractions.size() / 2}) {
    EXPECT_THROW(fractionsOf(work, at), Cancelled) << name << ", cancelled at report " << at;
    after();
  }
}

// More than 16,384 vertices and triangles, so that loops report in their middle.
const TriangleMesh& largeTorus() {
  static const TriangleMesh mesh = plainTorus(200, 100);
  return mesh;
}

TEST(MeshProgress, WritingIsHeardAndLeavesTheOldFileWhole) {
  const TestFolder folder("cancel_write");
  for (const char* ending : {".obj", ".ply", ".stl", ".off", ".glb", ".gltf"}) {
    const fs::path path = folder / (std::string("m") + ending);
    writeFile(path, "old");
    // glTF keeps its arrays one after the other: fewer places to report at.
    const std::size_t reports = std::string_view(ending).starts_with(".gl") ? 2 : 3;
    expectHeard(
        ending, reports,
        [&](const Progress& progress) { writeMesh(path, largeTorus(), {}, progress); },
        [&] {
          // The run that was not cancelled has written the file; a cancelled one leaves it alone.
          EXPECT_EQ(readMesh(path).triangles.size(), largeTorus().triangles.size()) << ending;
          writeFile(path, "old");
          EXPECT_THROW(
              fractionsOf(
                  [&](const Progress& progress) { writeMesh(path, largeTorus(), {}, progress); },
                  1),
              Cancelled);
          EXPECT_EQ(readFile(path), "old") << ending;
          writeMesh(path, largeTorus());
        });
  }
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder / "")) ++files;
  EXPECT_EQ(files, 6u) << "no temporary file is left";
}

TEST(MeshProgress, ReadingIsHeard) {
  const TestFolder folder("cancel_read");
  for (const char* ending : {".obj", ".ply", ".stl", ".off", ".glb", ".gltf"}) {
    const fs::path path = folder / (std::string("m") + ending);
    writeMesh(path, largeTorus());
    expectHeard(ending, 3, [&](const Progress& progress) { readMesh(path, {}, progress); });
  }
}

TEST(MeshProgress, HealthAndCrossingsAreHeard) {
  expectHeard("health", 4, [](const Progress& progress) { meshHealth(largeTorus(), progress); });
  expectHeard("health with crossings", 40, [](const Progress& progress) {
    meshHealth(largeTorus(), {.selfIntersections = true}, progress);
  });
  expectHeard("crossings", 40,
              [](const Progress& progress) { countSelfIntersections(largeTorus(), progress); });
}

TEST(MeshProgress, ScenesAreHeard) {
  for (const char* kind : {"chainmail", "balls", "grid", "fibers", "metal", "terrain", "grass",
                           "bricks", "scales", "bark"}) {
    const std::string file = std::string("kind = \"") + kind + "\"\n";
    expectHeard(kind, 5, [&](const Progress& progress) {
      readScene(file, std::string(kind) + ".toml", {}, progress);
    });
  }
}

TEST(MeshBytes, AreReadAsTheFileIs) {
  const TestFolder folder("bytes");
  const TriangleMesh full = fullMesh();
  for (const char* ending : {".obj", ".ply", ".stl", ".off", ".glb", ".gltf"}) {
    const fs::path path = folder / (std::string("m") + ending);
    writeMesh(path, full);
    const std::string bytes = readFile(path);
    const TriangleMesh file = readMesh(path);
    const TriangleMesh beside =
        readMesh(bytes, "m" + std::string(ending), {.folder = path.parent_path()});
    EXPECT_EQ(beside.positions, file.positions) << ending;
    EXPECT_EQ(beside.triangles, file.triangles) << ending;
    EXPECT_EQ(beside.materials, file.materials) << ending;
    EXPECT_EQ(beside.textures.size(), file.textures.size()) << ending;
  }
  // Without a folder, what lies beside the file is not looked for, wherever the program runs.
  const std::string obj = readFile(folder / "m.obj");
  const TriangleMesh alone = readMesh(obj, (folder / "m.obj").string(), {});
  EXPECT_EQ(alone.positions.size(), full.positions.size());
  EXPECT_TRUE(alone.textures.empty());
  ASSERT_EQ(alone.materials.size(), 2u);
  EXPECT_EQ(alone.materials[0].name, "red paint");
  EXPECT_EQ(alone.materials[0].roughness, Material{}.roughness);
  EXPECT_THROW(readMesh(obj, "m.fbx", {}), InputError);
}

}  // namespace
}  // namespace exemplar
