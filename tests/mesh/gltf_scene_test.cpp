// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What a glTF scene says beyond triangles at rest: instances, skins, morphs, visibility, materials
// of other kinds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/base64.h"
#include "core/error.h"
#include "mesh/mesh_formats.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A glTF file with one triangle (0,0,0) (1,0,0) (0,1,0) in `meshes[0]`, to which parts are added.
class Scene {
 public:
  std::string nodes = R"([{"mesh":0}])";
  std::string roots = "[0]";
  std::string attributes;  ///< further ones, with a comma in front
  std::string primitive;   ///< further members, with a comma in front
  std::string mesh;        ///< further members, with a comma in front
  std::string top;         ///< further members, with a comma in front

  Scene() {
    floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    indices_ = array<std::uint16_t>("SCALAR", 5123, 1, {0, 1, 2}, false);
  }

  /// Adds an accessor, and returns its index as text.
  std::string floats(const char* type, std::initializer_list<float> values) {
    return array<float>(type, 5126, componentsOf(type), values, false);
  }
  template <class T>
  std::string array(const char* type, int componentType, std::size_t components,
                    std::initializer_list<T> values, bool normalized) {
    while (binary_.size() % 4 != 0) binary_ += '\0';
    const std::size_t begin = binary_.size();
    for (const T v : values) binary_.append(reinterpret_cast<const char*>(&v), sizeof v);
    const std::string comma = views_.empty() ? "" : ",";
    views_ += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(begin) + R"(,"byteLength":)" +
              std::to_string(binary_.size() - begin) + "}";
    accessors_ += comma + R"({"bufferView":)" + std::to_string(count_) + R"(,"componentType":)" +
                  std::to_string(componentType) + R"(,"count":)" +
                  std::to_string(values.size() / components) + R"(,"type":")" + type + '"' +
                  (normalized ? R"(,"normalized":true)" : "") + "}";
    return std::to_string(count_++);
  }

  std::string json(const std::string& buffer = "") const {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":)" + roots +
           R"(}],"nodes":)" + nodes + R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0)" +
           attributes + R"(},"indices":)" + indices_ + primitive + "}]" + mesh +
           R"(}],"accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ +
           R"(],"buffers":[{"byteLength":)" + std::to_string(binary_.size()) + buffer + "}]" + top +
           "}";
  }
  TriangleMesh read(Warnings* warnings = nullptr) const {
    return parse(".glb", makeGlb(json(), binary_), true, warnings);
  }
  std::vector<Vec3d> positions() const { return read().positions; }
  Warnings warnings() const {
    Warnings lines;
    read(&lines);
    return lines;
  }
  const std::string& binary() const { return binary_; }

 private:
  static std::size_t componentsOf(const std::string& type) {
    return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type[3] - '0');
  }
  std::string accessors_, views_, binary_, indices_;
  int count_ = 0;
};

const std::vector<Vec3d> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::vector<Vec3d> moved(std::vector<Vec3d> points, const Vec3d& by) {
  for (Vec3d& p : points) p += by;
  return points;
}
void expectNear(const std::vector<Vec3d>& read, const std::vector<Vec3d>& wanted) {
  ASSERT_EQ(read.size(), wanted.size());
  for (std::size_t v = 0; v < read.size(); ++v) EXPECT_LT(length(read[v] - wanted[v]), 1e-6) << v;
}

TEST(GltfScene, APlainJsonFileIsReadWithItsBufferInsideOrBesideIt) {
  const Scene scene;
  const auto read = [&](const std::string& text) {
    return parseGltf(text, {.name = "f.gltf",
                            .sibling = [&](const std::string& name) -> std::optional<std::string> {
                              if (name == "a b.bin") return scene.binary();
                              return std::nullopt;
                            }})
        .positions;
  };
  const std::string inside = scene.json(R"(,"uri":"data:application/octet-stream;base64,)" +
                                        encodeBase64(scene.binary()) + '"');
  EXPECT_EQ(read(inside), kTriangle);
  EXPECT_EQ(read("\xef\xbb\xbf \n" + inside), kTriangle) << "a byte-order mark and blanks";
  EXPECT_EQ(read(scene.json(R"(,"uri":"a%20b.bin")")), kTriangle);
  EXPECT_THROW(read(scene.json(R"(,"uri":"c.bin")")), InputError);
  EXPECT_THROW(read("hello"), InputError);
}

