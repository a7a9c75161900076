// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A unit normal for each corner of each triangle (m): those that files get (`shadingNormals`), so
/// that pictures show what other programs will.
///
/// Different from there: triangles that are wound the other way than their neighbors are turned
/// round first, so that a soup is smooth, too, and each corner's normal is on its own triangle's
/// side. A corner whose normal would be behind its triangle keeps the facet's. O(m log m); the same
/// at any number of threads. Throws `Cancelled`.
std::vector<std::array<Vec3f, 3>> cornerNormals(const TriangleMesh& mesh, double creaseAngle,
                                                const Progress& progress = {});

}  // namespace exemplar
