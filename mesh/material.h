// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/vec.h"

namespace exemplar {

/// A picture that materials refer to, kept as the file's own bytes so that it leaves as it came.
struct Texture {
  std::string name;      ///< file name or a name of its own; unique within a mesh
  std::string mimeType;  ///< "image/png" or "image/jpeg", which can be decoded, or another one
  std::string bytes;     ///< the encoded file; decode with `decodeImage`
};

/// Where on a picture a texture coordinate is looked up: scaled, then turned, then moved
/// (KHR_texture_transform, whose v runs down).
struct UvTransform {
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double rotation = 0;  ///< radians, counterclockwise as seen on the picture

  bool isIdentity() const { return *this == UvTransform{}; }
  /// The place for a texture coordinate, both with v up.
  Vec2f apply(const Vec2f& uv) const {
    if (isIdentity()) return uv;
    const double c = std::cos(rotation), s = std::sin(rotation);
    const double u = uv.x * scale[0], v = (1.0 - uv.y) * scale[1];
    return {static_cast<float>(offset[0] + c * u + s * v),
            static_cast<float>(1 - (offset[1] - s * u + c * v))};
  }
  bool operator==(const UvTransform&) const = default;
};

/// All that a file says of a material, so that a file of the same kind gets it back.
struct MaterialSource {
  enum class Format {
    /// JSON: {"material": as in the file, "textures": with their samplers and pictures in place of
    /// indices, "required": names of extensions}. Texture infos name those textures.
    Gltf,
    /// The lines behind `newmtl`. A picture's name is replaced by '\x7f' and its number.
    Mtl,
  };
  Format format = Format::Gltf;
  std::string text;  ///< pictures are numbers of `Material::pictures`

  bool operator==(const MaterialSource&) const = default;
};

/// How a surface looks: the core of glTF 2.0's metallic-roughness model, and, opaque, all that the
/// file said of it.
struct Material {
  std::string name;
  std::array<float, 4> baseColor{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGB and opacity, 0..1
  float metallic = 0.0f;                                   ///< 0 dielectric .. 1 metal
  float roughness = 0.8f;                                  ///< 0 mirror .. 1 chalk
  Vec3f emission{};                                        ///< linear RGB, 0..
  std::optional<std::uint32_t> baseColorTexture;           ///< index into `TriangleMesh::textures`
  UvTransform baseColorTransform;                          ///< how that one is looked up

  /// What the file said, or null. Files of its kind are given this rather than the members above:
  /// whoever changes those drops it.
  std::shared_ptr<const MaterialSource> source = nullptr;
  std::vector<std::uint32_t> pictures =
      {};  ///< its pictures, indices into `TriangleMesh::textures`

  bool hasTextures() const { return baseColorTexture || !pictures.empty(); }

  bool operator==(const Material& m) const {
    const auto fields = [](const Material& a) {
      return std::tie(a.name, a.baseColor, a.metallic, a.roughness, a.emission, a.baseColorTexture,
                      a.baseColorTransform, a.pictures);
    };
    const bool sameSource = source == m.source || (source && m.source && *source == *m.source);
    return sameSource && fields(*this) == fields(m);
  }
};

}  // namespace exemplar