TEST(GltfScene, InstancesAreAllThere) {
  Scene scene;
  const std::string moves = scene.floats("VEC3", {0, 0, 0, 5, 0, 0, 10, 0, 0});
  scene.nodes = R"([{"mesh":0,"translation":[0,0,7],"extensions":{"EXT_mesh_gpu_instancing":
{"attributes":{"TRANSLATION":)" +
                moves + "}}}}]";
  std::vector<Vec3d> wanted;
  for (const double x : {0, 5, 10}) {
    for (const Vec3d& p : moved(kTriangle, {x, 0, 7})) wanted.push_back(p);
  }
  expectNear(scene.positions(), wanted);
  scene.top = R"(,"extensionsRequired":["EXT_mesh_gpu_instancing"])";
  EXPECT_EQ(scene.read().triangles.size(), 3u);
  // A quarter turn about z as normalized bytes, and a scale that turns the second one inside out.
  Scene turned;
  const std::string scales = turned.floats("VEC3", {2, 2, 2, -1, 1, 1});
  const std::string turns =
      turned.array<std::int16_t>("VEC4", 5122, 4, {0, 0, 23170, 23170, 0, 0, 0, 32767}, true);
  turned.nodes = R"([{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"SCALE":)" +
                 scales + R"(,"ROTATION":)" + turns + "}}}}]";
  expectNear(turned.positions(),
             {{0, 0, 0}, {0, 2, 0}, {-2, 0, 0}, {0, 0, 0}, {-1, 0, 0}, {0, 1, 0}});
  EXPECT_GT(areaNormal(turned.read(), 1).z, 0) << "the outside stays out";
  // What else an instance has is said.
  turned.nodes = R"([{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"SCALE":)" +
                 scales + R"(,"_COLOR_0":)" + scales + "}}}}]";
  Warnings warnings;
  EXPECT_EQ(turned.read(&warnings).triangles.size(), 2u);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("instances that are not read: _COLOR_0")));
  turned.nodes = R"([{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"SCALE":)" +
                 turns + "}}}}]";
  EXPECT_THROW(turned.read(), InputError);
}

TEST(GltfScene, NodesAndMeshesNameTheObjectsOfTriangles) {
  Scene scene;
  scene.mesh = R"(,"name":"brick")";
  scene.nodes = R"([{"mesh":0,"name":"tower"},{"mesh":0,"translation":[2,0,0]},
{"mesh":0,"name":"tower","translation":[4,0,0]}])";
  scene.roots = "[0,1,2]";
  const TriangleMesh mesh = scene.read();
  EXPECT_EQ(mesh.objects, (std::vector<std::string>{"", "tower", "brick"}));
  EXPECT_EQ(mesh.triangleObjects, (std::vector<std::uint32_t>{1, 2, 1}));
}

TEST(GltfScene, ASkinPutsVerticesWhereItsJointsAre) {
  Scene scene;
  scene.attributes =
      R"(,"JOINTS_0":)" +
      scene.array<std::uint8_t>("VEC4", 5121, 4, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, false) +
      R"(,"WEIGHTS_0":)" + scene.floats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0});
  // The first joint is where it was bound, the second has moved up by 4 since.
  const std::string bind =
      scene.floats("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -3, 0, 0, 1,  //
                            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1});
  scene.nodes =
      R"([{"mesh":0,"skin":0,"translation":[10,0,0]},{"translation":[3,0,0]},{"translation":[0,0,4]}])";
  scene.roots = "[0,1,2]";
  scene.top = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":)" + bind + "}]";
  expectNear(scene.positions(), {{0, 0, 0}, {1, 0, 4}, {0, 1, 2}});
  // Without matrices joints act as they are; the mesh's own node never does.
  scene.top = R"(,"skins":[{"joints":[1,2]}])";
  expectNear(scene.positions(), {{3, 0, 0}, {1, 0, 4}, {1.5, 1, 2}});
  // A skeleton that hangs outside of the scene's nodes still has its place.
  scene.nodes =
      R"([{"mesh":0,"skin":0},{"translation":[3,0,0]},{"translation":[0,0,4]},{"children":[1,2],"translation":[0,0,1]}])";
  scene.roots = "[0]";
  expectNear(scene.positions(), {{3, 0, 1}, {1, 0, 5}, {1.5, 1, 3}});
  scene.top = R"(,"skins":[{"joints":[1]}])";
  EXPECT_THROW(scene.read(), InputError) << "vertices name a second joint";
  scene.top = R"(,"skins":[{"joints":[]}])";
  EXPECT_THROW(scene.read(), InputError);
}

