// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gltf_material_writer.h"

#include <algorithm>
#include <utility>

#include "core/json_text.h"
#include "mesh/gltf_json.h"
#include "mesh/mesh_formats.h"
#include "mesh/mtl.h"

namespace exemplar {
namespace {

using Json = GltfMaterialWriter::Json;

float unit(float value) { return std::min(std::max(value, 0.0f), 1.0f); }

/// Whether a picture of a mesh may be a texture without an extension.
bool isCorePicture(const Texture& texture) {
  return texture.mimeType == "image/png" || texture.mimeType == "image/jpeg";
}

Json transformJson(const UvTransform& transform) {
  Json json;
  if (transform.offset != UvTransform{}.offset) json["offset"] = transform.offset;
  if (transform.rotation != 0) json["rotation"] = transform.rotation;
  if (transform.scale != UvTransform{}.scale) json["scale"] = transform.scale;
  return json;
}

UvTransform transformOf(const Json& info) {
  UvTransform transform;
  const auto extensions = info.find("extensions");
  if (extensions == info.end()) return transform;
  const auto found = extensions->find("KHR_texture_transform");
  if (found == extensions->end()) return transform;
  const auto pair = [&](const char* key, std::array<double, 2>& to) {
    const auto member = found->find(key);
    if (member == found->end() || !member->is_array() || member->size() != 2) return;
    for (int i = 0; i < 2; ++i)
      if ((*member)[i].is_number()) to[i] = (*member)[i].get<double>();
  };
  pair("offset", transform.offset);
  pair("scale", transform.scale);
  const auto rotation = found->find("rotation");
  if (rotation != found->end() && rotation->is_number())
    transform.rotation = rotation->get<double>();
  return transform;
}

void addLight(Json& json, const Vec3f& emission) {
  const float strongest = std::max({emission.x, emission.y, emission.z, 0.0f});
  if (!(strongest > 0)) return;
  // Factors go up to 1; a power of two takes the rest exactly.
  float strength = 1;
  while (strength < strongest && strength < 1e30f) strength *= 2;
  const auto factor = [&](float e) { return unit(e / strength); };
  json["emissiveFactor"] = {factor(emission.x), factor(emission.y), factor(emission.z)};
  if (strength > 1)
    json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
}

}  // namespace

Json plainGltfMaterial(const Material& m, bool translucent) {
  Json json;
  if (!m.name.empty()) json["name"] = m.name;
  Json& pbr = json["pbrMetallicRoughness"];
  pbr["baseColorFactor"] = {unit(m.baseColor[0]), unit(m.baseColor[1]), unit(m.baseColor[2]),
                            unit(m.baseColor[3])};
  pbr["metallicFactor"] = unit(m.metallic);
  pbr["roughnessFactor"] = unit(m.roughness);
  addLight(json, m.emission);
  if (m.baseColor[3] < 1 || translucent) json["alphaMode"] = "BLEND";
  return json;
}

std::optional<UvTransform> normalMapLookup(const Material& material) {
  if (!material.source) return std::nullopt;
  if (material.source->format == MaterialSource::Format::Mtl) {
    for (const MtlMap& map : parseMtlSource(*material.source).maps)
      if (map.key == "norm") return map.transform;
    return std::nullopt;
  }
  // Parsing takes longer than seeing that there is none.
  const std::string& text = material.source->text;
  if (text.find("ormalTexture") == std::string::npos &&
      text.find("anisotropy") == std::string::npos) {
    return std::nullopt;
  }
  Json source = Json::parse(text);
  std::optional<UvTransform> found;
  forEachTextureInfo(source["material"], [&](const Json& parent, const std::string& key) {
    const bool needs =
        key == "normalTexture" || key == "clearcoatNormalTexture" || key == "anisotropyTexture";
    if (needs && (!found || key == "normalTexture")) found = transformOf(parent[key]);
  });
  if (!found && text.find("\"KHR_materials_anisotropy\"") != std::string::npos) found.emplace();
  return found;
}

void GltfMaterialWriter::add(const Material& material, bool translucent) {
  const bool came = material.source && material.source->format == MaterialSource::Format::Gltf;
  materials_.push_back(came ? asItCame(material) : fromMembers(material, translucent));
}

Json GltfMaterialWriter::asItCame(const Material& material) {
  Json source = Json::parse(material.source->text);
  Json& json = source["material"];
  if (!material.name.empty()) json["name"] = material.name;
  std::vector<std::size_t> numberOf;
  if (mesh_.hasUvs()) {
    for (Json& texture : source["textures"]) {
      const auto inMesh = [&](Json& object) {
        if (object.contains("source"))
          object["source"] = material.pictures.at(object["source"].get<std::size_t>());
      };
      inMesh(texture);
      if (texture.contains("extensions"))
        for (auto& item : texture["extensions"].items())
          if (item.value().is_object()) inMesh(item.value());
      numberOf.push_back(textureOf(std::move(texture)));
    }
  }
  forEachTextureInfo(json, [&](Json& parent, const std::string& key) {
    if (!mesh_.hasUvs()) {
      eraseTextureInfo(parent, key);
      return;
    }
    parent[key]["index"] = numberOf.at(parent[key]["index"].get<std::size_t>());
  });
  if (source.contains("required"))
    for (const Json& name : source["required"]) required_.insert(name.get<std::string>());
  return json;
}

Json GltfMaterialWriter::fromMembers(const Material& material, bool translucent) {
  Json json = plainGltfMaterial(material, translucent);
  if (material.baseColorTexture && mesh_.hasUvs()) {
    // Behind the factors, before what comes after them.
    Json& info = json["pbrMetallicRoughness"]["baseColorTexture"];
    info["index"] = textureShowing(*material.baseColorTexture);
    if (!material.baseColorTransform.isIdentity())
      info["extensions"]["KHR_texture_transform"] = transformJson(material.baseColorTransform);
  }
  if (material.source && mesh_.hasUvs()) addMtlMaps(material, json);
  return json;
}

void GltfMaterialWriter::addMtlMaps(const Material& material, Json& json) {
  const MtlMaterial mtl = parseMtlSource(*material.source);
  for (const MtlMap& map : mtl.maps) {
    const char* key = map.key == "norm"     ? "normalTexture"
                      : map.key == "map_ke" ? "emissiveTexture"
                                            : nullptr;
    if (!key || !map.picture || json.contains(key)) continue;
    const std::uint32_t picture = material.pictures.at(*map.picture);
    if (!isCorePicture(mesh_.textures[picture])) continue;
    Json info{{"index", textureShowing(picture)}};
    if (!map.transform.isIdentity())
      info["extensions"]["KHR_texture_transform"] = transformJson(map.transform);
    json[key] = std::move(info);
    // A map without a color is shown as it is.
    if (map.key == "map_ke") addLight(json, mtl.light == Vec3f{} ? Vec3f{1, 1, 1} : mtl.light);
  }
}

std::size_t GltfMaterialWriter::textureOf(Json texture) {
  const auto [found, added] = textureNumbers_.try_emplace(jsonText(texture), textures_.size());
  if (!added) return found->second;
  const auto inDocument = [&](Json& object) {
    if (object.contains("source"))
      object["source"] = imageOf(object["source"].get<std::uint32_t>());
  };
  inDocument(texture);
  if (texture.contains("extensions"))
    for (auto& item : texture["extensions"].items())
      if (item.value().is_object()) inDocument(item.value());
  if (texture.contains("sampler")) {
    Json& sampler = texture["sampler"];
    const auto [number, isNew] = samplerNumbers_.try_emplace(jsonText(sampler), samplers_.size());
    if (isNew) samplers_.push_back(sampler);
    sampler = number->second;
  }
  textures_.push_back(std::move(texture));
  return found->second;
}

std::size_t GltfMaterialWriter::imageOf(std::uint32_t picture) {
  const auto [found, added] = imageNumbers_.try_emplace(picture, images_.size());
  if (!added) return found->second;
  const Texture& texture = mesh_.textures[picture];
  images_.push_back({{"name", texture.name},
                     {"mimeType", texture.mimeType},
                     {"bufferView", addView_(texture.bytes)}});
  return found->second;
}

void GltfMaterialWriter::finish(Json& document) {
  std::set<std::string> used;
  for (const Json* part : {&materials_, &textures_, &samplers_}) addExtensionNames(*part, used);
  std::erase_if(required_, [&](const std::string& name) { return !used.contains(name); });
  document["materials"] = std::move(materials_);
  if (!textures_.empty()) {
    document["textures"] = std::move(textures_);
    document["images"] = std::move(images_);
  }
  if (!samplers_.empty()) document["samplers"] = std::move(samplers_);
  if (!used.empty()) document["extensionsUsed"] = used;
  if (!required_.empty()) document["extensionsRequired"] = required_;
}

}  // namespace exemplar
