// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "voxelize/cell_cut.h"

namespace exemplar {

/// What a cell of a cut mesh holds, in a form that does not depend on how it is cut into triangles,
/// in which order these come or how often an edge is divided: for each material and plane the rim
/// of what is covered there, as straight pieces of the greatest length.
class PieceShape {
 public:
  PieceShape() = default;
  /// The shape of cell `cell` (an index, x fastest). Texture coordinates count where a material has
  /// a texture, vertex colors where the mesh has them. Of a cell with more than 4,000 parts every
  /// part counts as it is cut. Cost: mostly O(p) for p parts, O(p²) where all lie in different
  /// planes.
  PieceShape(const TriangleMesh& mesh, const CellCut& cut, std::size_t cell, double tolerance);

  bool empty() const { return rim_.empty(); }
  std::size_t count() const { return rim_.size(); }

  /// Whether two shapes are equal but for `tolerance` cells (and 1/500 in texture coordinates and
  /// colors).
  bool equals(const PieceShape& other, double tolerance) const;

  /// The mirror image across the middle plane of the cell across `axis` (0 or 1).
  PieceShape mirrored(int axis) const;
  /// Turned a quarter counterclockwise about the vertical axis through the cell's middle.
  PieceShape turned() const;

 private:
  using Attributes = std::array<float, 6>;  // u, v, red, green, blue, opacity

  /// A straight piece of a rim; what is covered lies to the left of a -> b, seen from outside.
  struct Edge {
    std::uint32_t material = 0;
    int multiplicity = 1;  // how many sheets, where several lie on each other
    Vec3d a, b;            // in cells from the cell's corner
    Vec3d normal;          // of length 1
    Attributes atA{}, atB{};
    double key() const { return 1.618 * (a.x + b.x) + 2.303 * (a.y + b.y) + 3.142 * (a.z + b.z); }
  };
  struct Plane;

  void finish();
  static bool alike(const Edge& e, const Edge& f, double tolerance);

  std::vector<Edge> rim_;  // by key
  double length_ = 0;      // of the rim
  Vec3d middle_;           // of the rim, weighted by length
};

}  // namespace exemplar
