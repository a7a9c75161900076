// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mesh/mesh_formats.h"
#include "mesh/split_vertices.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

/// A hilly sheet of 4 x 4 cells with normals of its own; the texture is mirrored in its middle.
struct Sheet {
  struct Row {
    int i, j, side;
    Vec3d tangent;
  };
  TriangleMesh mesh;
  ShadingNormals normals;

  Sheet() {
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 5; ++i) {
        mesh.positions.push_back({double(i), double(j), (i * 7 + j * 11) % 5 * 0.25});
        normals.normals.push_back(cast<float>(
            normalized(Vec3d{((i * 3 + j) % 4 - 1.5) * 0.25, ((i + j * 5) % 3 - 1) * 0.25, 1})));
      }
    }
    const auto at = [](int i, int j) { return static_cast<std::uint32_t>(5 * j + i); };
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
    normals.corners = mesh.triangles;
    for (const auto& triangle : mesh.triangles) {
      auto& corners = mesh.uvs.emplace_back();
      for (int c = 0; c < 3; ++c) {
        const int i = static_cast<int>(triangle[c] % 5), j = static_cast<int>(triangle[c] / 5);
        corners[c] = {std::abs(i - 2) * 0.25f, j * 0.25f + 0.0625f * (i % 2)};
      }
    }
    mesh.materials = {{.name = "mapped"}};
    mesh.triangleMaterials.assign(mesh.triangles.size(), 0);
  }
  CornerTangents tangents(const UvTransform& lookup = {}) const {
    return cornerTangents(mesh, normals, {lookup});
  }
};

/// What Mikkelsen's reference code (mikktspace 1.1.1, npm) gives for that sheet.
const Sheet::Row kReference[] = {
    {0, 0, -1, {-0.93267, 0.20111, -0.29947}},  {1, 0, -1, {-0.93619, 0.01722, 0.35107}},
    {2, 0, -1, {-0.97524, -0.15261, 0.16006}},  {2, 0, 1, {0.96361, -0.26158, -0.05506}},
    {3, 0, 1, {0.99191, -0.06855, 0.10685}},    {4, 0, 1, {0.91437, 0.21532, 0.34289}},
    {0, 1, -1, {-0.94093, 0.28162, -0.18802}},  {1, 1, -1, {-0.93972, 0.08948, -0.33003}},
    {2, 1, -1, {-0.91306, -0.22156, 0.34240}},  {2, 1, 1, {0.88457, -0.32787, -0.33171}},
    {3, 1, 1, {0.99165, -0.07430, -0.10538}},   {4, 1, 1, {0.94299, 0.27550, 0.18675}},
    {0, 2, -1, {-0.96057, 0.25079, 0.12007}},   {1, 2, -1, {-0.99251, -0.04929, -0.11174}},
    {2, 2, -1, {-0.93414, -0.02335, -0.35614}}, {2, 2, 1, {0.93267, -0.20111, 0.29947}},
    {3, 2, 1, {0.93516, -0.04998, -0.35068}},   {4, 2, 1, {0.94034, 0.28332, -0.18837}},
    {0, 3, -1, {-0.88138, 0.25878, 0.39521}},   {1, 3, -1, {-0.99198, -0.02437, 0.12400}},
    {2, 3, -1, {-0.97503, -0.21103, -0.06912}}, {2, 3, 1, {0.95311, -0.24332, 0.17997}},
    {3, 3, 1, {0.93800, -0.02366, 0.34583}},    {4, 3, 1, {0.91592, 0.20765, -0.34347}},
    {0, 4, -1, {-0.93745, -0.01496, -0.34780}}, {1, 4, -1, {-0.93852, -0.13225, 0.31888}},
    {2, 4, -1, {-0.95773, -0.26157, 0.11972}},  {2, 4, 1, {0.96730, -0.22296, -0.12091}},
    {3, 4, 1, {0.99226, -0.00072, 0.12421}},    {4, 4, 1, {0.91957, 0.11878, 0.37454}},
};

Vec3d direction(const Tangent& t) { return {t[0], t[1], t[2]}; }

