// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/mesh_to_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <filesystem>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/file.h"
#include "mesh/image.h"
#include "mesh/primitives.h"
#include "tests/voxelize/error_of.h"
#include "tests/voxelize/hears_cancellation.h"
#include "voxelize/cell_cut.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

TriangleMesh painted(TriangleMesh mesh, const std::string& name, float red) {
  setMaterial(mesh, {.name = name, .baseColor = {red, 0, 0, 1}});
  return mesh;
}

int filled(const LabelGrid& grid) {
  int count = 0;
  for (const Label label : grid.cells.values()) count += label != 0;
  return count;
}

// Cutting

TEST(CellCut, PartsStayInTheirCellsAndKeepTheArea) {
  const TriangleMesh mesh = makeSphere({2.3, 2.6, 2.1}, 1.9, 6);
  const CellCut cut = cutAlongCells(mesh, {0, 0, 0}, {1, 0.5, 0.7}, {5, 10, 6});
  std::vector<Vec3d> area(mesh.triangles.size());
  for (int c = 0; c < 300; ++c) {
    const Vec3d low{static_cast<double>(c % 5), static_cast<double>(c / 5 % 10), c / 50 * 1.0};
    for (std::uint32_t n = cut.first[c]; n < cut.first[c + 1]; ++n) {
      const CutPolygon& part = cut.polygons[n];
      for (std::uint32_t i = 0; i < part.count; ++i) {
        const CutPoint& point = cut.points[part.first + i];
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(point.p[axis], low[axis]);
          EXPECT_LE(point.p[axis], low[axis] + 1);
        }
        // The weights give the point again.
        Vec3d p{};
        for (int k = 0; k < 3; ++k) {
          p += mesh.positions[mesh.triangles[part.triangle][k]] * point.weights[k];
        }
        EXPECT_NEAR(p.x, point.p.x, 1e-5);
        EXPECT_NEAR(p.y, point.p.y * 0.5, 1e-5);
      }
      // An area vector in cells back in world units.
      area[part.triangle] += scaled(areaNormal(cut, part), {0.5 * 0.7, 1 * 0.7, 1 * 0.5});
    }
  }
  for (std::size_t t = 0; t < area.size(); ++t) {
    EXPECT_LT(length(area[t] - areaNormal(mesh, t)), 1e-5) << t;
  }
}

