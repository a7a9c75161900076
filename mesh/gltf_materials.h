// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/gltf_document.h"

namespace exemplar {

/// How a material's base-color texture is looked up.
struct GltfTextureUse {
  std::uint64_t texCoord = 0;
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double rotation = 0;

  /// The texture coordinate, v up, for one in the file, v down (KHR_texture_transform turns
  /// counterclockwise as seen on the picture).
  Vec2f apply(double u, double v) const {
    const double c = std::cos(rotation), s = std::sin(rotation);
    const double scaledU = u * scale[0], scaledV = v * scale[1];
    return {static_cast<float>(offset[0] + c * scaledU + s * scaledV),
            static_cast<float>(1 - (offset[1] - s * scaledU + c * scaledV))};
  }
};

/// Reads the materials of a glTF document and their base-color textures into a mesh. What
/// `Material` cannot hold is named in warnings once: maps, whose factors are then left out, too,
/// and extensions.
class GltfMaterials {
 public:
  /// All must outlive this.
  GltfMaterials(GltfDocument& document, const MeshSource& source, TriangleMesh& mesh)
      : in_(document),
        source_(source),
        mesh_(mesh),
        materialUsed_(document.count("materials"), false),
        textureUses_(document.count("materials")) {}

  /// Marks a material as used and finds out how its texture is looked up.
  void use(std::uint64_t index, const std::string& at);
  /// Keeps the materials that the mesh's triangles name (by their index in the document, or
  /// 0xffffffff for none), in the order of the file; the standard's default one
  /// comes last, for triangles without any.
  void finish();
  /// How a used material's texture is looked up.
  const GltfTextureUse& textureUse(std::uint64_t material) const { return textureUses_[material]; }

 private:
  using Json = GltfDocument::Json;

  /// The older model of a material, where it has that one (KHR_materials_pbrSpecularGlossiness)
  /// and not the standard's beside it.
  const Json* specularGlossiness(const Json& material, const std::string& place) const;
  const Json* baseColorTexture(const Json& material, const std::string& place) const;
  /// Whether the only material is the one that `formatGlb` gives a mesh without materials.
  bool isPlaceholder(const std::vector<bool>& isUsed) const;
  Material readMaterial(std::uint64_t index);
  /// The diffuse color; a specular color has no place here, gloss becomes roughness.
  void readSpecularGlossiness(const Json& json, Material& m, const std::string& place);
  /// Whether a material has a map that is not read.
  bool hasUnreadMap(const Json& json, const char* key, const std::string& place);
  void noteExtensions(const Json& material, const std::string& place);
  void warnOfMaterials() const;
  float bounded(double value, double most, const std::string& place) const;
  /// The texture that a material refers to; none, and a warning, where its picture is missing or no
  /// PNG or JPEG.
  std::optional<std::uint32_t> readTexture(const Json& info, const std::string& place);
  /// What messages call a picture.
  std::string imageName(std::uint64_t image) const;
  std::string textureName(std::uint64_t image, const std::string& mimeType) const;

  GltfDocument& in_;
  const MeshSource& source_;
  TriangleMesh& mesh_;
  std::vector<bool> materialUsed_;
  std::vector<GltfTextureUse> textureUses_;
  std::map<std::uint64_t, std::optional<std::uint32_t>> textureOf_;
  std::set<std::string> unreadMaps_, unreadExtensions_;
};

}  // namespace exemplar
