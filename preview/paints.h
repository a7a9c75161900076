// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/vec.h"
#include "mesh/triangle_mesh.h"
#include "preview/texture.h"

namespace exemplar {

/// What a surface does with light, at one point.
struct Paint {
  Vec3f color;  ///< linear
  float metallic = 0, roughness = 0;
  Vec3f emission{};
};

/// What a mesh is made of: materials with their textures, times vertex colors; warm gray clay
/// where it has neither.
class Paints {
 public:
  /// Keeps a reference to `mesh`. A texture that cannot be decoded is left out, with a line in
  /// `warnings` (may be null).
  Paints(const TriangleMesh& mesh, Warnings* warnings);

  /// At the point (1 - u - v, u, v) of a triangle.
  Paint at(std::uint32_t triangle, float u, float v) const;

 private:
  const TriangleMesh& mesh_;
  std::vector<std::unique_ptr<ColorTexture>> textures_;
};

}  // namespace exemplar