TEST(CellCut, AFaceBetweenTwoCellsBelongsToTheOneBehind) {
  const CellCut cut =
      cutAlongCells(makeBox({{1, 1, 1}, {2, 2, 2}}), {0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  EXPECT_EQ(cut.polygons.size(), 12u);
  EXPECT_EQ(cut.first[14] - cut.first[13], 12u);  // all in the middle cell
}

TEST(CellCut, WhatLiesOutsideIsLeftOut) {
  const CellCut cut =
      cutAlongCells(makeBox({{-5, -5, -5}, {1.5, 9, 9}}), {0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  double area = 0;
  for (const CutPolygon& part : cut.polygons) area += length(areaNormal(cut, part)) / 2;
  EXPECT_NEAR(area, 4, 1e-12);
}

// Labels

TEST(MeshToLabels, ABoxAlongTheCellsFillsJustItsCells) {
  for (const VoxelFill fill : {VoxelFill::Solid, VoxelFill::Both}) {
    const LabelGrid grid = meshToLabels(makeBox({{0, 0, 0}, {4, 3, 2}}),
                                        {.cellSize = {1, 1, 1}, .air = 1, .fill = fill});
    EXPECT_EQ(grid.size(), (Vec3i{6, 5, 3}));
    EXPECT_EQ(grid.origin, (Vec3d{-1, -1, 0}));
    EXPECT_EQ(filled(grid), 24);
    for (int k = 0; k < 2; ++k) EXPECT_EQ(grid.cells(1, 1, k), 1);
    EXPECT_EQ(grid.labelCount(), 2);
  }
  const LabelGrid surface = meshToLabels(makeBox({{0, 0, 0}, {4, 3, 3}}),
                                         {.cellSize = {1, 1, 1}, .fill = VoxelFill::Surface});
  EXPECT_EQ(filled(surface), 36 - 2);
}

TEST(MeshToLabels, ASphereHasItsVolume) {
  const LabelGrid grid =
      meshToLabels(makeSphere({0, 0, 0}, 1, 16), {.resolution = 40, .fill = VoxelFill::Solid});
  const double cell = grid.cellSize.x;
  // Cells along the surface are in or out by their centers: the error is far below a layer.
  EXPECT_NEAR(filled(grid) * cell * cell * cell, 4 * std::numbers::pi / 3, 0.03);
}

TEST(MeshToLabels, EachMaterialIsALabel) {
  TriangleMesh mesh = painted(makeBox({{0, 0, 0}, {2, 4, 4}}), "stone", 0.25f);
  append(mesh, painted(makeBox({{2, 0, 0}, {4, 4, 4}}), "wood", 0.75f));
  const LabelGrid grid = meshToLabels(mesh, {.cellSize = {1, 1, 1}});
  ASSERT_EQ(grid.labelCount(), 3);
  EXPECT_EQ(grid.labels[1].name, "stone");
  EXPECT_EQ(grid.labels[2].name, "wood");
  EXPECT_EQ(grid.labels[2].color[0], 0.75f);
  for (std::size_t n = 0; n < grid.cells.count(); ++n) {
    EXPECT_EQ(grid.cells.values()[n], grid.cells.ijk(n).x < 2 ? 1 : 2);
  }
}

TEST(MeshToLabels, ATexturedMaterialsLabelHasItsMeanColor) {
  const auto path = std::filesystem::temp_directory_path() / "exemplar_mean_color_test.png";
  writePng(path, Image8{2, 1, 3, {255, 0, 0, 0, 0, 0}});
  TriangleMesh mesh = painted(makeBox({{0, 0, 0}, {1, 1, 1}}), "wall", 1.0f);
  mesh.materials[0].baseColor = {1, 1, 1, 1};
  mesh.materials[0].baseColorTexture = 0;
  mesh.textures.push_back({"t.png", "image/png", readFile(path)});
  std::filesystem::remove(path);
  const auto mean = meshToLabels(mesh, {.cellSize = {1, 1, 1}}).labels[1].color;
  EXPECT_NEAR(mean[0], 0.5, 1e-6);
  EXPECT_NEAR(mean[1], 0, 1e-6);
  mesh.textures[0].bytes = "no picture";
  EXPECT_EQ(meshToLabels(mesh, {.cellSize = {1, 1, 1}}).labels[1].color[1], 1);
}

TEST(MeshToLabels, AnOpenMeshIsSolidAllTheSame) {
  TriangleMesh mesh = makeSphere({0, 0, 0}, 1, 12);
  const std::size_t all = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const auto& t) { return mesh.positions[t[0]].z > 0.9; });
  ASSERT_LT(mesh.triangles.size(), all);
  const LabelGrid grid = meshToLabels(mesh, {.resolution = 20, .fill = VoxelFill::Solid});
  EXPECT_NE(grid.cells(grid.size().x / 2, grid.size().y / 2, grid.size().z / 2), 0);
  EXPECT_EQ(grid.cells(0, 0, 0), 0);
}

TEST(MeshToLabels, OneThreadEqualsEight) {
  const TriangleMesh mesh = makeTorus({0, 0, 0}, {0.3, 0.2, 1}, 2, 0.7);
  LabelGrid one, eight;
  tbb::task_arena(1).execute([&] { one = meshToLabels(mesh, {.resolution = 30}); });
  tbb::task_arena(8).execute([&] { eight = meshToLabels(mesh, {.resolution = 30}); });
  EXPECT_EQ(one.cells, eight.cells);
}

TEST(MeshToLabels, BadInputIsRefused) {
  const TriangleMesh box = makeBox({{0, 0, 0}, {1, 1, 1}});
  const auto error = [&](const MeshToLabelsOptions& options) {
    return test::errorOf([&] { return meshToLabels(box, options); });
  };
  EXPECT_THAT(test::errorOf([] { return meshToLabels(TriangleMesh{}); }), HasSubstr("the mesh"));
  EXPECT_THAT(error({.cellSize = {1, 0, 1}}), HasSubstr("`cell` 0.000000: must be a positive"));
  EXPECT_THAT(error({.cellSize = {1e-6, 1e-6, 1e-6}}), HasSubstr("longer than 32,767 cells"));
  EXPECT_THAT(error({.resolution = 0}), HasSubstr("`resolution` 0: must be 1 to 4096"));
  EXPECT_THAT(error({.air = -1}), HasSubstr("`air` -1: must be 0 to 1024"));
}

TEST(MeshToLabels, HearsCancellation) {
  const TriangleMesh box = makeBox({{0, 0, 0}, {1, 1, 1}});
  test::expectHearsCancellation(
      [&](const Progress& p) { (void)meshToLabels(box, {.resolution = 10}, p); });
}

}  // namespace
}  // namespace exemplar
