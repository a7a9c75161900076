// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/texture_charts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/file.h"
#include "mesh/color.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

/// A strip of 4 squares along x; texture coordinates jump between the second and the third.
TriangleMesh strip() {
  TriangleMesh mesh;
  for (int i = 0; i <= 4; ++i) {
    mesh.positions.push_back({double(i), 0, 0});
    mesh.positions.push_back({double(i), 1, 0});
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t a = 2 * i;
    for (const auto& t : {std::array<std::uint32_t, 3>{a, a + 2, a + 3}, {a, a + 3, a + 1}}) {
      mesh.triangles.push_back(t);
      std::array<Vec2f, 3> uvs;
      for (int c = 0; c < 3; ++c) {
        const Vec3d& p = mesh.positions[t[c]];
        uvs[c] = {static_cast<float>(p.x / 10 + (i < 2 ? 0 : 0.5)), static_cast<float>(p.y)};
      }
      mesh.uvs.push_back(uvs);
    }
  }
  return mesh;
}

TEST(TextureCharts, EndWhereCoordinatesJump) {
  EXPECT_EQ(textureCharts(strip()), (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(TextureCharts, EndWhereTheMaterialChanges) {
  TriangleMesh mesh = strip();
  mesh.materials.resize(2);
  mesh.triangleMaterials = {0, 0, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(textureCharts(mesh), (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 2, 2}));
}

TEST(TextureCharts, DoNotDependOnWhetherVerticesAreShared) {
  const TriangleMesh mesh = strip();
  TriangleMesh soup = mesh;
  soup.positions.clear();
  for (auto& t : soup.triangles) {
    for (std::uint32_t& v : t) {
      soup.positions.push_back(mesh.positions[v]);
      v = static_cast<std::uint32_t>(soup.positions.size() - 1);
    }
  }
  EXPECT_EQ(textureCharts(soup), textureCharts(mesh));
}

/// A picture of 2 x 2 texels as PNG bytes.
std::string checkerPng() {
  Image8 image{2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
  const auto path = std::filesystem::temp_directory_path() / "exemplar_texture_charts_test.png";
  writePng(path, image);
  const std::string bytes = readFile(path);
  std::filesystem::remove(path);
  return bytes;
}

TEST(SurfaceColor, MultipliesMaterialTextureAndVertexColor) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  // Texel centers: red above left, green above right, blue below left; rows come from the top.
  mesh.uvs = {{Vec2f{0.25f, 0.75f}, {0.75f, 0.75f}, {0.25f, 0.25f}}};
  mesh.textures = {{"checker.png", "image/png", checkerPng()}};
  mesh.materials.resize(1);
  mesh.materials[0].baseColor = {0.5f, 1, 1, 0.5f};
  mesh.materials[0].baseColorTexture = 0;
  mesh.triangleMaterials = {0};
  EXPECT_EQ(SurfaceColor(mesh).at(0, {1, 0, 0}), (std::array<float, 4>{0.5f, 0, 0, 0.5f}));
  EXPECT_EQ(SurfaceColor(mesh).at(0, {0, 1, 0}), (std::array<float, 4>{0, 1, 0, 0.5f}));
  EXPECT_EQ(SurfaceColor(mesh).at(0, {0, 0, 1}), (std::array<float, 4>{0, 0, 1, 0.5f}));
  // Halfway between red and green.
  const auto between = SurfaceColor(mesh).at(0, {0.5, 0.5, 0});
  EXPECT_NEAR(between[0], 0.25, 1e-6);
  EXPECT_NEAR(between[1], 0.5, 1e-6);
  mesh.colors = {{1, 1, 1, 1}, {1, 0.5f, 1, 1}, {1, 1, 1, 1}};
  EXPECT_EQ(SurfaceColor(mesh).at(0, {0, 1, 0}), (std::array<float, 4>{0, 0.5f, 0, 0.5f}));
}

TEST(VertexColor, IsWhiteWhereThereIsNoneAndLinearWhereThereIs) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(vertexColor(mesh, 3, {0.2, 0.3, 0.5}), (std::array<float, 4>{1, 1, 1, 1}));
  for (const Vec3d& p : mesh.positions) {
    mesh.colors.push_back({static_cast<float>(p.x), static_cast<float>(p.y), 0, 1});
  }
  const auto& [a, b, c] = mesh.triangles[3];
  const Vec3d at = mesh.positions[a] * 0.2 + mesh.positions[b] * 0.3 + mesh.positions[c] * 0.5;
  EXPECT_NEAR(vertexColor(mesh, 3, {0.2, 0.3, 0.5})[0], at.x, 1e-6);
}

}  // namespace
}  // namespace exemplar