TEST(GltfScene, MorphTargetsHaveTheirDefaultWeights) {
  Scene scene;
  const std::string up = scene.floats("VEC3", {0, 0, 2, 0, 0, 2, 0, 0, 2});
  const std::string away = scene.floats("VEC3", {8, 0, 0, 8, 0, 0, 8, 0, 0});
  scene.primitive = R"(,"targets":[{"POSITION":)" + up + R"(},{"POSITION":)" + away + "}]";
  EXPECT_EQ(scene.positions(), kTriangle) << "no weights: at rest";
  scene.mesh = R"(,"weights":[0.5,0])";
  EXPECT_EQ(scene.positions(), moved(kTriangle, {0, 0, 1}));
  scene.nodes = R"([{"mesh":0,"weights":[0,0.25]},{"mesh":0}])";
  scene.roots = "[0,1]";
  std::vector<Vec3d> both = moved(kTriangle, {2, 0, 0});
  for (const Vec3d& p : moved(kTriangle, {0, 0, 1})) both.push_back(p);
  EXPECT_EQ(scene.positions(), both) << "a node's weights come before its mesh's";
}

TEST(GltfScene, WhatIsHiddenIsNotThere) {
  Scene scene;
  scene.nodes =
      R"([{"mesh":0,"translation":[9,0,0]},{"children":[2],"extensions":{"KHR_node_visibility":{"visible":false}}},
{"mesh":0,"extensions":{"KHR_node_visibility":{"visible":true}}}])";
  scene.roots = "[0,1]";
  EXPECT_EQ(scene.positions(), moved(kTriangle, {9, 0, 0}));
}

TEST(GltfScene, OtherScenesPointsAndLinesAreSaid) {
  Scene scene;
  scene.roots = R"([0]},{"nodes":[])";
  EXPECT_THAT(scene.warnings(), ElementsAre("f.glb: of its 2 scenes only scenes[0] is read"));
  scene.roots = "[0]";
  scene.primitive = R"(},{"attributes":{"POSITION":0},"mode":1)";
  EXPECT_THAT(scene.warnings(), ElementsAre("f.glb: points and lines are left out"));
}

TEST(GltfScene, AMeshFarFromTheOriginComesBackWhereItWas) {
  // Coordinates of a UTM zone, in meters; floats there are half a meter apart.
  TriangleMesh mesh = plainTorus();
  for (Vec3d& p : mesh.positions) p += Vec3d{500000.25, 4649776.5, 1200};
  for (const char* ending : {".glb", ".gltf"}) {
    const std::string bytes =
        ending == std::string(".glb") ? formatGlb(mesh, true) : formatGltf(mesh, true);
    TriangleMesh back = parse(ending, bytes);
    for (Vec3d& p : back.positions) p = fromFileAxes(p, true);
    // Local coordinates are below 8: a float's step there is 2^-21.
    ASSERT_EQ(back.positions.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      EXPECT_LT(length(back.positions[v] - mesh.positions[v]), 0x1p-20) << v;
  }
  EXPECT_EQ(formatGlb(plainTorus(), true).find("translation"), std::string::npos) << "near 0: none";
  // Instances move together with the parts that they place.
  MeshInstances instances{.first = {0, static_cast<std::uint32_t>(mesh.triangles.size())},
                          .placements = {{0, {0, 0, 0}}, {0, {10, 0, 0}}}};
  TriangleMesh two = parse(".glb", formatGlb(mesh, instances, true));
  const Box3d box = boundingBox(two);
  EXPECT_NEAR(box.min.x, 500000.25 - 2.7, 1e-5);
  EXPECT_NEAR(box.max.x, 500000.25 + 2.7 + 10, 1e-5);
}

TEST(GltfMaterial, FactorsOfMapsThatPicturesDoNotShowAreLeftOut) {
  Scene scene;
  scene.attributes = R"(,"TEXCOORD_0":)" + scene.floats("VEC2", {0, 0, 1, 0, 0, 1});
  scene.primitive = R"(,"material":0)";
  const std::string pictures = R"(,"textures":[{"source":0}],"images":[{"uri":"t.png"}])";
  scene.top = R"(,"materials":[{"emissiveFactor":[1,0.5,1],"emissiveTexture":{"index":0},
"normalTexture":{"index":0},"pbrMetallicRoughness":{"baseColorTexture":{"index":0},
"metallicRoughnessTexture":{"index":0}}}])" +
              pictures;
  Warnings warnings;
  Material m = scene.read(&warnings).materials.at(0);
  EXPECT_EQ(m.emission, (Vec3f{0, 0, 0}));
  EXPECT_EQ(m.metallic, Material{}.metallic);
  EXPECT_EQ(m.roughness, Material{}.roughness);
  EXPECT_EQ(m.baseColorTexture, 0u);
  EXPECT_THAT(warnings, IsEmpty()) << "they are kept with the material";
  scene.top = R"(,"materials":[{"emissiveFactor":[1,0.5,1]}])";
  EXPECT_EQ(scene.read().materials.at(0).emission, (Vec3f{1, 0.5f, 1})) << "a factor alone holds";
  EXPECT_THAT(scene.warnings(), IsEmpty());
  // Factors of programs that do not look at their range.
  scene.top = R"(,"materials":[{"emissiveFactor":[-1,0,0],"pbrMetallicRoughness":
{"baseColorFactor":[1.5,0.5,-0.1,1],"roughnessFactor":2}}])";
  m = scene.read().materials.at(0);
  EXPECT_EQ(m.baseColor, (std::array<float, 4>{1, 0.5f, 0, 1}));
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.emission, (Vec3f{0, 0, 0}));
  EXPECT_THAT(scene.warnings(), ElementsAre(HasSubstr("outside of its range")));
}

