// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

struct DecimateOptions {
  /// Edges are collapsed while the surface stays within about this distance of where it was, world
  /// units, >= 0.
  double error = 0;
  /// Stop at this many triangles; 0: go as far as `error` allows. Where this is far below what the
  /// shape needs, triangles become slender and turn far rather than remain.
  std::int64_t triangles = 0;
  /// Vertices in the faces of this box stay in them, and its edges stay sharp.
  std::optional<Box3d> box;
};

/// Merges triangles where the surface is flat: OpenMesh's decimater with quadric errors (Garland,
/// Heckbert: "Surface simplification using quadric error metrics", SIGGRAPH 1997,
/// doi:10.1145/258734.258849), without turning triangles over.
///
/// For meshes without attributes that are manifold (`fieldToMesh` makes them so; it is what one
/// does before `transferAppearance`). They stay closed and manifold. O(n log n). Throws
/// `InputError` for options out of range and for meshes that carry attributes, and `Cancelled`.
void decimate(TriangleMesh& mesh, const DecimateOptions& options, const Progress& progress = {});

}  // namespace exemplar
