// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/label_mesh.h"

#include <gtest/gtest.h>

#include <map>

#include "mesh/mesh_health.h"
#include "tests/voxelize/label_samples.h"

namespace exemplar {
namespace {

/// The triangles of one material alone.
TriangleMesh partOf(const TriangleMesh& mesh, std::uint32_t material) {
  TriangleMesh part = mesh;
  part.triangles.clear();
  part.triangleMaterials.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangleMaterials[t] != material) continue;
    part.triangles.push_back(mesh.triangles[t]);
    part.triangleMaterials.push_back(material);
  }
  return part;
}

/// Edges that are not run through as often one way as the other.
int unpairedEdges(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  int unpaired = 0;
  for (const auto& [edge, sum] : balance) unpaired += sum != 0;
  return unpaired;
}

LabelGrid gridOf(const Vec3i& size, std::initializer_list<Vec3i> filled) {
  LabelGrid grid = randomGrid(size, 2, 0);
  for (Label& label : grid.cells.values()) label = 0;
  for (const Vec3i& cell : filled) grid.cells[cell] = 1;
  return grid;
}

TEST(LabelMesh, ABlockOfOneLabelIsABoxOfTwelveTriangles) {
  LabelGrid grid = gridOf({3, 4, 5}, {});
  for (Label& label : grid.cells.values()) label = 1;
  grid.cellSize = {2, 1, 0.5};
  grid.origin = {10, 20, 30};
  const TriangleMesh mesh = labelMesh(grid);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.positions.size(), 8u);
  const Box3d box = boundingBox(mesh);
  EXPECT_EQ(box.min, (Vec3d{10, 20, 30}));
  EXPECT_EQ(box.max, (Vec3d{16, 24, 32.5}));
  const MeshHealth health = meshHealth(mesh);
  EXPECT_TRUE(health.closed() && health.manifold() && health.oriented());
  EXPECT_DOUBLE_EQ(health.signedVolume, 6 * 4 * 2.5);
}

TEST(LabelMesh, EachLabelsSurfaceIsClosedWithItsCellsVolume) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LabelGrid grid = randomGrid({6, 5, 7}, 2 + static_cast<int>(seed % 4), seed);
    const TriangleMesh mesh = labelMesh(grid);
    validate(mesh, "mesh");
    std::map<std::string, double> cells;
    for (const Label label : grid.cells.values()) cells[grid.labels[label].name] += 1;
    EXPECT_EQ(unpairedEdges(mesh), 0);
    for (std::uint32_t m = 0; m < mesh.materials.size(); ++m) {
      const TriangleMesh part = partOf(mesh, m);
      EXPECT_EQ(unpairedEdges(part), 0) << seed << " material " << m;
      const MeshHealth health = meshHealth(part);
      EXPECT_EQ(health.boundaryEdges, 0);
      EXPECT_EQ(health.degenerateTriangles, 0);
      // Corners are whole numbers and middles halves: the sum is nearly exact.
      EXPECT_NEAR(health.signedVolume, cells[mesh.materials[m].name], 1e-9);
    }
  }
}

TEST(LabelMesh, TheCheckOfEdgesFindsACrack) {
  TriangleMesh mesh = labelMesh(randomGrid({4, 4, 4}, 2, 1));
  mesh.triangles.pop_back();
  EXPECT_GT(unpairedEdges(mesh), 0);
}

TEST(LabelMesh, CellsThatTouchAlongAnEdgeOrAtACornerAreApart) {
  for (const auto& grid :
       {gridOf({2, 2, 1}, {{0, 0, 0}, {1, 1, 0}}), gridOf({2, 2, 2}, {{0, 0, 0}, {1, 1, 1}})}) {
    const MeshHealth health = meshHealth(labelMesh(grid));
    EXPECT_TRUE(health.closed() && health.manifold() && health.oriented());
    EXPECT_EQ(health.components, 2);
    EXPECT_EQ(health.triangles, 24);
  }
}

TEST(LabelMesh, WithoutInnerFacesOnlyTheOutsideIsLeft) {
  LabelGrid grid = randomGrid({5, 5, 5}, 4, 1);
  for (Label& label : grid.cells.values()) label = std::max<Label>(label, 1);
  const TriangleMesh mesh = labelMesh(grid, {.closedLabels = false});
  // Every face lies on the block's outside: its volume is the block's, and its area is, too.
  EXPECT_NEAR(meshHealth(mesh).signedVolume, 125, 1e-9);
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += length(areaNormal(mesh, t)) / 2;
  EXPECT_NEAR(area, 150, 1e-9);
}

TEST(LabelMesh, MaterialsHaveTheLabelsNamesAndColors) {
  const LabelGrid grid = randomGrid({4, 4, 4}, 3, 1);
  const TriangleMesh mesh = labelMesh(grid);
  ASSERT_EQ(mesh.materials.size(), 2u);
  for (const Material& material : mesh.materials) {
    const int label = material.name == "piece 1" ? 1 : 2;
    EXPECT_EQ(material.name, grid.labels[label].name);
    EXPECT_EQ(material.baseColor, grid.labels[label].color);
  }
}

TEST(LabelMesh, AnEmptyGridHasNoTriangles) {
  EXPECT_TRUE(labelMesh(gridOf({2, 2, 2}, {})).triangles.empty());
}

}  // namespace
}  // namespace exemplar
