// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gltf_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>

#include "core/error.h"
#include "mesh/mesh_formats.h"
#include "mesh/mesh_health.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

using testing::HasSubstr;

std::string complaint(const std::string& bytes) {
  try {
    parse(".glb", bytes);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

template <class T>
void put(std::string& bytes, std::initializer_list<T> values) {
  for (const T v : values) bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
}

/// A triangle (0,0,0) (1,0,0) (0,1,0) with indices 0 1 2, and a place in its JSON to change.
struct TriangleFile {
  std::string scene = R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])";
  std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string positions = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
  std::string indices = R"({"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"})";
  std::string views =
      R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12})";
  std::string buffers = R"({"byteLength":48})";
  std::string more;  ///< further accessors, with a comma in front
  std::string top;   ///< further members at the top, with a comma in front
  std::string tail;  ///< further bytes of the binary chunk

  std::string bytes() const {
    std::string binary;
    put<float>(binary, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    put<std::uint32_t>(binary, {0, 1, 2});
    return makeGlb(R"({"asset":{"version":"2.0"},)" + scene + R"(,"meshes":[{"primitives":[)" +
                       primitive + R"(]}],"accessors":[)" + positions + "," + indices + more +
                       R"(],"bufferViews":[)" + views + R"(],"buffers":[)" + buffers + "]" + top +
                       "}",
                   binary + tail);
  }
  TriangleMesh read() const { return parse(".glb", bytes()); }
};

TEST(Glb, TheTriangleItselfIsRead) {
  const TriangleMesh mesh = TriangleFile{}.read();
  EXPECT_EQ(mesh.positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
}

TEST(Glb, NodesMoveTurnAndScaleFromTheInsideOut) {
  TriangleFile file;
  // A quarter turn about z after doubling, then the parent's move; another node by its matrix.
  file.scene =
      R"("scenes":[{"nodes":[0,2]}],"nodes":[{"children":[1],"translation":[10,0,0]},
{"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,3,1]},
{"mesh":0,"matrix":[0,0,1,0,0,1,0,0,-1,0,0,0,7,8,9,1]}])";
  const TriangleMesh mesh = file.read();
  ASSERT_EQ(mesh.positions.size(), 6u);
  const std::vector<Vec3d> expected{{10, 0, 0}, {10, 2, 0}, {7, 0, 0},
                                    {7, 8, 9},  {7, 8, 10}, {7, 9, 9}};
  for (int v = 0; v < 6; ++v) EXPECT_LT(length(mesh.positions[v] - expected[v]), 1e-12) << v;
}

TEST(Glb, AMirroredNodeKeepsTheOutsideOut) {
  TriangleFile file;
  file.scene = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[-1,1,1]}])";
  EXPECT_EQ(areaNormal(TriangleFile{}.read(), 0), (Vec3d{0, 0, 1}));
  EXPECT_EQ(areaNormal(file.read(), 0), (Vec3d{0, 0, 1}));
}

TEST(Glb, WithoutAScenesArrayAllRootsAreRead) {
  TriangleFile file;
  file.scene = R"("nodes":[{"mesh":0},{"children":[0,2]},{"mesh":0},{"mesh":0}])";
  EXPECT_EQ(file.read().triangles.size(), 3u);
}

