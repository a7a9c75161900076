// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// write_outputs FOLDER: writes meshes of all kinds as .glb and .gltf for Khronos' validator.

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>

#include "mesh/mesh_file.h"
#include "mesh/primitives.h"
#include "tests/mesh/mesh_samples.h"
#include "voxelize/model_pieces.h"

namespace exemplar {
namespace {

TriangleMesh withColors(TriangleMesh mesh, float alpha) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.colors.push_back({0.125f * static_cast<float>(v % 8), 0.5f, 2.0f, alpha});
  return mesh;
}

TriangleMesh withUvs(TriangleMesh mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.uvs.push_back({Vec2f{0, 0}, {static_cast<float>(t % 2), -3}, {1, 1.5f}});
  return mesh;
}

TriangleMesh withMaterial(TriangleMesh mesh, const Material& material) {
  setMaterial(mesh, material);
  return mesh;
}

TriangleMesh withTextures(TriangleMesh mesh) {
  mesh = withUvs(std::move(mesh));
  mesh.textures = {{"brick.png", "image/png", tinyPng()}, {"", "image/jpeg", tinyJpeg()}};
  mesh.materials = {{.name = "brick", .baseColorTexture = 0},
                    {.name = "unused"},
                    {.name = "brick", .roughness = 2, .baseColorTexture = 1}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.triangleMaterials.push_back(t % 3 == 0 ? 0 : 2);
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, double scale, const Vec3d& by) {
  for (Vec3d& p : mesh.positions) p = p * scale + by;
  return mesh;
}

TriangleMesh soupOf(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& triangle : mesh.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : triangle) soup.positions.push_back(mesh.positions[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  return soup;
}

/// Maps of all kinds, with samplers, transforms and extensions, as a file would have said it.
TriangleMesh withSources(TriangleMesh mesh) {
  mesh = withTextures(std::move(mesh));
  mesh.name = "Wand größer \"1\"";
  mesh.dataName = "Wand.001";
  const auto source = [](const char* text) {
    return std::make_shared<MaterialSource>(MaterialSource{MaterialSource::Format::Gltf, text});
  };
  mesh.materials[0].source = source(
      R"({"material":{"name":"brick","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,
"normalTexture":{"index":1,"scale":0.5},"occlusionTexture":{"index":0,"strength":0.5},
"emissiveTexture":{"index":1},"emissiveFactor":[1,0.5,0],"pbrMetallicRoughness":{"metallicFactor":0.5,
"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,2],"rotation":0.5}}},
"metallicRoughnessTexture":{"index":1}},"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4},
"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatTexture":{"index":0}}},"extras":{"id":[1,2]}},
"textures":[{"source":0,"sampler":{"wrapS":33071,"wrapT":33648,"magFilter":9728}},{"source":1,"sampler":{}}],
"required":["KHR_texture_transform"]})");
  mesh.materials[0].pictures = {0, 1};
  mesh.materials[2].source =
      std::make_shared<MaterialSource>(MaterialSource{MaterialSource::Format::Mtl,
                                                      "Ke 2 1 0\nmap_Ke \x7f"
                                                      "0\nnorm -s 2 2 \x7f"
                                                      "1\n"});
  mesh.materials[2].pictures = {0, 1};
  return mesh;
}

/// A sphere with a normal map, its texture mirrored in the middle.
TriangleMesh withNormalMap() {
  TriangleMesh mesh = makeSphere({0, 0, 0}, 1, 4);
  for (const auto& triangle : mesh.triangles) {
    auto& corners = mesh.uvs.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = mesh.positions[triangle[c]];
      corners[c] = {static_cast<float>(std::abs(p.x)), static_cast<float>(p.z)};
    }
  }
  mesh.textures = {{"brick.png", "image/png", tinyPng()}};
  mesh.materials = {{.name = "bumpy"}};
  mesh.materials[0].source = std::make_shared<MaterialSource>(
      MaterialSource{MaterialSource::Format::Gltf,
                     R"({"material":{"normalTexture":{"index":0}},"textures":[{"source":0}]})"});
  mesh.materials[0].pictures = {0};
  mesh.triangleMaterials.assign(mesh.triangles.size(), 0);
  return mesh;
}

TriangleMesh withPlaces(TriangleMesh mesh) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.sources.push_back({SourcePoint{t, 0, {1, 0}}, {t, 0, {0, 1}}, {t, 1, {0, 0}}});
  return mesh;
}

std::map<std::string, TriangleMesh> samples() {
  const TriangleMesh box = makeBox({{0, 0, 0}, {1, 2, 3}});
  std::map<std::string, TriangleMesh> out;
  out["box"] = box;
  out["sphere"] = makeSphere({0, 0, 0}, 1, 6);
  out["torus"] = plainTorus();
  out["full"] = fullMesh();
  out["colors"] = withColors(box, 1);
  out["colors_and_opacity"] = withColors(box, 0.5f);
  out["uvs"] = withUvs(box);
  out["uvs_and_colors"] = withUvs(withColors(box, 1));
  out["textures"] = withTextures(box);
  out["sources"] = withSources(box);
  out["normal_map"] = withNormalMap();
  out["places"] = withPlaces(withUvs(box));
  out["emission"] = withMaterial(box, {.name = "lamp", .emission = {20, 3, 0}});
  out["glass"] = withMaterial(box, {.name = "gl\xe4ss \"1\"", .baseColor = {1, 1, 1, 0.25f}});
  out["metal"] = withMaterial(box, {.name = "", .metallic = 1, .roughness = 0});
  out["soup"] = soupOf(makeSphere({0, 0, 0}, 1, 3));
  out["far"] = moved(box, 1, {5e5, 4e6, 100});
  out["tiny"] = moved(box, 1e-9, {0, 0, 0});
  out["huge"] = moved(box, 1e12, {0, 0, 0});
  TriangleMesh touching = withUvs(box);
  append(touching, moved(withUvs(box), 1, {1, 2, 0}));
  out["touching"] = touching;
  TriangleMesh degenerate = box;
  degenerate.positions.push_back({9, 9, 9});  // that no triangle uses
  degenerate.triangles.push_back({0, 0, 1});
  degenerate.triangles.push_back({3, 3, 3});
  degenerate.triangles.push_back(degenerate.triangles[0]);
  out["degenerate"] = degenerate;
  TriangleMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {2, 1, 0}};
  out["sheet"] = sheet;
  return out;
}

void writeAll(const std::filesystem::path& folder) {
  for (const auto& [name, mesh] : samples()) {
    writeMesh(folder / (name + ".glb"), mesh);
    writeMesh(folder / (name + ".gltf"), mesh);
    if (mesh.positions.size() > 16) continue;
    writeMesh(folder / (name + "_smooth.glb"), mesh, {.normals = MeshNormals::Smooth});
    // Without normals there are no tangents, which the validator misses where maps need them.
    if (name == "sources") continue;
    writeMesh(folder / (name + "_none.glb"), mesh, {.up = UpAxis::Z, .normals = MeshNormals::None});
  }
  for (const char* name : {"box", "full", "colors", "textures", "sources", "glass", "far"}) {
    const ModelPieces pieces = cutIntoPieces(samples().at(name), {.air = 1});
    writePieceInstances(folder / (std::string("instances_") + name + ".glb"), pieces.grid, pieces);
  }
}

}  // namespace
}  // namespace exemplar

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    exemplar::writeAll(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
