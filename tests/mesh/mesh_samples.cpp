// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh_samples.h"

#include <unistd.h>

#include <cmath>
#include <numbers>

#include "mesh/color.h"

namespace exemplar {

long TestFolder::getProcessId() { return ::getpid(); }

std::string fromHex(std::string_view digits) {
  std::string bytes;
  const auto value = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes += static_cast<char>(16 * value(digits[i]) + value(digits[i + 1]));
  }
  return bytes;
}

const std::string& tinyPng() {
  static const std::string bytes = fromHex(
      "89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154789c63"
      "f8cfc0000003010100c9fe92ef0000000049454e44ae426082");
  return bytes;
}

const std::string& tinyJpeg() {
  static const std::string bytes = fromHex(
      "ffd8ffe000104a46494600010100000100010000ffdb004300100b0c0e0c0a100e0d0e1211101318281a1816"
      "16183123251d283a333d3c3933383740485c4e404457453738506d51575f626768673e4d71797064785c6567"
      "63ffc0000b080008000801011100ffc40014000100000000000000000000000000000006ffc4001410010000"
      "0000000000000000000000000000ffda0008010100003f0048ffd9");
  return bytes;
}

TriangleMesh fullMesh() {
  TriangleMesh mesh;
  for (int v = 0; v < 8; ++v) {
    mesh.positions.push_back({v % 2 * 2.0, v / 2 % 2 * 3.0 - 0.5, v / 4 * 1.25});
    mesh.colors.push_back({srgb8ToLinear(static_cast<std::uint8_t>(30 * v)),
                           srgb8ToLinear(static_cast<std::uint8_t>(255 - 30 * v)), srgb8ToLinear(7),
                           v == 3 ? 128.0f / 255 : 1.0f});
  }
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int q = 0; q < 6; ++q) {
    const auto [a, b, c, d] = std::array<std::uint32_t, 4>{
        static_cast<std::uint32_t>(quads[q][0]), static_cast<std::uint32_t>(quads[q][1]),
        static_cast<std::uint32_t>(quads[q][2]), static_cast<std::uint32_t>(quads[q][3])};
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
    // Each face has a cell of its own in the picture; multiples of 1/8 survive 1 - v exactly.
    const float u = static_cast<float>(q % 3) / 4, v = static_cast<float>(q / 3) / 2;
    const Vec2f uv[4] = {{u, v}, {u + 0.25f, v}, {u + 0.25f, v + 0.5f}, {u, v + 0.5f}};
    mesh.uvs.push_back({uv[0], uv[1], uv[2]});
    mesh.uvs.push_back({uv[0], uv[2], uv[3]});
    const std::uint32_t material = q < 2 ? 0 : 1;
    mesh.triangleMaterials.insert(mesh.triangleMaterials.end(), 2, material);
  }
  mesh.textures = {{"brick wall.png", "image/png", tinyPng()}};
  mesh.materials = {{.name = "red paint",
                     .baseColor = {0.7f, 0.1f, 0.05f, 0.5f},
                     .metallic = 0.0f,
                     .roughness = 0.3f,
                     .emission = {0.0f, 2.5f, 0.1f}},
                    {.name = "brick",
                     .baseColor = {1, 1, 1, 1},
                     .metallic = 0.25f,
                     .roughness = 0.9f,
                     .baseColorTexture = 0}};
  return mesh;
}

