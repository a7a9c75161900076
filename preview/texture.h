// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/vec.h"
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

}  // namespace exemplar
