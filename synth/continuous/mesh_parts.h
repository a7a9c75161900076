// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.h"

/// The parts of which a mesh is put together, each made a solid of its own.
namespace exemplar::continuous {

/// A triangle of a part.
struct PartTriangle {
  static constexpr std::uint32_t kCap = 0xFFFFFFFF;
  std::array<std::uint32_t, 3> ids{};  ///< equal where corners are, within the distance of welding
  std::array<Vec3d, 3> corners{};
  std::uint32_t origin = kCap;  ///< the triangle of the mesh, or one that closes an opening
};

/// Triangles that hang together, oriented alike, outward, with their openings closed.
struct MeshPart {
  std::vector<PartTriangle> triangles;
  std::uint32_t material = 0;  ///< that most of its surface has
  double volume = 0;
  Box3d box;
};

struct MeshParts {
  std::vector<MeshPart> parts;  ///< in the order of their first triangles
  std::size_t openings = 0;     ///< that were closed
  std::size_t sheets = 0;       ///< parts without volume, left out
};

/// The parts of a mesh, kit parts united in one file, say: triangles that share edges, or vertices
/// where they are of one material. Vertices nearer than about `weld` are one. Faces that are not
/// oriented alike are turned; openings are closed by polygons over their borders. Deterministic.
MeshParts partsOf(const TriangleMesh& mesh, double weld);

/// How often a part's surface winds around a point (Jacobson, Kavan, Sorkine-Hornung: "Robust
/// Inside-Outside Segmentation using Generalized Winding Numbers", 2013).
double windingNumber(const MeshPart& part, const Vec3d& p);

}  // namespace exemplar::continuous