TEST(GltfMaterial, SpecularGlossinessKeepsItsDiffuseColor) {
  Scene scene;
  scene.attributes = R"(,"TEXCOORD_0":)" + scene.floats("VEC2", {0, 0, 1, 0, 0, 1});
  scene.primitive = R"(,"material":0)";
  const std::string older =
      R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[1,0,0,1],"glossinessFactor":0.25,
"diffuseTexture":{"index":0}}})";
  const std::string rest =
      R"(],"textures":[{"source":0}],"images":[{"uri":"t.png"}],"extensionsRequired":["KHR_materials_pbrSpecularGlossiness"])";
  scene.top = R"(,"materials":[{)" + older + "}" + rest;
  const Material m = scene.read().materials.at(0);
  EXPECT_EQ(m.baseColor, (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(m.roughness, 0.75f);
  EXPECT_EQ(m.baseColorTexture, 0u);
  EXPECT_THAT(scene.warnings(), IsEmpty());
  // Where the standard's model is there too, that one holds.
  scene.top = R"(,"materials":[{)" + older +
              R"(,"pbrMetallicRoughness":{"baseColorFactor":[0,1,0,1]}})" + rest;
  EXPECT_EQ(scene.read().materials.at(0).baseColor, (std::array<float, 4>{0, 1, 0, 1}));
}

TEST(GltfMaterial, PicturesAndExtensionsThatCannotBeReadAreSaid) {
  Scene scene;
  scene.attributes = R"(,"TEXCOORD_0":)" + scene.floats("VEC2", {0, 0, 1, 0, 0, 1});
  scene.primitive = R"(,"material":0)";
  const auto warningsOf = [&](const std::string& texture, const std::string& more) {
    scene.top = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{)" +
                texture + "}]" + more;
    EXPECT_TRUE(scene.read().textures.empty());
    return scene.warnings();
  };
  EXPECT_THAT(warningsOf(R"("source":0)", R"(,"images":[{"uri":"gone.png"}])"),
              ElementsAre("f.glb: the picture gone.png is not found and is left out"));
  EXPECT_THAT(warningsOf(R"("source":0)", R"(,"images":[{"name":"wall","uri":"m.mtl"}])"),
              ElementsAre("f.glb: the picture m.mtl is neither PNG nor JPEG and is left out"));
  EXPECT_THAT(
      warningsOf(R"("extensions":{"EXT_texture_webp":{"source":0}})",
                 R"(,"images":[{"uri":"t.webp"}],"extensionsRequired":["EXT_texture_webp"])"),
      ElementsAre(HasSubstr("the extension EXT_texture_webp is not read"),
                  HasSubstr("the picture t.webp is not found and is left out")));
  // What changes the shape is refused where it cannot be done.
  scene.top = R"(,"extensionsRequired":["EXT_meshopt_compression"])";
  EXPECT_THROW(scene.read(), InputError);
}

}  // namespace
}  // namespace exemplar
