// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

/// What is common to all parts of a glTF document, extensions that nobody here knows included. For
/// `nlohmann::json` and `nlohmann::ordered_json`.
namespace exemplar {

/// Deeper JSON is not copied: copying recurs.
inline constexpr int kDeepestJson = 64;

template <class Json>
bool nestsDeeperThan(const Json& json, int levels) {
  if (!json.is_structured()) return false;
  if (levels == 0) return true;
  for (const auto& item : json)
    if (nestsDeeperThan(item, levels - 1)) return true;
  return false;
}

/// Whether a member of a material says which texture is used for something: all of the standard's
/// and of its extensions' do so by their name.
template <class Json>
bool isTextureInfo(std::string_view key, const Json& member) {
  if (!key.ends_with("Texture") && !key.ends_with("texture")) return false;
  const auto index = member.is_object() ? member.find("index") : member.end();
  return member.is_object() && index != member.end() && index->is_number();
}

/// Calls `body(parent, key)` for each texture that a material refers to; it may erase that member.
template <class Json, class Body>
void forEachTextureInfo(Json& json, const Body& body) {
  if (json.is_array()) {
    for (auto& item : json) forEachTextureInfo(item, body);
    return;
  }
  if (!json.is_object()) return;
  std::vector<std::string> keys;
  for (const auto& item : json.items()) keys.push_back(item.key());
  for (const std::string& key : keys) {
    auto& member = json[key];
    if (isTextureInfo(key, member)) {
      body(json, key);
    } else if (key != "extras") {
      forEachTextureInfo(member, body);
    }
  }
}

/// Takes a texture away from the part of a material that refers to it, and what would be wrong
/// without it: a factor that multiplies a map must not make all of a surface metal, or glow.
template <class Json>
void eraseTextureInfo(Json& parent, const std::string& key) {
  parent.erase(key);
  if (key == "metallicRoughnessTexture") {
    parent["metallicFactor"] = 0;
    parent["roughnessFactor"] = 0.8;
  } else if (key == "emissiveTexture") {
    parent.erase("emissiveFactor");
  } else if (key == "specularGlossinessTexture") {
    parent["glossinessFactor"] = 0.2;
  }
}

/// The names of all extensions that have something to say in a part of a document.
template <class Json>
void addExtensionNames(const Json& json, std::set<std::string>& names) {
  if (!json.is_structured()) return;
  if (json.is_object()) {
    if (const auto extensions = json.find("extensions");
        extensions != json.end() && extensions->is_object())
      for (const auto& item : extensions->items()) names.insert(item.key());
    for (const auto& item : json.items())
      if (item.key() != "extras") addExtensionNames(item.value(), names);
    return;
  }
  for (const auto& item : json) addExtensionNames(item, names);
}

}  // namespace exemplar