TEST(Glb, StripsAndFansAlternateAsTheyShould) {
  TriangleFile file;
  file.positions = R"({"bufferView":2,"componentType":5126,"count":5,"type":"VEC3"})";
  file.indices = R"({"bufferView":3,"componentType":5123,"count":5,"type":"SCALAR"})";
  file.views +=
      R"(,{"buffer":0,"byteOffset":48,"byteLength":60},{"buffer":0,"byteOffset":108,"byteLength":10})";
  file.buffers = R"({"byteLength":120})";
  put<float>(file.tail, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  put<std::uint16_t>(file.tail, {0, 1, 2, 3, 4, 0});
  file.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":5})";
  EXPECT_EQ(file.read().triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  file.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":6})";
  EXPECT_EQ(file.read().triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  file.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":1})";
  EXPECT_THAT(complaint(file.bytes()), HasSubstr("no triangles")) << "lines";
}

TEST(Glb, NormalizedAndQuantizedPositionsAreScaled) {
  TriangleFile file;
  file.views += R"(,{"buffer":0,"byteOffset":48,"byteLength":24,"byteStride":8})";
  file.buffers = R"({"byteLength":72})";
  put<std::int16_t>(file.tail, {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0});
  file.top = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  file.positions =
      R"({"bufferView":2,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"})";
  EXPECT_EQ(file.read().positions, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
  file.positions = R"({"bufferView":2,"componentType":5122,"count":3,"type":"VEC3"})";
  EXPECT_EQ(file.read().positions[1], (Vec3d{32767, 0, 0}));
}

TEST(Glb, SparseAccessorsReplaceVectors) {
  TriangleFile file;
  file.views += R"(,{"buffer":0,"byteOffset":48,"byteLength":20})";
  file.buffers = R"({"byteLength":68})";
  put<std::uint16_t>(file.tail, {1, 2});
  put<float>(file.tail, {5, 0, 0, 0});
  put<float>(file.tail, {6, 0, 0});
  file.views.replace(file.views.rfind("20}"), 3, "28}");
  file.buffers = R"({"byteLength":76})";
  const std::string sparse =
      R"("sparse":{"count":2,"indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":2,"byteOffset":4}}})";
  file.positions = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)" + sparse;
  EXPECT_EQ(file.read().positions, (std::vector<Vec3d>{{0, 0, 0}, {5, 0, 0}, {0, 6, 0}}));
  file.positions = R"({"componentType":5126,"count":3,"type":"VEC3",)" + sparse;
  EXPECT_EQ(file.read().positions[1], (Vec3d{5, 0, 0})) << "over zeros, without a view";
  file.tail[2] = 3;
  EXPECT_THAT(complaint(file.bytes()), HasSubstr("accessors[0].sparse names element 3 of 3"));
}

TEST(Glb, VerticesSplitForNormalsAreJoinedAndOthersAreNot) {
  TriangleMesh soup;
  for (const auto& triangle : plainTorus().triangles) {
    const std::uint32_t n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : triangle) soup.positions.push_back(plainTorus().positions[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const std::string bytes = formatGlb(soup, false, MeshNormals::None);
  EXPECT_EQ(parse(".glb", bytes).positions.size(), soup.positions.size())
      << "nothing says why they are apart";
  const std::string plain = R"("attributes":{"POSITION":0})",
                    split = R"("attributes":{"POSITION":0,"NORMAL":0})";
  const std::size_t at = bytes.find(plain);
  ASSERT_NE(at, std::string::npos);
  // The JSON grows by eleven bytes; one of padding keeps its chunk's length a multiple of four.
  const std::size_t jsonEnd = bytes.find("BIN") - 4;
  std::string json = bytes.substr(20, jsonEnd - 20);
  json.replace(json.find(plain), plain.size(), split);
  const TriangleMesh joined = parse(".glb", makeGlb(json, bytes.substr(jsonEnd + 8)));
  EXPECT_EQ(joined.positions.size(), plainTorus().positions.size());
  EXPECT_TRUE(meshHealth(joined).closed());
}

TEST(Glb, TexturesAreLookedUpThroughTheirTransform) {
  TriangleFile file;
  file.primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_1":2},"indices":1,"material":0})";
  file.more = R"(,{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"})";
  file.views += R"(,{"buffer":0,"byteOffset":48,"byteLength":24})";
  file.buffers = R"({"byteLength":72})";
  put<float>(file.tail, {0, 0, 1, 0, 0, 1});
  file.top =
      R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1,"extensions":
{"KHR_texture_transform":{"offset":[0.5,0.25],"rotation":1.5707963267948966,"scale":[2,4]}}}}}],
"textures":[{"source":0}],"images":[{"uri":"t.png"}])";
  const TriangleMesh mesh = file.read();
  ASSERT_TRUE(mesh.hasUvs());
  // (u, v) -> (0.5 + 4 v, 0.25 - 2 u) for a quarter turn, then v upwards.
  const Vec2f expected[] = {{0.5f, 0.75f}, {0.5f, 2.75f}, {4.5f, 0.75f}};
  for (int c = 0; c < 3; ++c) {
    const Vec2f at = mesh.materials.at(0).baseColorTransform.apply(mesh.uvs[0][c]);
    EXPECT_NEAR(at.x, expected[c].x, 1e-6) << c;
    EXPECT_NEAR(at.y, expected[c].y, 1e-6) << c;
  }
  ASSERT_EQ(mesh.textures.size(), 1u) << "a picture beside the file";
  EXPECT_EQ(mesh.textures[0].name, "t.png");
  EXPECT_EQ(mesh.materials[0].metallic, 1) << "the standard's default";
}

