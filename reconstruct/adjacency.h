// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/disjoint_sets.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Which triangle side is opposite which: connectivity of indexed triangles without a halfedge
/// mesh, for any soup. Halfedge 3 t + c runs from corner c of triangle t to its next corner.

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

inline std::uint32_t nextHalfedge(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::uint32_t previousHalfedge(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
inline std::uint32_t fromVertex(const Triangles& triangles, std::uint32_t h) {
  return triangles[h / 3][h % 3];
}
inline std::uint32_t toVertex(const Triangles& triangles, std::uint32_t h) {
  return triangles[h / 3][nextHalfedge(h) % 3];
}
inline std::uint32_t apexVertex(const Triangles& triangles, std::uint32_t h) {
  return triangles[h / 3][previousHalfedge(h) % 3];
}

/// The halfedges of each edge, edges in order of their lower, then their higher vertex, halfedges
/// of one edge in ascending order. Linear but for the sort of each vertex's few edges.
struct EdgeGroups {
  std::vector<std::uint32_t> halfedges;
  std::vector<std::uint32_t> begin;  ///< group e is [begin[e], begin[e + 1])

  std::size_t count() const { return begin.empty() ? 0 : begin.size() - 1; }
  std::span<const std::uint32_t> group(std::size_t e) const {
    return {halfedges.data() + begin[e], begin[e + 1] - begin[e]};
  }
};
EdgeGroups edgeGroups(const Triangles& triangles, std::size_t vertices);

/// The halfedge that runs the other way, for edges with exactly two triangles that run through it
/// in opposite directions; `kNone` for all others.
std::vector<std::uint32_t> mateHalfedges(const Triangles& triangles, std::size_t vertices);

/// The corners (3 t + c) that are joined across the edges between mates: each set is one fan of
/// triangles around a vertex.
DisjointSets cornerFans(const std::vector<std::uint32_t>& mates);

/// The corners (3 t + c) at each vertex, ascending: vertex v's are [begin[v], begin[v + 1]).
struct VertexCorners {
  std::vector<std::uint32_t> corners, begin;

  std::span<const std::uint32_t> at(std::size_t v) const {
    return {corners.data() + begin[v], begin[v + 1] - begin[v]};
  }
};
VertexCorners vertexCorners(const Triangles& triangles, std::size_t vertices);

/// The connected part each vertex belongs to, by shared vertices: numbered by its lowest vertex in
/// ascending order.
std::vector<std::uint32_t> vertexComponents(const Triangles& triangles, std::size_t vertices,
                                            std::uint32_t* count = nullptr);

/// Drops the triangles for which `keep` is 0, and every vertex that no triangle uses then; the
/// order of what remains is kept.
void keepTriangles(TriangleMesh& mesh, std::span<const std::uint8_t> keep);

/// Cuts triangle `t` at those of its sides that have a new vertex, `middle[c]` on the side from
/// corner c to the next (`kNone`: none): the first piece takes its place, the others, one a new
/// vertex, are added at the end, with its material; texture coordinates as for vertices halfway.
void cutTriangle(TriangleMesh& mesh, std::uint32_t t, const std::array<std::uint32_t, 3>& middle);

/// The mean of a triangle's corners.
inline Vec3d triangleMiddle(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
}

/// The sum of the triangles' area normals at each vertex, not normalized.
std::vector<Vec3d> vertexNormals(const TriangleMesh& mesh, const VertexCorners& corners);

}  // namespace exemplar
