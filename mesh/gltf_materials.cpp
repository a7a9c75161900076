// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/json_text.h"
#include "core/text_scanner.h"
#include "mesh/gltf_json.h"
#include "mesh/gltf_material_writer.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

using Json = GltfDocument::Json;

/// The materials (the last one for none) that have triangles with an opacity below 1 at a vertex.
std::vector<bool> translucentMaterials(const TriangleMesh& mesh, std::size_t count) {
  std::vector<bool> result(count, false);
  if (!mesh.hasColors()) return result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t m = std::min<std::size_t>(mesh.triangleMaterials[t], count - 1);
    for (const std::uint32_t v : mesh.triangles[t])
      if (mesh.colors[v][3] < 1) result[m] = true;
  }
  return result;
}

/// Whether what a file says of a material is what would be written for its members alone.
bool saysNoMore(const Json& kept, const Material& m, bool translucent) {
  Json plain(plainGltfMaterial(m, translucent)), material = kept["material"];
  if (m.baseColorTexture) {
    if (kept["textures"] != Json::array({{{"source", 0}}})) return false;
    plain["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  } else if (!kept["textures"].empty()) {
    return false;
  }
  return plain == material;
}

}  // namespace

void GltfMaterials::use(std::uint64_t index, const std::string& at) {
  const Json& json = in_.element("materials", index, at);
  if (materialUsed_[index]) return;
  materialUsed_[index] = true;
  const std::string place = "materials[" + std::to_string(index) + "]";
  const Json* texture = baseColorTexture(json, place);
  if (!texture && !nestsDeeperThan(json, kDeepestJson)) {
    forEachTextureInfo(json, [&](const Json& parent, const std::string& key) {
      if (!texture) texture = &parent[key];
    });
  }
  if (texture) texCoords_[index] = texCoordOf(*texture, place);
}

std::uint64_t GltfMaterials::texCoordOf(const Json& info, const std::string& place) const {
  const std::uint64_t texCoord = in_.index(info, "texCoord", place).value_or(0);
  const Json* transform = in_.extension(info, "KHR_texture_transform", place);
  if (!transform) return texCoord;
  return in_.index(*transform, "texCoord", place + ".KHR_texture_transform").value_or(texCoord);
}

