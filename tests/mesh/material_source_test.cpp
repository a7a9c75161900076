// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Materials leave as they came: .glb to .glb, .obj to .obj, and what can be carried between them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "mesh/across_formats.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_formats.h"
#include "mesh/primitives.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A binary glTF file's parts.
struct Parts {
  json root;
  std::string binary;

  explicit Parts(const std::string& glb) {
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, 4);
    root = json::parse(glb.substr(20, length));
    binary = glb.substr(28 + length);
  }
  std::string bytesOf(const json& image) const {
    const json& view = root["bufferViews"][image["bufferView"].get<int>()];
    return binary.substr(view.value("byteOffset", 0), view["byteLength"].get<std::size_t>());
  }
  /// A part of a document with samplers and pictures in place of their indices.
  json resolved(json part) const {
    if (!part.is_structured()) return part;
    for (const char* key : {"index", "source", "sampler"}) {
      if (!part.is_object() || !part.contains(key) || !part[key].is_number()) continue;
      const int n = part[key];
      if (key == std::string("index")) part[key] = root["textures"][n];
      if (key == std::string("sampler")) part[key] = root["samplers"][n];
      if (key == std::string("source")) {
        const json& image = root["images"][n];
        part[key] = {image["mimeType"], image["name"], std::to_string(bytesOf(image).size())};
      }
    }
    for (auto& item : part) item = resolved(item);
    return part;
  }
  json material(int n) const { return resolved(root["materials"][n]); }
  json& primitive() { return root["meshes"][0]["primitives"][0]; }
};

const std::string kPlain = R"("pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]})";
const std::string kUsed =
    R"(,"extensionsUsed":["KHR_texture_transform","VENDOR_materials_moss","KHR_materials_clearcoat",
"KHR_materials_emissive_strength","KHR_lights_punctual"],"extensionsRequired":["KHR_texture_transform"])";

TEST(MaterialSource, AGlbGetsBackWhatAGlbSaid) {
  const std::string file = squareGlb(kRichMaterial, kPlain, kUsed);
  Warnings warnings;
  const TriangleMesh mesh = parse(".glb", file, false, &warnings);
  EXPECT_THAT(warnings, IsEmpty());
  const Parts before(file), after(formatGlb(mesh, false));
  ASSERT_EQ(after.root["materials"].size(), 2u) << "those that triangles use";
  EXPECT_EQ(after.material(0), before.material(1));
  EXPECT_EQ(after.material(1), before.material(2));
  EXPECT_EQ(after.root["images"].size(), 2u);
  EXPECT_EQ(after.bytesOf(after.root["images"][0]), tinyPng());
  EXPECT_EQ(after.bytesOf(after.root["images"][1]), tinyJpeg());
  EXPECT_EQ(after.root["extensionsUsed"],
            json({"KHR_materials_clearcoat", "KHR_materials_emissive_strength",
                  "KHR_texture_transform", "VENDOR_materials_moss"}))
      << "those that are in the file";
  EXPECT_EQ(after.root["extensionsRequired"], json({"KHR_texture_transform"}));
  // And again, byte by byte; as JSON alone, too.
  const TriangleMesh again = parse(".glb", formatGlb(mesh, false));
  EXPECT_EQ(formatGlb(again, false), formatGlb(mesh, false));
  EXPECT_EQ(json::parse(formatGltf(again, false))["materials"], after.root["materials"]);
}

TEST(MaterialSource, NamesOfNodeAndMeshStay) {
  const TriangleMesh mesh = parse(".glb", squareGlb(kPlain, kPlain));
  EXPECT_EQ(mesh.name, "Wand mit Übergröße");
  const json root = Parts(formatGlb(mesh, false)).root;
  EXPECT_EQ(root["nodes"][0]["name"], "Wand mit Übergröße");
  EXPECT_EQ(root["meshes"][0]["name"], "Wand.001");
  EXPECT_EQ(parse(".obj", format(".obj", mesh), false).name, mesh.name);
  // Several objects become one, which has none of their names.
  EXPECT_EQ(parse(".obj", "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nf 1 2 3\n").name, "");
}

