// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gltf_materials.h"

#include <algorithm>

#include "core/text_scanner.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

}  // namespace

void GltfMaterials::use(std::uint64_t index, const std::string& at) {
  const Json& json = in_.element("materials", index, at);
  if (materialUsed_[index]) return;
  materialUsed_[index] = true;
  const std::string place = "materials[" + std::to_string(index) + "]";
  const Json* texture = baseColorTexture(json, place);
  if (!texture) return;
  GltfTextureUse& lookup = textureUses_[index];
  lookup.texCoord = in_.index(*texture, "texCoord", place).value_or(0);
  const Json* extensions = in_.object(*texture, "extensions", place);
  if (!extensions) return;
  if (const Json* transform = in_.object(*extensions, "KHR_texture_transform", place)) {
    const std::string within = place + ".KHR_texture_transform";
    in_.numbers(*transform, "offset", 2, lookup.offset.data(), within);
    in_.numbers(*transform, "scale", 2, lookup.scale.data(), within);
    lookup.rotation = in_.number(*transform, "rotation", 0, within);
    lookup.texCoord = in_.index(*transform, "texCoord", within).value_or(lookup.texCoord);
  }
}

const GltfDocument::Json* GltfMaterials::specularGlossiness(const Json& material,
                                                            const std::string& place) const {
  if (material.contains("pbrMetallicRoughness")) return nullptr;
  return in_.extension(material, "KHR_materials_pbrSpecularGlossiness", place);
}

const GltfDocument::Json* GltfMaterials::baseColorTexture(const Json& material,
                                                          const std::string& place) const {
  if (const Json* older = specularGlossiness(material, place))
    return in_.object(*older, "diffuseTexture", place);
  const Json* pbr = in_.object(material, "pbrMetallicRoughness", place);
  return pbr ? in_.object(*pbr, "baseColorTexture", place) : nullptr;
}

void GltfMaterials::finish() {
  std::vector<std::uint32_t> materialOf(materialUsed_.size() + 1, kNone);
  const auto slotOf = [&](std::uint32_t m) { return m == kNone ? materialUsed_.size() : m; };
  std::vector<bool> isUsed(materialUsed_.size() + 1, false);
  for (const std::uint32_t m : mesh_.triangleMaterials) isUsed[slotOf(m)] = true;
  const bool onlyDefault = std::find(isUsed.begin(), isUsed.end() - 1, true) == isUsed.end() - 1;
  if (onlyDefault || isPlaceholder(isUsed)) {
    mesh_.triangleMaterials.clear();
    return;
  }
  for (std::size_t m = 0; m < isUsed.size(); ++m) {
    if (!isUsed[m]) continue;
    materialOf[m] = static_cast<std::uint32_t>(mesh_.materials.size());
    mesh_.materials.push_back(
        m < materialUsed_.size()
            ? readMaterial(m)
            : Material{.baseColor = {1, 1, 1, 1}, .metallic = 1, .roughness = 1});
  }
  for (std::uint32_t& m : mesh_.triangleMaterials) m = materialOf[slotOf(m)];
  warnOfMaterials();
}

bool GltfMaterials::isPlaceholder(const std::vector<bool>& isUsed) const {
  if (std::count(isUsed.begin(), isUsed.end(), true) != 1 || isUsed.back()) return false;
  const std::size_t m =
      static_cast<std::size_t>(std::find(isUsed.begin(), isUsed.end(), true) - isUsed.begin());
  const Json& json = in_.element("materials", m, "a primitive");
  const auto extras = json.find("extras");
  return extras != json.end() && extras->is_object() && extras->contains("exemplarPlaceholder");
}

Material GltfMaterials::readMaterial(std::uint64_t index) {
  const std::string place = "materials[" + std::to_string(index) + "]";
  const Json& json = in_.element("materials", index, place);
  Material m{.name = in_.text(json, "name", place),
             .baseColor = {1, 1, 1, 1},
             .metallic = 1,
             .roughness = 1};
  if (const Json* pbr = in_.object(json, "pbrMetallicRoughness", place)) {
    double color[4];
    if (in_.numbers(*pbr, "baseColorFactor", 4, color, place)) {
      for (int c = 0; c < 4; ++c) m.baseColor[c] = bounded(color[c], 1, place);
    }
    m.metallic = bounded(in_.number(*pbr, "metallicFactor", 1, place), 1, place);
    m.roughness = bounded(in_.number(*pbr, "roughnessFactor", 1, place), 1, place);
    // A factor without the map that it multiplies would make all of the surface metal.
    if (hasUnreadMap(*pbr, "metallicRoughnessTexture", place)) {
      m.metallic = Material{}.metallic;
      m.roughness = Material{}.roughness;
    }
  }
  if (const Json* older = specularGlossiness(json, place)) readSpecularGlossiness(*older, m, place);
  hasUnreadMap(json, "normalTexture", place);
  hasUnreadMap(json, "occlusionTexture", place);
  noteExtensions(json, place);
  const std::string alphaMode = in_.text(json, "alphaMode", place);
  if (alphaMode.empty() || alphaMode == "OPAQUE") m.baseColor[3] = 1;  // so the standard says
  double emission[3];
  const bool hasFactor = in_.numbers(json, "emissiveFactor", 3, emission, place);
  // The same for light: without its map a lamp's pattern would be a glowing wall.
  if (hasFactor && !hasUnreadMap(json, "emissiveTexture", place)) {
    double strength = 1;
    if (const Json* extensions = in_.object(json, "extensions", place)) {
      if (const Json* e = in_.object(*extensions, "KHR_materials_emissive_strength", place)) {
        strength = in_.number(*e, "emissiveStrength", 1, place);
      }
    }
    for (int c = 0; c < 3; ++c) m.emission[c] = bounded(emission[c] * strength, 1e30, place);
  }
  if (const Json* texture = baseColorTexture(json, place))
    m.baseColorTexture = readTexture(*texture, place);
  return m;
}

