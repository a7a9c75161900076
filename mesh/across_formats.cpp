// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/across_formats.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/text.h"
#include "mesh/gltf_json.h"
#include "mesh/mtl.h"

namespace exemplar {
namespace {

using Json = nlohmann::json;

bool isGltf(const Material& m) {
  return m.source && m.source->format == MaterialSource::Format::Gltf;
}
bool isMtl(const Material& m) {
  return m.source && m.source->format == MaterialSource::Format::Mtl;
}
bool isDecodable(const Texture& texture) {
  return texture.mimeType == "image/png" || texture.mimeType == "image/jpeg";
}

/// The picture of a standard map, where it is PNG or JPEG and looked up as it is.
std::optional<std::size_t> pictureOf(const Json& source, const char* key) {
  const auto info = source["material"].find(key);
  if (info == source["material"].end() || !isTextureInfo(key, *info)) return std::nullopt;
  if (info->contains("extensions")) return std::nullopt;
  const Json& texture = source["textures"].at((*info)["index"].get<std::size_t>());
  const auto picture = texture.find("source");
  if (picture == texture.end()) return std::nullopt;
  return picture->get<std::size_t>();
}

/// What a `.mtl` has no key for of a material that came from glTF.
void addLostOfGltf(const Material& m, std::set<std::string>& lost) {
  const Json source = Json::parse(m.source->text);
  std::set<std::string> carried;
  for (const CarriedMap& map : gltfMapsOfMtl(m))
    carried.insert(map.key == std::string("norm") ? "normalTexture" : "emissiveTexture");
  forEachTextureInfo(source["material"], [&](const Json& parent, const std::string& key) {
    if (carried.contains(key)) return;
    if (m.baseColorTexture && key == "baseColorTexture") {
      if (m.baseColorTransform.rotation != 0) lost.insert("the turn of KHR_texture_transform");
      return;
    }
    if (m.baseColorTexture && key == "diffuseTexture" && !parent.contains("baseColorTexture"))
      return;
    lost.insert(key);
  });
  const Json& material = source["material"];
  if (material.contains("doubleSided") && material["doubleSided"] == true)
    lost.insert("doubleSided");
  if (material.contains("alphaMode") && material["alphaMode"] == "MASK") lost.insert("alphaMode");
  if (material.contains("extras")) lost.insert("extras");
  if (!material.contains("extensions")) return;
  for (const auto& item : material["extensions"].items()) {
    if (item.key() != "KHR_materials_emissive_strength" &&
        item.key() != "KHR_materials_pbrSpecularGlossiness")
      lost.insert(item.key());
  }
}

/// What glTF has no place for of a material that came from a `.mtl`. Its older colors (Ka, Ks) have
/// no meaning there.
void addLostOfMtl(const TriangleMesh& mesh, const Material& m, std::set<std::string>& lost) {
  const MtlMaterial mtl = parseMtlSource(*m.source);
  std::set<std::string> carried;
  for (const MtlMap& map : mtl.maps) {
    const bool known = map.key == "map_kd" || map.key == "norm" || map.key == "map_ke";
    const bool decodable = map.picture && isDecodable(mesh.textures[m.pictures.at(*map.picture)]);
    if (!known || !decodable || !carried.insert(map.key).second) lost.insert(map.key);
  }
  std::size_t begin = 0;
  for (const std::string key : {"aniso", "anisor", "pc", "pcr", "ps", "tf"}) {
    for (begin = 0; begin < mtl.lines.size();) {
      const std::size_t end = std::min(mtl.lines.find(' ', begin), mtl.lines.size());
      if (lowerCase(mtl.lines.substr(begin, end - begin)) == key) lost.insert(key);
      begin = std::min(mtl.lines.find('\n', begin), mtl.lines.size() - 1) + 1;
    }
  }
}

}  // namespace

std::vector<CarriedMap> gltfMapsOfMtl(const Material& m) {
  if (!isGltf(m)) return {};
  const Json source = Json::parse(m.source->text);
  std::vector<CarriedMap> maps;
  if (const auto picture = pictureOf(source, "normalTexture"))
    maps.push_back({"norm", *picture, std::nullopt});
  if (const auto picture = pictureOf(source, "emissiveTexture")) {
    Vec3f factor{};  // the standard's default
    const Json& material = source["material"];
    const auto given = material.find("emissiveFactor");
    for (int c = 0; given != material.end() && c < 3; ++c) factor[c] = (*given)[c].get<float>();
    const Json strength = material.value(
        Json::json_pointer("/extensions/KHR_materials_emissive_strength/emissiveStrength"),
        Json(1));
    if (strength.is_number()) factor = factor * strength.get<float>();
    if (factor != Vec3f{}) maps.push_back({"map_Ke", *picture, factor});
  }
  return maps;
}

std::vector<std::string> lostIn(const std::string& ending, const TriangleMesh& mesh) {
  const bool gltf = ending == ".glb" || ending == ".gltf", obj = ending == ".obj";
  const bool ply = ending == ".ply", off = ending == ".off";
  std::set<std::string> lost;
  if (!gltf && !mesh.sources.empty()) lost.insert("sources");
  if (mesh.hasColors() && ending == ".stl") lost.insert("colors");
  if (mesh.hasUvs() && (ending == ".stl" || off)) lost.insert("texture coordinates");
  if (mesh.hasMaterials() && ending == ".stl") lost.insert("materials");
  if (!mesh.hasMaterials() || ending == ".stl") return {lost.begin(), lost.end()};
  std::vector<bool> isUsed(mesh.materials.size(), false);
  for (const std::uint32_t m : mesh.triangleMaterials) isUsed[m] = true;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    if (!isUsed[i]) continue;
    const Material& m = mesh.materials[i];
    if (m.hasTextures() && (ply || off)) lost.insert("textures");
    if (gltf && m.hasTextures() && !mesh.hasUvs())
      lost.insert("textures (there are no texture coordinates)");
    if (obj && isGltf(m)) addLostOfGltf(m, lost);
    if (gltf && mesh.hasUvs() && isMtl(m)) addLostOfMtl(mesh, m, lost);
  }
  return {lost.begin(), lost.end()};
}

}  // namespace exemplar
