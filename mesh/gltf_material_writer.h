// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// What a glTF document says of a material that has no source: without the index of its texture.
/// `translucent`: vertices of its triangles have opacities below 1.
nlohmann::ordered_json plainGltfMaterial(const Material& material, bool translucent);

/// How the normal map of a material is looked up, or a map of its coat or grain that needs tangents
/// as well; nothing where it has none.
std::optional<UvTransform> normalMapLookup(const Material& material);

/// The materials of a glTF document that is written, with their textures, samplers and pictures:
/// those that came from glTF as they came, those of a `.mtl` with what glTF has a place for.
class GltfMaterialWriter {
 public:
  using Json = nlohmann::ordered_json;

  /// `addView` adds a picture's bytes to the document and returns their view. Both outlive this.
  GltfMaterialWriter(const TriangleMesh& mesh, std::function<int(const std::string&)> addView)
      : mesh_(mesh), addView_(std::move(addView)) {}

  /// Adds a material; one without texture coordinates is written without its textures.
  void add(const Material& material, bool translucent);
  /// Marks the last one as standing for no material at all.
  void markPlaceholder() { materials_.back()["extras"] = {{"exemplarPlaceholder", true}}; }
  /// Puts all of them into the document.
  void finish(Json& document);

 private:
  Json asItCame(const Material& material);
  Json fromMembers(const Material& material, bool translucent);
  /// What a `.mtl` says of maps that glTF has, too.
  void addMtlMaps(const Material& material, Json& json);
  /// The index of a texture in the document, equal ones once.
  std::size_t textureOf(Json texture);
  std::size_t textureShowing(std::uint32_t picture) { return textureOf({{"source", picture}}); }
  std::size_t imageOf(std::uint32_t picture);

  const TriangleMesh& mesh_;
  std::function<int(const std::string&)> addView_;
  Json materials_ = Json::array(), textures_ = Json::array(), images_ = Json::array(),
       samplers_ = Json::array();
  std::map<std::string, std::size_t> textureNumbers_, samplerNumbers_;
  std::map<std::uint32_t, std::size_t> imageNumbers_;
  std::set<std::string> required_;
};

}  // namespace exemplar
