// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/paints.h"

#include <array>

namespace exemplar {
namespace {

constexpr Paint kClay{{0.50f, 0.455f, 0.405f}, 0, 0.65f, {}};

}  // namespace

Paints::Paints(const TriangleMesh& mesh, Warnings* warnings)
    : mesh_(mesh), textures_(colorTextures(mesh, warnings)) {}

Paint Paints::at(std::uint32_t triangle, float u, float v) const {
  const std::array<float, 3> share{1 - u - v, u, v};
  Paint paint = kClay;
  if (mesh_.hasMaterials()) {
    const Material& m = mesh_.materials[mesh_.triangleMaterials[triangle]];
    paint = {{m.baseColor[0], m.baseColor[1], m.baseColor[2]}, m.metallic, m.roughness, m.emission};
    if (m.baseColorTexture && mesh_.hasUvs() && textures_[*m.baseColorTexture]) {
      Vec2f at{};
      for (int c = 0; c < 3; ++c) {
        at.x += mesh_.uvs[triangle][c].x * share[c];
        at.y += mesh_.uvs[triangle][c].y * share[c];
      }
      paint.color =
          scaled(paint.color, textures_[*m.baseColorTexture]->at(m.baseColorTransform.apply(at)));
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
