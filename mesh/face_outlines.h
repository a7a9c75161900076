// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "mesh/mesh_file.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A corner of a triangle.
struct TriangleCorner {
  std::uint32_t triangle = 0;
  int corner = 0;
};

/// The faces of a mesh whose triangles are parts of flat polygons: runs of triangles with equal
/// numbers in `faces` (one for each triangle), as the corners of their outline. A run whose outline
/// is not one loop (it has a hole, or touches itself) or has more than `mostCorners` corners
/// becomes several polygons without holes, of as many triangles as fit. With no `faces`, all are
/// triangles.
std::vector<std::vector<TriangleCorner>> faceOutlines(const TriangleMesh& mesh,
                                                      std::span<const std::uint32_t> faces,
                                                      std::size_t mostCorners);

/// `writeMesh`, with flat faces as polygons in .obj, .ply and .off; other formats have triangles
/// only.
void writePolygons(const std::filesystem::path& path, const TriangleMesh& mesh,
                   std::span<const std::uint32_t> faces, const MeshFileOptions& options = {},
                   const Progress& progress = {});

}  // namespace exemplar