TEST(Glb, RefusesWhatDoesNotHoldTogether) {
  const auto with = [](auto change) {
    TriangleFile file;
    change(file);
    return complaint(file.bytes());
  };
  using F = TriangleFile&;
  EXPECT_THAT(with([](F f) {
                f.positions = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
              }),
              HasSubstr("accessors[0] needs 4 elements from byte 0 of a view of 36 bytes"));
  EXPECT_THAT(
      with([](F f) {
        f.positions =
            R"({"bufferView":0,"byteOffset":4,"componentType":5126,"count":3,"type":"VEC3"})";
      }),
      HasSubstr("accessors[0] needs 3"));
  EXPECT_THAT(
      with([](F f) {
        f.positions =
            R"({"bufferView":0,"componentType":5126,"count":9007199254740992,"type":"VEC3"})";
      }),
      HasSubstr("accessors[0] needs"));
  EXPECT_THAT(with([](F f) {
                f.positions =
                    R"({"bufferView":0,"componentType":5126,"count":1e300,"type":"VEC3"})";
              }),
              HasSubstr("accessors[0].count should be a whole number"));
  EXPECT_THAT(with([](F f) {
                f.positions = R"({"bufferView":0,"componentType":5126,"count":-3,"type":"VEC3"})";
              }),
              HasSubstr("accessors[0].count should be a whole number"));
  EXPECT_THAT(
      with([](F f) { f.positions = R"({"componentType":5126,"count":4000000000,"type":"VEC3"})"; }),
      HasSubstr("more elements than the file has bytes"));
  EXPECT_THAT(with([](F f) {
                f.positions = R"({"bufferView":9,"componentType":5126,"count":3,"type":"VEC3"})";
              }),
              HasSubstr("accessors[0] names bufferViews[9], and there are 2"));
  EXPECT_THAT(with([](F f) {
                f.positions = R"({"bufferView":0,"componentType":5124,"count":3,"type":"VEC3"})";
              }),
              HasSubstr("componentType should be"));
  EXPECT_THAT(with([](F f) {
                f.positions = R"({"bufferView":0,"componentType":5126,"count":3,"type":"MAT2"})";
              }),
              HasSubstr("type should be"));
  EXPECT_THAT(with([](F f) {
                f.positions = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"})";
              }),
              HasSubstr("VEC3"));
  EXPECT_THAT(with([](F f) { f.positions = "7"; }), HasSubstr("accessors[0] should be an object"));
  EXPECT_THAT(with([](F f) {
                f.indices = R"({"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"})";
              }),
              HasSubstr("used as indices"));
  EXPECT_THAT(with([](F f) {
                f.indices = R"({"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"})";
              }),
              "");
  EXPECT_THAT(with([](F f) {
                f.indices = R"({"bufferView":0,"componentType":5125,"count":9,"type":"SCALAR"})";
              }),
              HasSubstr("names vertex 1065353216 of 3"));
  EXPECT_THAT(with([](F f) {
                f.indices = R"({"bufferView":1,"componentType":5125,"count":2,"type":"SCALAR"})";
              }),
              HasSubstr("not a multiple of three"));
  EXPECT_THAT(
      with([](F f) { f.views = R"({"buffer":0,"byteLength":1000},{"buffer":0,"byteLength":12})"; }),
      HasSubstr("bufferViews[0] reaches from byte 0 over 1000 bytes, and its buffer has 48"));
  EXPECT_THAT(
      with([](F f) {
        f.views =
            R"({"buffer":0,"byteOffset":9007199254740991,"byteLength":9007199254740991},{"buffer":0,"byteLength":12})";
      }),
      HasSubstr("bufferViews[0] reaches"));
  EXPECT_THAT(with([](F f) {
                f.views =
                    R"({"buffer":0,"byteLength":36,"byteStride":4},{"buffer":0,"byteLength":12})";
              }),
              HasSubstr("4 bytes apart"));
  EXPECT_THAT(with([](F f) { f.views = R"({"byteLength":36},{"buffer":0,"byteLength":12})"; }),
              HasSubstr("bufferViews[0].buffer is missing"));
  EXPECT_THAT(with([](F f) { f.buffers = R"({"byteLength":49})"; }),
              HasSubstr("buffers[0].byteLength is 49"));
  EXPECT_THAT(with([](F f) { f.buffers = R"({"byteLength":48,"uri":"none.bin"})"; }),
              HasSubstr("no such file beside"));
  EXPECT_THAT(with([](F f) { f.buffers = R"({"byteLength":48,"uri":"data:;base64,???"})"; }),
              HasSubstr("base64"));
  EXPECT_THAT(
      with([](F f) { f.scene = R"("scene":3,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}])"; }),
      HasSubstr("names scenes[3], and there are 1"));
  EXPECT_THAT(with([](F f) { f.scene = R"("scenes":[{"nodes":[-1]}],"nodes":[{"mesh":0}])"; }),
              HasSubstr("scenes[0].nodes names a node that does not exist"));
  EXPECT_THAT(
      with([](F f) {
        f.scene =
            R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"children":[1]},{"children":[0]}])";
      }),
      HasSubstr("nodes[0] is reached twice"));
  EXPECT_THAT(with([](F f) { f.scene = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":5}])"; }),
              HasSubstr("nodes[0] names meshes[5]"));
  EXPECT_THAT(with([](F f) {
                f.scene = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[1e200,1,1]}])";
              }),
              HasSubstr("has a coordinate of 1e15 or more"));
  EXPECT_THAT(with([](F f) {
                f.scene = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[1,"x",1]}])";
              }),
              HasSubstr("nodes[0].scale should be 3 finite numbers"));
  EXPECT_THAT(with([](F f) {
                f.scene = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"rotation":[0,0,0,0]}])";
              }),
              HasSubstr("nodes[0].rotation should have length 1"));
  EXPECT_THAT(with([](F f) { f.scene = R"("nodes":{})"; }), HasSubstr("nodes should be an array"));
  EXPECT_THAT(with([](F f) { f.primitive = R"({"indices":1})"; }),
              HasSubstr("attributes is missing"));
  EXPECT_THAT(with([](F f) { f.primitive = R"({"attributes":{"POSITION":7},"indices":1})"; }),
              HasSubstr("names accessors[7]"));
  EXPECT_THAT(
      with([](F f) { f.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":0})"; }),
      HasSubstr("names materials[0], and there are 0"));
  EXPECT_THAT(with([](F f) { f.top = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"; }),
              HasSubstr("needs the glTF extension KHR_draco_mesh_compression"));
}

TEST(Glb, RefusesNaNPositions) {
  TriangleFile file;
  file.views =
      R"({"buffer":0,"byteOffset":48,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12})";
  file.buffers = R"({"byteLength":84})";
  put<float>(file.tail, {0, 0, 0, 1, NAN, 0, 0, 1, 0});
  EXPECT_THAT(complaint(file.bytes()),
              HasSubstr("accessors[0]: vertex 1 has a NaN or infinite coordinate"));
}

TEST(Glb, RefusesAContainerThatLies) {
  const std::string whole = TriangleFile{}.bytes();
  const auto with = [&](std::size_t at, std::uint32_t value) {
    std::string bytes = whole;
    std::memcpy(bytes.data() + at, &value, 4);
    return complaint(bytes);
  };
  EXPECT_THAT(with(0, 1), HasSubstr("should begin with 'glTF'"));
  EXPECT_THAT(with(4, 1), HasSubstr("glTF version 1"));
  EXPECT_THAT(with(8, 0xffffffff), HasSubstr("its header promises 4294967295 bytes"));
  EXPECT_THAT(with(12, 0xffffffff), HasSubstr("a chunk promises 4294967295 bytes"));
  EXPECT_THAT(with(16, 7), HasSubstr("first chunk should be JSON"));
  // The binary chunk reaches four bytes too far.
  const std::size_t binary = whole.find("BIN") - 4;
  EXPECT_THAT(with(binary, 52), HasSubstr("a chunk promises 52 bytes and 48 are left"));
  EXPECT_THAT(complaint(makeGlb("{", "")), HasSubstr("malformed at byte"));
  EXPECT_THAT(complaint(makeGlb("[]", "")), HasSubstr("should be an object"));
  EXPECT_THAT(complaint(makeGlb("{}", "")), HasSubstr("no triangles"));
}

TEST(Glb, NestsAsDeepAsTheFileIsLong) {
  std::string nested(200000, '[');
  nested += std::string(200000, ']');
  TriangleFile file;
  file.top = R"(,"extras":)" + nested;
  EXPECT_EQ(file.read().triangles.size(), 1u) << "extras are not our concern, at any depth";
  EXPECT_THAT(complaint(makeGlb(std::string(400000, '['), "")), HasSubstr("malformed"));

  // A chain of nodes, each the child of the one before.
  std::string nodes;
  constexpr int kDepth = 30000;
  for (int n = 0; n < kDepth; ++n)
    nodes += R"({"translation":[1,0,0],"children":[)" + std::to_string(n + 1) + "]},";
  file = {};
  file.scene = R"("scenes":[{"nodes":[0]}],"nodes":[)" + nodes + R"({"mesh":0}])";
  EXPECT_EQ(file.read().positions[1].x, kDepth + 1);
}

TEST(Glb, WhatIsWrittenAnotherLibraryReads) {
  const TriangleMesh full = fullMesh();
  const std::string bytes = format(".glb", full);
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(loader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned>(bytes.size())))
      << error;
  EXPECT_EQ(error + warning, "");
  ASSERT_EQ(model.meshes.size(), 1u);
  ASSERT_EQ(model.meshes[0].primitives.size(), 2u) << "one for each material";
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].width, 1);
  EXPECT_EQ(model.materials[1].pbrMetallicRoughness.roughnessFactor, 0.9f);
  EXPECT_EQ(model.materials[0].alphaMode, "BLEND");
  const auto floats = [&](int index) {
    const tinygltf::Accessor& a = model.accessors[index];
    EXPECT_EQ(a.componentType, TINYGLTF_COMPONENT_TYPE_FLOAT);
    return reinterpret_cast<const float*>(
        &model.buffers[0].data[model.bufferViews[a.bufferView].byteOffset + a.byteOffset]);
  };
  std::size_t triangle = 0;
  for (const auto& primitive : model.meshes[0].primitives) {
    const tinygltf::Accessor& indices = model.accessors[primitive.indices];
    ASSERT_EQ(indices.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
    const auto* index = reinterpret_cast<const std::uint32_t*>(
        &model.buffers[0]
             .data[model.bufferViews[indices.bufferView].byteOffset + indices.byteOffset]);
    const float* position = floats(primitive.attributes.at("POSITION"));
    const float* uv = floats(primitive.attributes.at("TEXCOORD_0"));
    const float* color = floats(primitive.attributes.at("COLOR_0"));
    for (std::size_t i = 0; i < indices.count; i += 3, ++triangle) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = full.triangles[triangle][c], f = index[i + c];
        const Vec3d p{position[3 * f], position[3 * f + 1], position[3 * f + 2]};
        EXPECT_EQ(p, full.positions[v]);
        EXPECT_EQ(uv[2 * f], full.uvs[triangle][c].x);
        EXPECT_EQ(uv[2 * f + 1], 1 - full.uvs[triangle][c].y);
        for (int k = 0; k < 4; ++k) EXPECT_EQ(color[4 * f + k], full.colors[v][k]);
      }
    }
    const tinygltf::Accessor& a = model.accessors[primitive.attributes.at("POSITION")];
    const Box3d box = boundingBox(full);
    EXPECT_EQ(a.minValues, (std::vector<double>{box.min.x, box.min.y, box.min.z}));
    EXPECT_EQ(a.maxValues, (std::vector<double>{box.max.x, box.max.y, box.max.z}));
  }
  EXPECT_EQ(triangle, full.triangles.size());
}

