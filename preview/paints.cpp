// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/paints.h"

#include <array>

namespace exemplar {
namespace {

constexpr Paint kClay{{0.50f, 0.455f, 0.405f}, 0, 0.65f, {}};

}  // namespace

Paints::Paints(const TriangleMesh& mesh) : mesh_(mesh) {
  textures_.resize(mesh.textures.size());
  for (const std::uint32_t m : mesh.triangleMaterials)
    if (const auto& t = mesh.materials[m].baseColorTexture; t && !textures_[*t])
      textures_[*t] = std::make_unique<ColorTexture>(mesh.textures[*t]);
}

Paint Paints::at(std::uint32_t triangle, float u, float v) const {
  const std::array<float, 3> share{1 - u - v, u, v};
  Paint paint = kClay;
  if (mesh_.hasMaterials()) {
    const Material& m = mesh_.materials[mesh_.triangleMaterials[triangle]];
    paint = {{m.baseColor[0], m.baseColor[1], m.baseColor[2]}, m.metallic, m.roughness, m.emission};
    if (m.baseColorTexture && mesh_.hasUvs()) {
      Vec2f at{};
      for (int c = 0; c < 3; ++c) {
        at.x += mesh_.uvs[triangle][c].x * share[c];
        at.y += mesh_.uvs[triangle][c].y * share[c];
      }
      paint.color = scaled(paint.color, textures_[*m.baseColorTexture]->at(at));
    }
  } else if (mesh_.hasColors()) {
    paint.color = {1, 1, 1};
  }
  if (mesh_.hasColors()) {
    Vec3f color{};
    for (int c = 0; c < 3; ++c) {
      const auto& rgba = mesh_.colors[mesh_.triangles[triangle][c]];
      color += Vec3f{rgba[0], rgba[1], rgba[2]} * share[c];
    }
    paint.color = scaled(paint.color, color);
  }
  return paint;
}

}  // namespace exemplar
