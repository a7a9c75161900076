// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <vector>

#include "core/vec.h"
#include "core/warnings.h"
#include "mesh/image.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A decoded color texture. Opacity is left out.
class ColorTexture {
 public:
  /// Throws `InputError` where it cannot be decoded.
  explicit ColorTexture(const Texture& texture);

  /// Linear RGB at `uv`, v up, repeating; bilinear between texel centers. Not-finite coordinates
  /// read as (0, 0).
  Vec3f at(const Vec2f& uv) const;

 private:
  Vec3f texel(int x, int y) const;

  Image8 image_;
};

/// The base-color textures that triangles of a mesh have, by their index in `mesh.textures`; null
/// where none does, and where one cannot be decoded, which is a line in `warnings` (may be null).
std::vector<std::unique_ptr<ColorTexture>> colorTextures(const TriangleMesh& mesh,
                                                         Warnings* warnings);

}  // namespace exemplar