TEST(MaterialSource, MembersStillSayHowPicturesShowIt) {
  const TriangleMesh mesh = parse(".glb", squareGlb(kRichMaterial, kPlain));
  const Material& m = mesh.materials.at(0);
  EXPECT_EQ(m.name, "reich");
  EXPECT_EQ(m.baseColor, (std::array<float, 4>{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(mesh.textures.at(m.baseColorTexture.value()).bytes, tinyPng());
  EXPECT_EQ(m.baseColorTransform.scale, (std::array<double, 2>{2, 3}));
  EXPECT_EQ(m.emission, Vec3f{}) << "its map is not shown";
  // Whoever changes members drops the source, and has what the members say.
  TriangleMesh changed = mesh;
  changed.materials[0].source.reset();
  changed.materials[0].pictures.clear();
  const json m0 = Parts(formatGlb(changed, false)).root["materials"][0];
  EXPECT_FALSE(m0.contains("doubleSided"));
  EXPECT_TRUE(m0["pbrMetallicRoughness"]["baseColorTexture"]["extensions"].contains(
      "KHR_texture_transform"));
}

TEST(MaterialSource, WhatAFileDoesNotHoldIsSaid) {
  const auto warningsOf = [](const std::string& material, const std::string& more = "",
                             const std::string& attributes = "") {
    Warnings warnings;
    const TriangleMesh mesh =
        parse(".glb", squareGlb(material, kPlain, more, attributes), false, &warnings);
    formatGlb(mesh, false);  // writes what is left
    return warnings;
  };
  EXPECT_THAT(warningsOf(R"("normalTexture":{"index":0,"texCoord":1},
"pbrMetallicRoughness":{"baseColorTexture":{"index":0}})"),
              ElementsAre("f.glb: maps with other texture coordinates than the base color's are "
                          "left out: normalTexture"));
  EXPECT_THAT(warningsOf(R"("normalTexture":{"index":0,"texCoord":0})"), IsEmpty());
  EXPECT_THAT(warningsOf(kPlain, "", R"(,"TEXCOORD_1":1,"_MOSS":1)"),
              ElementsAre("f.glb: attributes of vertices that are not read: TEXCOORD_1, _MOSS"));
  EXPECT_THAT(warningsOf(R"("normalTexture":{"index":9})"),
              ElementsAre(AllOf(HasSubstr("textures[9]"), HasSubstr("the map is left out"))));
  std::string deep;
  for (int n = 0; n < 1000; ++n) deep += R"({"a":)";
  EXPECT_THAT(warningsOf(R"("extras":)" + deep + "1" + std::string(1000, '}')),
              ElementsAre(HasSubstr("nests too deep")));
}

TEST(MaterialSource, AMapWithoutItsPictureLeavesNoFactorBehind) {
  std::string file = squareGlb(R"("emissiveTexture":{"index":0},"emissiveFactor":[1,1,1],
"pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}})",
                               kPlain);
  Parts parts(file);
  parts.root["images"] = json::array({{{"uri", "gone.png"}}});
  parts.root["textures"] = json::array({{{"source", 0}}});
  Warnings warnings;
  const TriangleMesh mesh =
      parse(".glb", makeGlb(parts.root.dump(), parts.binary), false, &warnings);
  EXPECT_THAT(warnings, ElementsAre("f.glb: the picture gone.png is not found and is left out"));
  const json m = Parts(formatGlb(mesh, false)).root["materials"][0];
  EXPECT_FALSE(m.contains("emissiveFactor"));
  EXPECT_EQ(m["pbrMetallicRoughness"]["metallicFactor"], 0);
}

TEST(MaterialSource, WithoutTextureCoordinatesThereAreNoTextures) {
  TriangleMesh mesh = parse(".glb", squareGlb(kRichMaterial, kPlain));
  mesh.uvs.clear();
  const json root = Parts(formatGlb(mesh, false)).root;
  EXPECT_FALSE(root.contains("textures"));
  EXPECT_EQ(root["materials"][0].dump().find("Texture"), std::string::npos);
  EXPECT_TRUE(root["materials"][0]["doubleSided"].get<bool>());
  EXPECT_THAT(lostIn(".glb", mesh), ElementsAre(HasSubstr("textures")));
}

TEST(MaterialSource, OpacityOfVerticesMattersForTheirMaterialOnly) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  append(mesh, makeBox({{2, 0, 0}, {3, 1, 1}}));
  mesh.materials = {{.name = "glass"}, {.name = "stone"}};
  mesh.triangleMaterials.assign(12, 0);
  mesh.triangleMaterials.resize(24, 1);
  mesh.colors.assign(8, {1, 1, 1, 0.5f});
  mesh.colors.resize(16, {1, 1, 1, 1});
  const json materials = Parts(formatGlb(mesh, false)).root["materials"];
  EXPECT_EQ(materials[0]["alphaMode"], "BLEND");
  EXPECT_FALSE(materials[1].contains("alphaMode"));
}

TEST(MaterialSource, MeshesThatAreJoinedKeepTheirPicturesApart) {
  const TriangleMesh first = parse(".glb", squareGlb(kRichMaterial, kPlain));
  TriangleMesh second = first;
  std::swap(second.textures[0], second.textures[1]);
  for (Material& m : second.materials) {
    if (m.baseColorTexture) m.baseColorTexture = 1 - *m.baseColorTexture;
    for (std::uint32_t& picture : m.pictures) picture = 1 - picture;
  }
  TriangleMesh joined = first;
  append(joined, second);
  EXPECT_EQ(joined.materials.size(), 2u) << "they are equal but for the order of pictures";
  EXPECT_EQ(joined.textures.size(), 2u);
  second.textures[0].bytes += "x";
  append(joined, second);
  EXPECT_EQ(joined.materials.size(), 3u) << "only the one with a picture differs";
  const Parts before(squareGlb(kRichMaterial, kPlain)), after(formatGlb(joined, false));
  EXPECT_EQ(after.material(0), before.material(1));
}

/// An .obj with its library and pictures, read and written again.
struct ObjTrip {
  Warnings warnings;
  TriangleMesh mesh;
  ObjFiles files;
  std::string library() const { return files.siblings.back().bytes; }

  explicit ObjTrip(const std::string& mtl) {
    const MeshSource source{.name = "w.obj",
                            .sibling = [&](const std::string& name) -> std::optional<std::string> {
                              if (name == "w.mtl") return mtl;
                              if (name == "a b.png") return tinyPng();
                              if (name == "n.jpg") return tinyJpeg();
                              if (name == "h.tga") return std::string("\0\0\2", 3);
                              if (name == "secret.txt") return std::string("root:x:0:0");
                              return std::nullopt;
                            },
                            .warnings = &warnings};
    mesh = parseObj(
        "mtllib w.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
        "f 1/1 2/2 3/3\n",
        source);
    files = formatObj(mesh, "out", false);
  }
};

TEST(MaterialSource, AnObjGetsBackTheLinesOfItsLibrary) {
  const std::string lines =
      "Ka 0.25 0.25 0.25 # a comment\nKd 0.5 0.5 0.5\nKs 0 0 0\nillum 7\nNi 1.45\naniso 0.125\n";
  const ObjTrip trip("newmtl m\n" + lines +
                     "map_Kd -s 2 4 1 -o 0.5 0 0 a b.png\nmap_Bump -bm 0.5 n.jpg\n"
                     "refl -type sphere h.tga\nmap_d gone.png\nmap_Ks secret.txt\n");
  EXPECT_EQ(trip.library(), "newmtl m\n" + lines +
                                "map_Kd -s 2 4 1 -o 0.5 0 0 out_a_b.png\n"
                                "map_Bump -bm 0.5 out_n.jpg\nrefl -type sphere out_h.tga\n\n");
  ASSERT_EQ(trip.files.siblings.size(), 4u);
  EXPECT_EQ(trip.files.siblings[1].bytes, tinyJpeg());
  EXPECT_EQ(trip.files.siblings[2].name, "out_h.tga");
  EXPECT_THAT(trip.warnings,
              ElementsAre("w.obj: the texture gone.png is not found and is left out",
                          "w.obj: the texture secret.txt is no picture and is left out"));
  // Scale and offset of the base color's map count in pictures: (0.5, 0.25) is at (1.5, 1).
  const Vec2f at = trip.mesh.materials[0].baseColorTransform.apply({0.5f, 0.25f});
  EXPECT_FLOAT_EQ(at.x, 1.5f);
  EXPECT_FLOAT_EQ(at.y, 1.0f);
}

TEST(MaterialSource, WhatALineCannotBreakIsKept) {
  EXPECT_EQ(ObjTrip("newmtl m\nNs \x7f"
                    "5\nKd 1 0 0\n")
                .library(),
            "newmtl m\nKd 1 0 0\n\n")
      << "a line that cannot be read";
  EXPECT_EQ(ObjTrip("newmtl m\nVendor \x7f"
                    "9\n")
                .library(),
            "newmtl m\nVendor  9\n\n");
  EXPECT_EQ(ObjTrip("newmtl m\nmap_Kd \x7f"
                    "7\n")
                .library(),
            "newmtl m\n\n");
  EXPECT_EQ(ObjTrip("newmtl m\nKd 1 \\\n0 0\nillum 1\n").library(), "newmtl m\nillum 1\n\n");
}

TEST(MaterialSource, AcrossFormatsWhatCanBeIsCarriedAndTheRestIsSaid) {
  const TriangleMesh fromGlb = parse(".glb", squareGlb(kRichMaterial, kPlain));
  const ObjFiles files = formatObj(fromGlb, "out", false);
  const std::string library = files.siblings.back().bytes;
  EXPECT_THAT(library, HasSubstr("norm out_grau.jpg\n"));
  EXPECT_THAT(library, HasSubstr("Ke 3.5 1.75 0.875\n"));
  EXPECT_THAT(library, HasSubstr("map_Ke out_rot.png\n"));
  EXPECT_THAT(library, HasSubstr("map_Kd "));
  EXPECT_THAT(
      lostIn(".obj", fromGlb),
      ElementsAre("KHR_materials_clearcoat", "VENDOR_materials_moss", "alphaMode",
                  "clearcoatNormalTexture", "doubleSided", "extras", "metallicRoughnessTexture",
                  "mossTexture", "occlusionTexture", "the turn of KHR_texture_transform"));
  EXPECT_THAT(lostIn(".glb", fromGlb), IsEmpty());
  EXPECT_THAT(lostIn(".ply", fromGlb), ElementsAre("textures"));
  EXPECT_THAT(lostIn(".stl", fromGlb), ElementsAre("materials", "texture coordinates"));

  const ObjTrip obj(
      "newmtl m\nKe 2 0 0\nmap_Ke a b.png\nnorm n.jpg\nmap_Kd -s 2 2 h.tga\nmap_Bump n.jpg\npc "
      "1\n");
  const Parts parts(formatGlb(obj.mesh, false));
  const json m = parts.root["materials"][0];
  EXPECT_EQ(parts.root["images"].size(), 2u);
  EXPECT_TRUE(m.contains("normalTexture") && m.contains("emissiveTexture"));
  EXPECT_EQ(m["emissiveFactor"], json({1.0, 0.0, 0.0}));
  EXPECT_EQ(m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 2.0);
  EXPECT_THAT(lostIn(".glb", obj.mesh), ElementsAre("map_bump", "map_kd", "pc"));
  EXPECT_THAT(lostIn(".obj", obj.mesh), IsEmpty());
}

TEST(MaterialSource, WritingSaysWhatIsLeftOutInOneLine) {
  const TestFolder folder("lost");
  const TriangleMesh mesh = parse(".glb", squareGlb(kRichMaterial, kPlain));
  for (const char* ending : {".obj", ".ply", ".stl", ".off"}) {
    Warnings warnings;
    writeMesh(folder / (std::string("m") + ending), mesh, {.warnings = &warnings});
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("left out, as this format cannot hold it: ")))
        << ending;
  }
  Warnings warnings;
  writeMesh(folder / "m.gltf", mesh, {.warnings = &warnings});
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(MaterialSource, AHundredThousandMaterialsWithOddNamesAreReadAndWritten) {
  constexpr std::uint32_t kCount = 100000;
  const char* const names[] = {"a b", "Größe", "名前", "a b", "-s 1", "#5", "x;y"};
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (std::uint32_t m = 0; m < kCount; ++m) {
    mesh.triangles.push_back({0, 1, 2});
    mesh.triangleMaterials.push_back(m);
    mesh.materials.push_back({.name = names[m % 7], .roughness = 0.5f});
    mesh.materials.back().baseColor[0] = static_cast<float>(m) / kCount;
  }
  const TestFolder folder("many");
  for (const char* ending : {".obj", ".glb", ".gltf", ".ply"}) {
    const auto path = folder / (std::string("viele Stoffe größer") + ending);
    writeMesh(path, mesh);
    const TriangleMesh back = readMesh(path);
    ASSERT_EQ(back.materials.size(), kCount) << ending;
    EXPECT_EQ(back.triangleMaterials, mesh.triangleMaterials) << ending;
    for (const std::uint32_t m : {0u, 1u, 2u, 99998u})
      EXPECT_EQ(back.materials[m].baseColor, mesh.materials[m].baseColor) << ending << m;
    EXPECT_EQ(back.materials[1].name, "Größe") << ending;
    EXPECT_EQ(back.materials[2].name, "名前") << ending;
  }
  // Pictures that are not there are said in one line.
  std::string obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", mtl;
  for (std::uint32_t m = 0; m < kCount; ++m) {
    const std::string name = "m " + std::to_string(m);
    obj += "usemtl " + name + "\nf 1 2 3\n";
    mtl += "newmtl " + name + "\nmap_Kd " + name + ".png\n";
  }
  writeFile(folder / "p.obj", obj);
  writeFile(folder / "m.mtl", mtl);
  Warnings warnings;
  EXPECT_EQ(readMesh(folder / "p.obj", {.warnings = &warnings}).materials.size(), kCount);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("and 99995 more are not found and are left out")));
  TriangleMesh twice = mesh;
  append(twice, mesh);
  EXPECT_EQ(twice.materials.size(), kCount);
}

