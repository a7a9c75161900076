// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mesh/gltf_document.h"

namespace exemplar {

/// Reads the materials of a glTF document into a mesh: what `Material` has a member for, the
/// base-color texture among it, and as its source all that the file says, with all of its pictures.
/// What cannot be kept is named in warnings once, and factors of maps that are not there are left
/// out with them.
class GltfMaterials {
 public:
  /// All must outlive this.
  GltfMaterials(GltfDocument& document, const MeshSource& source, TriangleMesh& mesh)
      : in_(document),
        source_(source),
        mesh_(mesh),
        materialUsed_(document.count("materials"), false),
        texCoords_(document.count("materials"), 0) {}

  /// Marks a material as used and finds out which texture coordinates it has.
  void use(std::uint64_t index, const std::string& at);
  /// Keeps the materials that the mesh's triangles name (by their index in the document, or
  /// 0xffffffff for none), in the order of the file; the standard's default one
  /// comes last, for triangles without any.
  void finish();
  /// The set of texture coordinates of a used material: its base-color texture's, or, where it has
  /// none, its first texture's.
  std::uint64_t texCoord(std::uint64_t material) const { return texCoords_[material]; }

 private:
  using Json = GltfDocument::Json;

  /// The older model of a material, where it has that one (KHR_materials_pbrSpecularGlossiness)
  /// and not the standard's beside it.
  const Json* specularGlossiness(const Json& material, const std::string& place) const;
  const Json* baseColorTexture(const Json& material, const std::string& place) const;
  /// Which texture coordinates a texture info asks for; its transform may say so, too.
  std::uint64_t texCoordOf(const Json& info, const std::string& place) const;
  UvTransform transformOf(const Json& info, const std::string& place) const;
  /// Whether the only material is the one that `formatGlb` gives a mesh without materials.
  bool isPlaceholder(const std::vector<bool>& isUsed) const;
  /// `translucent`: vertices of its triangles have opacities below 1.
  Material readMaterial(std::uint64_t index, bool translucent);
  /// The diffuse color; a specular color has no place here, gloss becomes roughness.
  void readSpecularGlossiness(const Json& json, Material& m, const std::string& place);
  /// Gives a material what the file says of it beyond its members.
  void keepSource(std::uint64_t index, const Json& json, bool translucent, Material& m);
  /// A texture with its sampler, its pictures by their number in `m`; nothing where it has none.
  std::optional<Json> keptTexture(std::uint64_t texture, const std::string& from, Material& m);
  void warnOfMaterials() const;
  float bounded(double value, double most, const std::string& place) const;
  /// The picture that a texture shows; none, and a warning, where it is missing or no PNG or JPEG.
  std::optional<std::uint32_t> readTexture(const Json& info, const std::string& place);
  /// A picture in the mesh; `core` ones are PNG or JPEG, those of extensions of other kinds.
  std::optional<std::uint32_t> picture(std::uint64_t image, const std::string& at, bool core);
  /// What messages call a picture.
  std::string imageName(std::uint64_t image) const;
  std::string textureName(std::uint64_t image, const std::string& mimeType);

  GltfDocument& in_;
  const MeshSource& source_;
  TriangleMesh& mesh_;
  std::vector<bool> materialUsed_;
  std::vector<std::uint64_t> texCoords_;
  std::map<std::uint64_t, std::optional<std::uint32_t>> pictureOf_;  // by image
  std::set<std::string> pictureNames_;
  std::set<std::string> otherSets_;  // maps that have texture coordinates of their own
};

}  // namespace exemplar
