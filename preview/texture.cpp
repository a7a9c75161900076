// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/texture.h"

#include <cmath>

#include "core/error.h"
#include "mesh/color.h"

namespace exemplar {
namespace {

// The texels on both sides of coordinate t, and how far toward the second.
struct Between {
  int first, second;
  float share;
};

Between between(float t, int size) {
  const float wrapped = t - std::floor(t);  // 0..1; 1 only by rounding
  const float place = wrapped * static_cast<float>(size) - 0.5f;
  const float below = std::floor(place);
  const int first = (static_cast<int>(below) + size) % size;
  return {first, (first + 1) % size, place - below};
}

}  // namespace

ColorTexture::ColorTexture(const Texture& texture)
    : image_(decodeImage(texture.bytes, texture.name)) {}

Vec3f ColorTexture::texel(int x, int y) const {
  const std::uint8_t* p = image_.at(x, y);
  if (image_.channels < 3) {
    const float gray = srgb8ToLinear(p[0]);
    return {gray, gray, gray};
  }
  return {srgb8ToLinear(p[0]), srgb8ToLinear(p[1]), srgb8ToLinear(p[2])};
}

Vec3f ColorTexture::at(const Vec2f& uv) const {
  const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
  const Between x = between(finite ? uv.x : 0, image_.width);
  const Between y = between(finite ? -uv.y : 0, image_.height);  // rows come from the top
  const Vec3f upper = texel(x.first, y.first) * (1 - x.share) + texel(x.second, y.first) * x.share;
  const Vec3f lower =
      texel(x.first, y.second) * (1 - x.share) + texel(x.second, y.second) * x.share;
  return upper * (1 - y.share) + lower * y.share;
}

std::vector<std::unique_ptr<ColorTexture>> colorTextures(const TriangleMesh& mesh,
                                                         Warnings* warnings) {
  std::vector<std::unique_ptr<ColorTexture>> textures(mesh.textures.size());
  std::vector<bool> isUsed(mesh.textures.size(), false);
  for (const std::uint32_t m : mesh.triangleMaterials)
    if (const auto& t = mesh.materials[m].baseColorTexture) isUsed[*t] = true;
  for (std::size_t t = 0; t < textures.size(); ++t) {
    if (!isUsed[t]) continue;
    try {
      textures[t] = std::make_unique<ColorTexture>(mesh.textures[t]);
    } catch (const InputError& error) {
      warn(warnings,
           std::string(error.what()) + "; pictures show its materials in their base color alone");
    }
  }
  return textures;
}

}  // namespace exemplar
