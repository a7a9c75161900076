// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/progress.h"
#include "synth/continuous/mesh_parts.h"

namespace exemplar::continuous {

/// The largest distance from points of one surface to the other, both ways: of the union of parts,
/// and of a closed mesh. Points are taken on triangles at distances of about `spacing`, at most
/// some hundred a triangle; those of parts that are inside another part do not count. O(points x
/// triangles), in parallel. Throws `Cancelled`.
double surfaceDistance(std::span<const MeshPart> parts, const TriangleMesh& mesh, double spacing,
                       const Progress& progress = {});

}  // namespace exemplar::continuous
