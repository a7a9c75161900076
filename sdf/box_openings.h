// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/vec.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// How far from a face of its box a vertex still counts as in it, in lengths of the box's longest
/// side: turned meshes and files that round are not exact.
inline constexpr double kInBoxFace = 1e-3;

/// The triangles that close openings of a mesh in the faces of its bounding box, as a mesh without
/// attributes: a wall that was modeled without ends, or without a bottom, is solid up to there.
///
/// What closes an opening is bounded by the rim of the mesh in that face and, where the opening
/// goes on in another face, by the edge of the box between the two: a wall without ends and bottom
/// gets both. Rims that leave the box's faces or meet more than two at a point are left open, as
/// are openings that triangles in the face cover, and meshes that are flat. The triangles face any
/// way. Vertices count as in a face within `kInBoxFace`. About O(n log n) for n triangles and
/// O(r^2) for r corners of a rim.
TriangleMesh boxOpenings(const TriangleMesh& mesh);

}  // namespace exemplar
