// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// The number of pairs of triangles that have no vertex in common and cross (`trianglesCross`).
/// About O(n log n) for n triangles of a surface; the same at any number of threads. Throws
/// `Cancelled`.
std::int64_t countSelfIntersections(const TriangleMesh& mesh, const Progress& progress = {});

}  // namespace exemplar
