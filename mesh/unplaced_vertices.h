// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/mesh_formats.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// The vertices of a file whose coordinates cannot be taken, such as NaN. Scanners write them for
/// points that they did not see, which no face uses; they lie at the origin in memory.
class UnplacedVertices {
 public:
  struct Vertex {
    std::size_t index;
    const char* problem;  ///< as `coordinateProblem` has it
    std::int64_t line;
  };

  void add(const Vertex& vertex) { vertices_.push_back(vertex); }

  /// Once the triangles are read: the first one that a triangle uses, null where there is none;
  /// of a file without triangles the first one.
  /// Warns then how many there are. Costs nothing for files without such vertices.
  const Vertex* firstUsed(const TriangleMesh& mesh, const MeshSource& source) const {
    if (vertices_.empty()) return nullptr;
    if (mesh.triangles.empty()) return &vertices_.front();
    std::vector<bool> isUsed(mesh.positions.size(), false);
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t v : triangle) isUsed[v] = true;
    for (const Vertex& vertex : vertices_)
      if (isUsed[vertex.index]) return &vertex;
    source.warn(
        "vertices without a place (NaN, infinite or 1e15 and more), which no face uses, "
        "are left out: " +
        std::to_string(vertices_.size()));
    return nullptr;
  }

 private:
  std::vector<Vertex> vertices_;  ///< in the order of the file
};

}  // namespace exemplar