void GltfMaterials::readSpecularGlossiness(const Json& json, Material& m,
                                           const std::string& place) {
  double color[4];
  if (in_.numbers(json, "diffuseFactor", 4, color, place)) {
    for (int c = 0; c < 4; ++c) m.baseColor[c] = bounded(color[c], 1, place);
  }
  m.metallic = 0;
  m.roughness = 1 - bounded(in_.number(json, "glossinessFactor", 1, place), 1, place);
  if (hasUnreadMap(json, "specularGlossinessTexture", place)) m.roughness = Material{}.roughness;
}

bool GltfMaterials::hasUnreadMap(const Json& json, const char* key, const std::string& place) {
  if (!in_.object(json, key, place)) return false;
  unreadMaps_.insert(key);
  return true;
}

void GltfMaterials::noteExtensions(const Json& material, const std::string& place) {
  const Json* extensions = in_.object(material, "extensions", place);
  if (!extensions) return;
  for (const auto& item : extensions->items()) {
    if (item.key() != "KHR_materials_emissive_strength" &&
        item.key() != "KHR_materials_pbrSpecularGlossiness") {
      unreadExtensions_.insert(TextScanner::shown(item.key()));
    }
  }
}

void GltfMaterials::warnOfMaterials() const {
  const auto list = [](const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  };
  if (!unreadMaps_.empty()) source_.warn("maps that are not read: " + list(unreadMaps_));
  if (!unreadExtensions_.empty())
    source_.warn("extensions of materials that are not read: " + list(unreadExtensions_));
}

float GltfMaterials::bounded(double value, double most, const std::string& place) const {
  if (!(value >= 0 && value <= most))
    in_.fail(place + " has a factor that is negative or too large");
  return static_cast<float>(value);
}

std::optional<std::uint32_t> GltfMaterials::readTexture(const Json& info,
                                                        const std::string& place) {
  const auto texture = in_.index(info, "index", place + ".baseColorTexture");
  if (!texture) in_.fail(place + ".baseColorTexture.index is missing");
  const std::string at = "textures[" + std::to_string(*texture) + "]";
  const auto image = in_.index(in_.element("textures", *texture, place), "source", at);
  if (!image) {
    source_.warn("the picture of " + at + " is neither PNG nor JPEG and is left out");
    return std::nullopt;
  }
  const auto [found, added] = textureOf_.try_emplace(*image);
  if (!added) return found->second;
  std::optional<std::string> bytes = in_.image(*image, at);
  const std::string mimeType = bytes ? imageMimeType(*bytes) : "";
  if (mimeType.empty()) {
    source_.warn("the picture " + imageName(*image) +
                 (bytes ? " is neither PNG nor JPEG" : " is not found") + " and is left out");
    return std::nullopt;
  }
  found->second = static_cast<std::uint32_t>(mesh_.textures.size());
  mesh_.textures.push_back({textureName(*image, mimeType), mimeType, std::move(*bytes)});
  return found->second;
}

std::string GltfMaterials::imageName(std::uint64_t image) const {
  const std::string place = "images[" + std::to_string(image) + "]";
  const Json& json = in_.element("images", image, "a texture");
  const std::string uri = in_.text(json, "uri", place);
  const std::string name = in_.text(json, "name", place);
  if (!uri.empty() && !uri.starts_with("data:")) return TextScanner::shown(uri);
  return name.empty() ? place : TextScanner::shown(name);
}

std::string GltfMaterials::textureName(std::uint64_t image, const std::string& mimeType) const {
  const Json& json = in_.element("images", image, "a texture");
  const std::string place = "images[" + std::to_string(image) + "]";
  std::string base = in_.text(json, "name", place);
  const std::string uri = in_.text(json, "uri", place);
  if (base.empty() && !uri.starts_with("data:")) base = uri.substr(uri.find_last_of('/') + 1);
  if (base.empty()) base = "texture" + std::to_string(image);
  const std::string ending = mimeType == "image/png" ? ".png" : ".jpg";
  if (!base.ends_with(ending) && !base.ends_with(".jpeg")) base += ending;
  std::string unique = base;
  const auto isTaken = [&] {
    return std::any_of(mesh_.textures.begin(), mesh_.textures.end(),
                       [&](const Texture& t) { return t.name == unique; });
  };
  for (int n = 2; isTaken(); ++n) unique = std::to_string(n) + "_" + base;
  return unique;
}

}  // namespace exemplar