TEST(MaterialSource, SourcesAreAttributesOfVertices) {
  TriangleMesh mesh = makeBox({{0, 0, 0}, {1, 1, 1}});
  mesh.sources.resize(12);
  for (std::uint32_t t = 0; t < 12; ++t)
    for (int c = 0; c < 3; ++c)
      mesh.sources[t][c] = {t / 2, t % 2, {c == 0 ? 1.0f : 0.0f, c == 1 ? 1.0f : 0.0f}};
  Parts parts(formatGlb(mesh, false, MeshNormals::None));
  const json attributes = parts.primitive()["attributes"];
  const auto floats = [&](const char* name) {
    const json& accessor = parts.root["accessors"][attributes[name].get<int>()];
    const json& view = parts.root["bufferViews"][accessor["bufferView"].get<int>()];
    std::vector<float> values(view["byteLength"].get<std::size_t>() / 4);
    std::memcpy(values.data(), parts.binary.data() + view.value("byteOffset", 0),
                4 * values.size());
    return values;
  };
  const std::vector<float> face = floats("_SOURCE_FACE"), weights = floats("_SOURCE_WEIGHTS"),
                           example = floats("_SOURCE_EXAMPLE");
  EXPECT_EQ(face.size(), 36u) << "every corner came from elsewhere";
  EXPECT_EQ(weights.size(), 2 * face.size());
  const json& indices = parts.root["accessors"][parts.primitive()["indices"].get<int>()];
  const json& view = parts.root["bufferViews"][indices["bufferView"].get<int>()];
  for (std::uint32_t corner = 0; corner < 36; ++corner) {
    std::uint32_t v = 0;
    std::memcpy(&v, parts.binary.data() + view.value("byteOffset", 0) + 4 * corner, 4);
    const SourcePoint& wanted = mesh.sources[corner / 3][corner % 3];
    EXPECT_EQ(face[v], static_cast<float>(wanted.triangle));
    EXPECT_EQ(example[v], static_cast<float>(wanted.example));
    EXPECT_EQ(weights[2 * v], wanted.weights[0]);
    EXPECT_EQ(weights[2 * v + 1], wanted.weights[1]);
  }
  EXPECT_THAT(lostIn(".obj", mesh), ElementsAre("sources"));
  EXPECT_EQ(parse(".glb", formatGlb(mesh, false)).positions.size(), 8u) << "joined again";
}

}  // namespace
}  // namespace exemplar
