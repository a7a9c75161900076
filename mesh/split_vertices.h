// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "mesh/shading_normals.h"
#include "mesh/tangents.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// The vertices of a file that has one normal, one texture coordinate, one tangent and one source
/// for each vertex: those of the mesh, in their order, and behind them copies of the ones that need
/// several.
struct SplitVertices {
  std::vector<std::uint32_t> source;  ///< each one's vertex in the mesh
  std::size_t originals = 0;          ///< vertices before the first copy
  std::vector<Vec2f> uvs;             ///< as many, or none
  std::vector<Vec3f> normals;         ///< as many, or none
  std::vector<Tangent> tangents;      ///< as many, or none
  std::vector<SourcePoint> points;    ///< as many, or none
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct SplitOptions {
  bool uvs = true;          ///< split where texture coordinates differ
  bool sources = false;     ///< split where a mesh's `sources` differ
  bool keepUnused = false;  ///< vertices that no triangle uses; their normal points up
};

/// `normals` and `tangents` may be empty. Deterministic; O(n). Throws `Cancelled`.
SplitVertices splitVertices(const TriangleMesh& mesh, const ShadingNormals& normals,
                            const CornerTangents& tangents = {}, const SplitOptions& options = {},
                            const Progress& progress = {});

}  // namespace exemplar