TriangleMesh plainTorus(int ring, int tube) {
  TriangleMesh mesh;
  constexpr double kTurn = 2 * std::numbers::pi;
  for (int i = 0; i < ring; ++i) {
    for (int j = 0; j < tube; ++j) {
      const double a = kTurn * i / ring, b = kTurn * j / tube;
      const double r = 2 + 0.7 * std::cos(b);
      mesh.positions.push_back({r * std::cos(a), r * std::sin(a), 0.7 * std::sin(b)});
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(i % ring * tube + j % tube);
  };
  for (int i = 0; i < ring; ++i) {
    for (int j = 0; j < tube; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh parse(const std::string& ending, std::string_view bytes, bool withSiblings,
                   Warnings* warnings) {
  const SiblingFile sibling = [&](const std::string& name) -> std::optional<std::string> {
    if (!withSiblings) return std::nullopt;
    if (name == "m.mtl") {
      return "newmtl a\nKd 0.5 0.25 0.125\nd 0.5\nmap_Kd -s 1 1 1 t.png\n\nnewmtl b\nNs 250\nPm "
             "1\n";
    }
    if (name == "t.png") return tinyPng();
    return std::nullopt;
  };
  const MeshSource source{.name = "f" + ending, .sibling = sibling, .warnings = warnings};
  TriangleMesh mesh = ending == ".obj"   ? parseObj(bytes, source)
                      : ending == ".ply" ? parsePly(bytes, source)
                      : ending == ".stl" ? parseStl(bytes, source)
                      : ending == ".off" ? parseOff(bytes, source)
                                         : parseGltf(bytes, source);
  validate(mesh, "f" + ending);
  return mesh;
}

std::string format(const std::string& ending, const TriangleMesh& mesh) {
  return ending == ".obj"   ? formatObj(mesh, "f", false).obj
         : ending == ".ply" ? formatPly(mesh, false)
         : ending == ".stl" ? formatStl(mesh, false)
         : ending == ".off" ? formatOff(mesh, false)
                            : formatGlb(mesh, false);
}

std::string makeGlb(std::string json, std::string binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  const auto number = [](std::size_t n) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(n >> (8 * i) & 255);
    return bytes;
  };
  std::string out = "glTF" + number(2) + number(12 + 8 + json.size() + 8 + binary.size());
  out += number(json.size()) + "JSON" + json;
  out += number(binary.size()) + std::string("BIN\0", 4) + binary;
  return out;
}

std::string richGlb() {
  std::string binary;
  const auto number = [&](float f) { binary.append(reinterpret_cast<const char*>(&f), 4); };
  for (const float f : {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) number(f);  // positions, 48 bytes
  for (const int i : {0, 1, 2, 3}) binary += static_cast<char>(i);       // indices, 4 bytes
  for (const int c : {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 128}) {
    binary += static_cast<char>(c);  // colors, 16 bytes
  }
  for (const float f : {0, 0, 1, 0, 0, 1, 1, 1}) number(f);  // texture coordinates, 32 bytes
  binary += '\2';                                            // a sparse index, padded to 4 bytes
  binary.append(3, '\0');
  for (const float f : {0, 1, 2}) number(f);  // and its value, 12 bytes
  return makeGlb(
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2]}],
"nodes":[{"children":[1],"translation":[1,2,3],"scale":[1,1,-1]},
{"mesh":0,"rotation":[0,0.6,0,0.8]},{"mesh":0,"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,5,0,0,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":2,"TEXCOORD_0":3},"indices":1,"mode":5,
"material":0},{"attributes":{"POSITION":0},"indices":1,"mode":6}]}],
"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1],"metallicFactor":0.1,
"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0],"rotation":1,
"scale":[2,2]}}}},"emissiveFactor":[1,0,0],"extensions":{"KHR_materials_emissive_strength":
{"emissiveStrength":4}}}],"textures":[{"source":0}],
"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUg=="}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":4,"componentType":5121},"values":{"bufferView":4,"byteOffset":4}}},
{"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"},
{"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"},
{"bufferView":3,"byteOffset":0,"componentType":5126,"count":4,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":48,"byteStride":12},{"buffer":0,"byteOffset":48,"byteLength":4},
{"buffer":0,"byteOffset":52,"byteLength":16},{"buffer":0,"byteOffset":68,"byteLength":32},
{"buffer":0,"byteOffset":100,"byteLength":16}],
"buffers":[{"byteLength":116}],"extensionsUsed":["KHR_texture_transform"]})",
      binary);
}

const std::string kRichMaterial =
    R"("name":"reich","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,"extras":{"id":7},
"normalTexture":{"index":1,"scale":0.5},"occlusionTexture":{"index":2,"strength":0.75},
"emissiveTexture":{"index":3},"emissiveFactor":[1,0.5,0.25],
"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.7,
"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0],"rotation":0.3,"scale":[2,3]}}},
"metallicRoughnessTexture":{"index":2}},
"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":3.5},
"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatNormalTexture":{"index":1}},
"VENDOR_materials_moss":{"mossTexture":{"index":0},"density":0.125,"list":[1,"a",null]}})";

std::string squareGlb(const std::string& first, const std::string& second, const std::string& more,
                      const std::string& attributes) {
  std::string binary;
  const auto floats = [&](std::initializer_list<float> values) {
    for (const float f : values) binary.append(reinterpret_cast<const char*>(&f), 4);
  };
  floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  floats({0, 0, 1, 0, 1, 1, 0, 1});
  for (const std::uint16_t i : {0, 1, 2, 0, 2, 3})
    binary.append(reinterpret_cast<const char*>(&i), 2);
  const std::size_t png = binary.size();
  binary += tinyPng();
  const std::size_t jpeg = binary.size();
  binary += tinyJpeg();
  const auto view = [](std::size_t begin, std::size_t size) {
    return R"({"buffer":0,"byteOffset":)" + std::to_string(begin) + R"(,"byteLength":)" +
           std::to_string(size) + "}";
  };
  const std::string attribute =
      R"({"attributes":{"POSITION":0,"TEXCOORD_0":1)" + attributes + R"(},"indices":)";
  return makeGlb(
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"name":"Wand mit Übergröße"}],
"meshes":[{"name":"Wand.001","primitives":[)" +
          attribute + R"(2,"material":1},)" + attribute + R"(3,"material":2}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},
{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"},
{"bufferView":3,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[)" +
          view(0, 48) + "," + view(48, 32) + "," + view(80, 6) + "," + view(86, 6) + "," +
          view(png, tinyPng().size()) + "," + view(jpeg, tinyJpeg().size()) + R"(],
"buffers":[{"byteLength":)" +
          std::to_string(binary.size()) + R"(}],
"images":[{"bufferView":4,"mimeType":"image/png","name":"rot.png"},
{"bufferView":5,"mimeType":"image/jpeg","name":"grau.jpg"}],
"samplers":[{"wrapS":33071,"magFilter":9728},{}],
"textures":[{"source":0,"sampler":0,"name":"t"},{"source":1,"sampler":1},{"source":1},{"source":0,"extras":{"a":[1,2]}}],
"materials":[{"name":"unused"},{)" +
          first + "},{" + second + "}]" + more + "}",
      binary);
}

}  // namespace exemplar