TEST(CornerTangents, AreThoseOfTheReferenceCode) {
  const Sheet sheet;
  const CornerTangents found = sheet.tangents();
  std::size_t compared = 0;
  for (std::size_t t = 0; t < sheet.mesh.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = sheet.mesh.triangles[t][c];
      const Tangent& tangent = found.tangents[found.corners[t][c]];
      for (const auto& [i, j, side, wanted] : kReference) {
        if (v != static_cast<std::uint32_t>(5 * j + i) || side != tangent[3]) continue;
        EXPECT_LT(length(direction(tangent) - wanted), 2e-5) << i << " " << j << " " << side;
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 3 * sheet.mesh.triangles.size());
  EXPECT_EQ(found.tangents.size(), std::size(kReference));
}

TEST(CornerTangents, AreUnitAndAtRightAnglesToNormals) {
  TriangleMesh torus = plainTorus(24, 12);
  torus.materials = {{}};
  torus.triangleMaterials.assign(torus.triangles.size(), 0);
  // u once around the axis, v once around the tube, without a joint inside a triangle.
  for (std::size_t t = 0; t < torus.triangles.size(); ++t) {
    auto& corners = torus.uvs.emplace_back();
    const int cell = static_cast<int>(t / 2), i = cell / 12, j = cell % 12;
    const Vec2f a{i / 24.0f, j / 12.0f}, b{(i + 1) / 24.0f, j / 12.0f},
        c{(i + 1) / 24.0f, (j + 1) / 12.0f}, d{i / 24.0f, (j + 1) / 12.0f};
    corners = t % 2 == 0 ? std::array{a, b, c} : std::array{a, c, d};
  }
  const ShadingNormals normals = shadingNormals(torus, MeshNormals::Smooth);
  const CornerTangents found = cornerTangents(torus, normals, {UvTransform{}});
  const CornerTangents turned =
      cornerTangents(torus, normals, {UvTransform{.rotation = std::numbers::pi / 2}});
  for (std::size_t t = 0; t < torus.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const Vec3d normal = cast<double>(normals.normals[normals.corners[t][c]]);
      const Tangent& tangent = found.tangents[found.corners[t][c]];
      EXPECT_NEAR(length(direction(tangent)), 1, 1e-6);
      EXPECT_NEAR(dot(direction(tangent), normal), 0, 1e-6);
      EXPECT_EQ(tangent[3], 1) << "the texture lies face up";
      const Vec3d p = torus.positions[torus.triangles[t][c]];
      const Vec3d around = normalized(Vec3d{-p.y, p.x, 0});
      // Facets turn by 15 degrees from one to the next, and lean by 30.
      EXPECT_GT(dot(direction(tangent), around), std::cos(0.15)) << t;
      // Turned by a quarter, u grows where v, or -v, did.
      const Vec3d across = direction(turned.tangents[turned.corners[t][c]]);
      EXPECT_GT(std::abs(dot(across, cross(normal, around))), std::cos(0.15)) << t;
    }
  }
}

TEST(CornerTangents, TrianglesWithoutAreaInTheTextureJoinTheirNeighbors) {
  Sheet sheet;
  const CornerTangents before = sheet.tangents();
  // All of one triangle is at one point of the texture: it shares no edge, and stands alone.
  sheet.mesh.uvs[0] = {Vec2f{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}};
  // Another one is a line in it, along an edge that it shares.
  sheet.mesh.uvs[30][2] = sheet.mesh.uvs[30][1];
  // And one has no area at all.
  sheet.mesh.triangles.push_back({12, 12, 13});
  sheet.mesh.uvs.push_back({sheet.mesh.uvs[12][0], sheet.mesh.uvs[12][0], sheet.mesh.uvs[12][1]});
  sheet.mesh.triangleMaterials.push_back(0);
  sheet.normals.corners = sheet.mesh.triangles;
  const CornerTangents found = sheet.tangents();
  for (const auto& corners : found.corners) {
    for (const std::uint32_t n : corners) {
      ASSERT_LT(n, found.tangents.size());
      EXPECT_NEAR(length(direction(found.tangents[n])), 1, 1e-6);
      EXPECT_EQ(std::abs(found.tangents[n][3]), 1);
    }
  }
  for (int c = 0; c < 3; ++c) {
    const Vec3d normal = cast<double>(sheet.normals.normals[sheet.mesh.triangles[0][c]]);
    EXPECT_NEAR(dot(direction(found.tangents[found.corners[0][c]]), normal), 0, 1e-6);
  }
  EXPECT_EQ(found.tangents[found.corners[30][0]][3], 1) << "its neighbors' side";
}

TEST(CornerTangents, SplitVerticesOnlyWhereTheyDiffer) {
  const Sheet sheet;
  const auto split = [&](const CornerTangents& tangents) {
    return splitVertices(sheet.mesh, sheet.normals, tangents);
  };
  EXPECT_EQ(split({}).source.size(), 25u);
  const SplitVertices with = split(sheet.tangents());
  EXPECT_EQ(with.source.size(), 30u) << "five vertices are on both sides of the mirror";
  ASSERT_EQ(with.tangents.size(), with.source.size());
  const CornerTangents tangents = sheet.tangents();
  for (std::size_t t = 0; t < with.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(with.tangents[with.triangles[t][c]], tangents.tangents[tangents.corners[t][c]]);
  // Corners without a tangent share vertices with those that have one.
  CornerTangents half = tangents;
  for (std::size_t t = 0; t < half.corners.size(); ++t)
    if (sheet.mesh.triangles[t][0] % 5 >= 2) half.corners[t] = {kNone, kNone, kNone};
  EXPECT_EQ(split(half).source.size(), 25u);
}

TEST(CornerTangents, AreInFilesWhereAMaterialHasANormalMap) {
  TriangleMesh mesh = fullMesh();
  const auto attributesOf = [&](MeshNormals normals) {
    const auto root = nlohmann::json::parse(formatGltf(mesh, false, normals));
    std::vector<bool> has;
    for (const auto& primitive : root["meshes"][0]["primitives"])
      has.push_back(primitive["attributes"].contains("TANGENT"));
    return has;
  };
  EXPECT_EQ(attributesOf(MeshNormals::Crease), (std::vector<bool>{false, false}));
  mesh.materials[1].source = std::make_shared<MaterialSource>(
      MaterialSource{MaterialSource::Format::Gltf,
                     R"({"material":{"normalTexture":{"index":0}},"textures":[{"source":0}]})"});
  mesh.materials[1].pictures = {0};
  EXPECT_EQ(attributesOf(MeshNormals::Crease), (std::vector<bool>{false, true}));
  EXPECT_EQ(attributesOf(MeshNormals::None), (std::vector<bool>{false, false}))
      << "tangents are nothing without normals";
  // They are the same vectors in a file with y up.
  EXPECT_EQ(parse(".glb", formatGlb(mesh, true)).triangles.size(), mesh.triangles.size());
}

}  // namespace
}  // namespace exemplar
