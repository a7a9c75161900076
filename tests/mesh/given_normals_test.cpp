// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/given_normals.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "tests/temporary_files.h"

namespace exemplar {
namespace {

TEST(WriteMeshWithNormals, WritesThemInPlaceOfThoseFound) {
  const test::TemporaryFolder folder;
  const auto path = [&](const char* name) { return folder / name; };
  TriangleMesh square;
  square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<Vec3f> upright(4, Vec3f{0, 0, 1}), slanted(4, Vec3f{0.6f, 0, 0.8f});
  writeMesh(path("found.glb"), square);
  writeMeshWithNormals(path("upright.glb"), square, upright);
  writeMeshWithNormals(path("slanted.glb"), square, slanted);
  // Of a plane those are found that are given.
  EXPECT_TRUE(readFile(path("found.glb")) == readFile(path("upright.glb")));
  EXPECT_FALSE(readFile(path("found.glb")) == readFile(path("slanted.glb")));
  EXPECT_EQ(readMesh(path("slanted.glb")).triangles.size(), 2u);

  EXPECT_THROW(writeMeshWithNormals(path("few.glb"), square, {upright.data(), 3}), InputError);
  EXPECT_THROW(writeMeshWithNormals(path("a.obj"), square, upright), InputError);
  EXPECT_FALSE(std::filesystem::exists(path("few.glb")));
  EXPECT_FALSE(std::filesystem::exists(path("a.obj")));
}

}  // namespace
}  // namespace exemplar
