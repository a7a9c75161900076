// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A surface in smaller triangles, and where each of them lies in the ones it was cut from.
struct Subdivided {
  TriangleMesh mesh;                   ///< the shape alone, without attributes
  std::vector<std::uint32_t> parents;  ///< for each triangle the one that it is part of
  /// For each triangle's corners their barycentric coordinates in the parent.
  std::vector<std::array<std::array<double, 3>, 3>> weights;
};

/// Cuts triangles until no edge is longer than `longest` (world units, > 0): the longest edge in
/// its middle, again and again (M.-C. Rivara, 1984). Triangles that share an edge are cut alike
/// there, so that what was closed stays closed. Nothing where that makes more than `most`
/// triangles. O(result).
std::optional<Subdivided> subdivide(const TriangleMesh& mesh, double longest, std::int64_t most);

}  // namespace exemplar