UvTransform GltfMaterials::transformOf(const Json& info, const std::string& place) const {
  UvTransform lookup;
  if (const Json* transform = in_.extension(info, "KHR_texture_transform", place)) {
    const std::string within = place + ".KHR_texture_transform";
    in_.numbers(*transform, "offset", 2, lookup.offset.data(), within);
    in_.numbers(*transform, "scale", 2, lookup.scale.data(), within);
    lookup.rotation = in_.number(*transform, "rotation", 0, within);
  }
  return lookup;
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
  const std::vector<bool> translucent = translucentMaterials(mesh_, isUsed.size());
  for (std::size_t m = 0; m < isUsed.size(); ++m) {
    if (!isUsed[m]) continue;
    materialOf[m] = static_cast<std::uint32_t>(mesh_.materials.size());
    mesh_.materials.push_back(
        m < materialUsed_.size()
            ? readMaterial(m, translucent[m])
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

Material GltfMaterials::readMaterial(std::uint64_t index, bool translucent) {
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
    // A factor without the map that it multiplies, which pictures do not show, would make all of
    // the surface metal.
    if (in_.object(*pbr, "metallicRoughnessTexture", place)) {
      m.metallic = Material{}.metallic;
      m.roughness = Material{}.roughness;
    }
  }
  if (const Json* older = specularGlossiness(json, place)) readSpecularGlossiness(*older, m, place);
  const std::string alphaMode = in_.text(json, "alphaMode", place);
  if (alphaMode.empty() || alphaMode == "OPAQUE") m.baseColor[3] = 1;  // so the standard says
  double emission[3];
  const bool hasFactor = in_.numbers(json, "emissiveFactor", 3, emission, place);
  // The same for light: without its map a lamp's pattern would be a glowing wall.
  if (hasFactor && !in_.object(json, "emissiveTexture", place)) {
    double strength = 1;
    if (const Json* e = in_.extension(json, "KHR_materials_emissive_strength", place))
      strength = in_.number(*e, "emissiveStrength", 1, place);
    for (int c = 0; c < 3; ++c) m.emission[c] = bounded(emission[c] * strength, 1e30, place);
  }
  if (const Json* texture = baseColorTexture(json, place)) {
    m.baseColorTexture = readTexture(*texture, place);
    if (m.baseColorTexture) m.baseColorTransform = transformOf(*texture, place);
  }
  keepSource(index, json, translucent, m);
  return m;
}

void GltfMaterials::keepSource(std::uint64_t index, const Json& json, bool translucent,
                               Material& m) {
  const std::string place = "materials[" + std::to_string(index) + "]";
  if (nestsDeeperThan(json, kDeepestJson)) {
    source_.warn(place + " nests too deep; its base color, roughness and emission are kept only");
    return;
  }
  Json kept{{"material", json}, {"textures", Json::array()}};
  std::map<std::uint64_t, std::size_t> numberOf;
  forEachTextureInfo(kept["material"], [&](Json& parent, const std::string& key) {
    Json& info = parent[key];
    const bool isBaseColor = key == "baseColorTexture" || key == "diffuseTexture";
    try {
      if (texCoordOf(info, place) != texCoords_[index]) {
        otherSets_.insert(key);
        eraseTextureInfo(parent, key);
        return;
      }
      const std::uint64_t texture = *in_.index(info, "index", place + "." + key);
      auto number = numberOf.find(texture);
      if (number == numberOf.end()) {
        std::optional<Json> found = keptTexture(texture, place + "." + key, m);
        if (!found) {
          eraseTextureInfo(parent, key);
          return;
        }
        number = numberOf.emplace(texture, kept["textures"].size()).first;
        kept["textures"].push_back(std::move(*found));
      }
      info["index"] = number->second;
    } catch (const InputError& error) {
      if (isBaseColor) throw;
      warn(source_.warnings, error.what() + std::string("; the map is left out"));
      eraseTextureInfo(parent, key);
      return;
    }
    // The file that is written has one set.
    info.erase("texCoord");
    if (in_.extension(info, "KHR_texture_transform", place))
      info["extensions"]["KHR_texture_transform"].erase("texCoord");
  });
  if (saysNoMore(kept, m, translucent)) {
    m.pictures.clear();
    return;
  }
  std::set<std::string> names;
  addExtensionNames(kept, names);
  if (const Json* required = in_.array(in_.root(), "extensionsRequired", "the file")) {
    for (const Json& name : *required)
      if (name.is_string() && names.contains(name.get<std::string>()))
        kept["required"].push_back(name);
  }
  m.source = std::make_shared<MaterialSource>(
      MaterialSource{MaterialSource::Format::Gltf, jsonText(kept)});
}

std::optional<GltfDocument::Json> GltfMaterials::keptTexture(std::uint64_t texture,
                                                             const std::string& from, Material& m) {
  const std::string at = "textures[" + std::to_string(texture) + "]";
  const Json& json = in_.element("textures", texture, from);
  if (nestsDeeperThan(json, kDeepestJson)) in_.fail(at + " nests too deep");
  Json kept = json;
  bool any = false;
  const auto keep = [&](Json& object, bool core) {
    const auto image = in_.index(object, "source", at);
    object.erase("source");
    const std::uint32_t found = image ? picture(*image, at, core).value_or(kNone) : kNone;
    if (found == kNone) return false;
    const auto same = std::find(m.pictures.begin(), m.pictures.end(), found);
    object["source"] = same - m.pictures.begin();
    if (same == m.pictures.end()) m.pictures.push_back(found);
    return any = true;
  };
  if (const auto sampler = in_.index(json, "sampler", at)) {
    const Json& found = in_.element("samplers", *sampler, at);
    if (nestsDeeperThan(found, kDeepestJson)) in_.fail(at + ".sampler nests too deep");
    kept["sampler"] = found;
  }
  const bool hasCore = keep(kept, true);
  std::vector<std::string> others;
  if (const Json* extensions = in_.object(json, "extensions", at)) {
    for (const auto& item : extensions->items())
      if (item.value().is_object() && item.value().contains("source")) others.push_back(item.key());
  }
  for (const std::string& name : others)
    if (!keep(kept["extensions"][name], false)) kept["extensions"].erase(name);
  if (kept.contains("extensions") && kept["extensions"].empty()) kept.erase("extensions");
  if (any && !hasCore) {
    source_.warn("the picture of " + at +
                 " is neither PNG nor JPEG: it is kept with its material, and not shown");
  }
  if (!any && !json.contains("source") && others.empty())
    source_.warn("the picture of " + at + " is neither PNG nor JPEG and is left out");
  if (!any) return std::nullopt;
  return kept;
}

void GltfMaterials::readSpecularGlossiness(const Json& json, Material& m,
                                           const std::string& place) {
  double color[4];
  if (in_.numbers(json, "diffuseFactor", 4, color, place)) {
    for (int c = 0; c < 4; ++c) m.baseColor[c] = bounded(color[c], 1, place);
  }
  m.metallic = 0;
  m.roughness = 1 - bounded(in_.number(json, "glossinessFactor", 1, place), 1, place);
  if (in_.object(json, "specularGlossinessTexture", place)) m.roughness = Material{}.roughness;
}

void GltfMaterials::warnOfMaterials() const {
  if (otherSets_.empty()) return;
  std::string keys;
  for (const std::string& key : otherSets_) keys += (keys.empty() ? "" : ", ") + key;
  source_.warn("maps with other texture coordinates than the base color's are left out: " + keys);
}

float GltfMaterials::bounded(double value, double most, const std::string& place) const {
  if (value >= 0 && value <= most) return static_cast<float>(value);
  if (!std::isfinite(value)) in_.fail(place + " has a factor that is NaN or infinite");
  source_.warn(place + " has a factor outside of its range, which is taken as the nearest in it");
  return static_cast<float>(std::clamp(value, 0.0, most));
}

std::optional<std::uint32_t> GltfMaterials::readTexture(const Json& info,
                                                        const std::string& place) {
  const auto texture = in_.index(info, "index", place + ".baseColorTexture");
  if (!texture) in_.fail(place + ".baseColorTexture.index is missing");
  const std::string at = "textures[" + std::to_string(*texture) + "]";
  const auto image = in_.index(in_.element("textures", *texture, place), "source", at);
  return image ? picture(*image, at, true) : std::nullopt;
}

std::optional<std::uint32_t> GltfMaterials::picture(std::uint64_t image, const std::string& at,
                                                    bool core) {
  const auto [found, added] = pictureOf_.try_emplace(image);
  if (!added) return found->second;
  std::optional<std::string> bytes = in_.image(image, at);
  const std::string mimeType = !bytes ? "" : core ? imageMimeType(*bytes) : pictureMimeType(*bytes);
  if (mimeType.empty()) {
    source_.warn("the picture " + imageName(image) +
                 (bytes ? " is neither PNG nor JPEG" : " is not found") + " and is left out");
    return std::nullopt;
  }
  found->second = static_cast<std::uint32_t>(mesh_.textures.size());
  mesh_.textures.push_back({textureName(image, mimeType), mimeType, std::move(*bytes)});
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

std::string GltfMaterials::textureName(std::uint64_t image, const std::string& mimeType) {
  const Json& json = in_.element("images", image, "a texture");
  const std::string place = "images[" + std::to_string(image) + "]";
  std::string base = in_.text(json, "name", place);
  const std::string uri = in_.text(json, "uri", place);
  if (base.empty() && !uri.starts_with("data:")) base = uri.substr(uri.find_last_of('/') + 1);
  if (base.empty()) base = "texture" + std::to_string(image);
  const std::string ending = pictureEnding(mimeType);
  if (!base.ends_with(ending) && !base.ends_with(".jpeg")) base += ending;
  std::string unique = base;
  for (int n = 2; !pictureNames_.insert(unique).second; ++n)
    unique = std::to_string(n) + "_" + base;
  return unique;
}

}  // namespace exemplar