TEST(Glb, InstancesAreMeshesThatNodesShare) {
  // The first two faces, all but them, and a part without triangles.
  const TriangleMesh full = fullMesh();
  const auto last = static_cast<std::uint32_t>(full.triangles.size());
  MeshInstances instances;
  instances.first = {0, 4, 4, last};
  instances.placements = {{2, {10, 0, 0}}, {0, {0, 20, 0}}, {1, {5, 5, 5}}, {0, {0, 0, 30}}};
  const std::string bytes = formatGlb(full, instances, /*yUp=*/true);
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(loader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned>(bytes.size())))
      << error;
  EXPECT_EQ(error + warning, "");
  ASSERT_EQ(model.meshes.size(), 2u) << "the empty part is not there";
  ASSERT_EQ(model.nodes.size(), 3u);
  EXPECT_EQ(model.scenes[0].nodes, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(model.nodes[1].mesh, model.nodes[2].mesh);
  EXPECT_NE(model.nodes[0].mesh, model.nodes[1].mesh);
  EXPECT_EQ(model.nodes[1].translation, (std::vector<double>{0, 0, -20}));  // y is up in the file
  EXPECT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.materials.size(), 2u);
  // Read back, all of it is in its place, with its colors.
  const TriangleMesh back = parse(".glb", bytes);
  EXPECT_EQ(back.triangles.size(), 4u + 4u + (last - 4));
  EXPECT_EQ(back.materials[0].name, full.materials[0].name);
  EXPECT_TRUE(back.hasUvs() && back.hasColors());
  const auto boxOf = [](const TriangleMesh& mesh, std::size_t from, std::size_t to) {
    Box3d box;
    for (std::size_t t = from; t < to; ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) box.add(mesh.positions[v]);
    }
    return box;
  };
  const Box3d rest = boxOf(full, 4, last), moved = boxOf(back, 0, last - 4);
  EXPECT_EQ(fromFileAxes(moved.min, true).x, rest.min.x + 10);
}

TEST(Glb, VerticesAreSplitOnlyWhereTextureCoordinatesDiffer) {
  const auto vertexCount = [](const TriangleMesh& mesh) {
    const std::string bytes = formatGlb(mesh, false, MeshNormals::None);
    const std::string json = bytes.substr(20, bytes.find("BIN") - 24);
    return nlohmann::json::parse(json)["accessors"][0]["count"].get<std::size_t>();
  };
  TriangleMesh torus = plainTorus();
  EXPECT_EQ(vertexCount(torus), torus.positions.size());
  torus.uvs.assign(torus.triangles.size(), {Vec2f{0.5f, 0.5f}, {0.5f, 0.5f}, {0.5f, 0.5f}});
  EXPECT_EQ(vertexCount(torus), torus.positions.size()) << "equal ones do not split";
  torus.uvs[0][0].x = 0.25f;
  EXPECT_EQ(vertexCount(torus), torus.positions.size() + 1);
  torus.positions.push_back({100, 100, 100});
  EXPECT_EQ(vertexCount(torus), torus.positions.size()) << "vertices without triangles stay away";
}

}  // namespace
}  // namespace exemplar
