// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

TriangleMesh oneTriangle() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

std::string complaint(const TriangleMesh& mesh) {
  try {
    validate(mesh, "it");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Validate, PassesASoundMesh) { EXPECT_EQ(complaint(oneTriangle()), ""); }

TEST(Validate, RefusesEachDefectByName) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto broken = [](auto change) {
    TriangleMesh mesh = oneTriangle();
    change(mesh);
    return complaint(mesh);
  };
  EXPECT_EQ(complaint({}), "it: the mesh has no triangles");
  EXPECT_THAT(broken([](auto& m) { m.positions[1].y = std::nan(""); }), HasSubstr("vertex 1"));
  EXPECT_THAT(broken([&](auto& m) { m.positions[2].x = -infinity; }), HasSubstr("vertex 2"));
  EXPECT_THAT(broken([](auto& m) { m.positions[2].x = -1e15; }), HasSubstr("1e15"));
  EXPECT_THAT(broken([](auto& m) { m.triangles[0][2] = 3; }), HasSubstr("names vertex 3 of 3"));
  EXPECT_THAT(broken([](auto& m) { m.colors.resize(2); }), HasSubstr("2 colors for 3 vertices"));
  EXPECT_THAT(broken([&](auto& m) {
                m.colors.resize(3);
                m.colors[2][3] = static_cast<float>(infinity);
              }),
              HasSubstr("color"));
  EXPECT_THAT(broken([](auto& m) { m.uvs.resize(2); }), HasSubstr("for 1 triangles"));
  EXPECT_THAT(broken([](auto& m) { m.uvs = {{{{0, 0}, {0, NAN}, {0, 0}}}}; }), HasSubstr("NaN"));
  EXPECT_THAT(broken([](auto& m) { m.triangleMaterials = {0}; }),
              HasSubstr("names material 0 of 0"));
  EXPECT_THAT(broken([](auto& m) {
                m.materials.resize(1);
                m.materials[0].baseColorTexture = 0;
              }),
              HasSubstr("names texture 0 of 0"));
}

TEST(BoundingBox, LooksOnlyAtVerticesThatTrianglesUse) {
  TriangleMesh mesh = oneTriangle();
  mesh.positions.push_back({100, 100, 100});
  const Box3d box = boundingBox(mesh);
  EXPECT_EQ(box.min, (Vec3d{0, 0, 0}));
  EXPECT_EQ(box.max, (Vec3d{2, 3, 0}));
  EXPECT_TRUE(boundingBox({}).empty());
}

TEST(AreaNormal, IsTwiceTheAreaTowardsTheOutside) {
  EXPECT_EQ(areaNormal(oneTriangle(), 0), (Vec3d{0, 0, 6}));
}

TEST(Append, ShiftsIndicesAndMergesEqualMaterialsAndTextures) {
  TriangleMesh a = oneTriangle(), b = oneTriangle();
  a.textures = {{"t.png", "image/png", "one"}};
  b.textures = {{"t.png", "image/png", "two"}, {"u.png", "image/png", "one"}};
  Material plain{.name = "plain"}, first{.name = "first"}, second{.name = "second"};
  first.baseColorTexture = 0;
  second.baseColorTexture = 1;
  a.materials = {plain, first};
  a.triangleMaterials = {1};
  b.materials = {second, plain};
  b.triangleMaterials = {1};
  append(a, b);
  EXPECT_EQ(a.triangles[1], (std::array<std::uint32_t, 3>{3, 4, 5}));
  EXPECT_EQ(a.triangleMaterials, (std::vector<std::uint32_t>{1, 0}));
  ASSERT_EQ(a.materials.size(), 3u);
  EXPECT_EQ(a.materials[2].baseColorTexture, 0u) << "equal bytes are one texture";
  ASSERT_EQ(a.textures.size(), 2u);
  EXPECT_EQ(a.textures[1].name, "t_2.png") << "names stay unique";
  EXPECT_EQ(complaint(a), "");
}

TEST(Append, FillsInWhatOneSideDoesNotHave) {
  TriangleMesh full = oneTriangle();
  full.colors.assign(3, {0.5f, 0, 0, 1});
  full.uvs = {{{{1, 2}, {3, 4}, {5, 6}}}};
  full.materials = {Material{.name = "m"}};
  full.triangleMaterials = {0};
  for (const bool fullFirst : {true, false}) {
    TriangleMesh joined = fullFirst ? full : oneTriangle();
    append(joined, fullFirst ? oneTriangle() : full);
    EXPECT_EQ(complaint(joined), "");
    const std::size_t plain = fullFirst ? 1 : 0;
    EXPECT_EQ(joined.colors[3 * plain], (std::array<float, 4>{1, 1, 1, 1}));
    EXPECT_EQ(joined.colors[3 * (1 - plain)], (std::array<float, 4>{0.5f, 0, 0, 1}));
    EXPECT_EQ(joined.uvs[plain][2], (Vec2f{0, 0}));
    EXPECT_EQ(joined.uvs[1 - plain][2], (Vec2f{5, 6}));
    EXPECT_EQ(joined.materials[joined.triangleMaterials[plain]], Material{});
    EXPECT_EQ(joined.materials[joined.triangleMaterials[1 - plain]].name, "m");
  }
}

TEST(Append, ObjectsOfOneNameAreOne) {
  TriangleMesh a = oneTriangle(), b = oneTriangle(), unnamed = oneTriangle();
  a.objects = {"wall", "tower"};
  a.triangleObjects = {1};
  b.objects = {"tower", "gate"};
  b.triangleObjects = {0};
  append(a, b);
  append(a, unnamed);
  EXPECT_EQ(complaint(a), "");
  EXPECT_EQ(a.triangleObjects[0], a.triangleObjects[1]);
  EXPECT_EQ(a.objects[a.triangleObjects[1]], "tower");
  EXPECT_EQ(a.objects[a.triangleObjects[2]], "");
  a.triangleObjects[2] = 9;
  EXPECT_THAT(complaint(a), HasSubstr("names object 9 of"));
}

TEST(Append, ToAnEmptyMeshIsACopy) {
  TriangleMesh full = oneTriangle(), joined;
  full.colors.assign(3, {0.5f, 0, 0, 1});
  full.materials = {Material{.name = "m"}};
  full.triangleMaterials = {0};
  append(joined, full);
  EXPECT_EQ(joined.triangles, full.triangles);
  EXPECT_EQ(joined.colors, full.colors);
  EXPECT_EQ(joined.materials, full.materials);
}

TEST(Append, OfAMeshToItselfDoublesIt) {
  TriangleMesh mesh = oneTriangle();
  append(mesh, mesh);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(complaint(mesh), "");
}

}  // namespace
}  // namespace exemplar
