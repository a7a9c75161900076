// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "mesh/image.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// The chart each triangle of a textured mesh belongs to: triangles are in one chart where they
/// share an edge by position and the texture coordinates at both of its ends, and have one
/// material. Numbered by lowest triangle, from 0. O(n log n).
std::vector<std::uint32_t> textureCharts(const TriangleMesh& mesh);

/// The texture coordinates at barycentric weights of a triangle.
Vec2f textureCoordinates(const TriangleMesh& mesh, std::uint32_t triangle,
                         const std::array<double, 3>& weights);

/// The base color (linear RGBA) of a mesh's surface: its material's, times its texture's, times
/// its vertices'.
class SurfaceColor {
 public:
  /// Decodes the textures; throws `InputError` where one cannot be. Borrows the mesh.
  explicit SurfaceColor(const TriangleMesh& mesh);

  std::array<float, 4> at(std::uint32_t triangle, const std::array<double, 3>& weights) const;

 private:
  const TriangleMesh& mesh_;
  std::vector<Image8> images_;  ///< one a texture; empty for unused ones
};

/// The vertex color alone; white where the mesh has none.
std::array<float, 4> vertexColor(const TriangleMesh& mesh, std::uint32_t triangle,
                                 const std::array<double, 3>& weights);

}  // namespace exemplar
