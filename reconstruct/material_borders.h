// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// The region (a material, a chart of a texture) at a point of a surface that has this unit normal
/// there, on triangle number `triangle` of the surface before it is cut. Called from many threads.
using RegionAt =
    std::function<std::uint32_t(const Vec3d& point, const Vec3d& normal, std::uint32_t triangle)>;

/// Cuts triangles where the region changes inside them, so that borders run where they are and not
/// along the nearest triangle sides. `region` comes with that of each triangle; near borders they
/// are looked up again, and it leaves with those of the cut triangles.
///
/// New vertices lie on the sides of triangles, and neighbors are cut alike: the surface stays as
/// it is, closed where it was. Borders that pass a vertex at less than a tenth of a side go through
/// it. The mesh has no vertex colors and texture coordinates yet. Returns, for each triangle,
/// which one it was (part of). The same at any number of threads. Throws `Cancelled`.
std::vector<std::uint32_t> cutBorders(TriangleMesh& mesh, std::vector<std::uint32_t>& region,
                                      const RegionAt& regionAt, const Progress& progress = {});

/// The same of materials: `mesh` comes with one for each triangle.
std::vector<std::uint32_t> cutMaterialBorders(TriangleMesh& mesh, const RegionAt& materialAt,
                                              const Progress& progress = {});

/// Gives triangles with two neighbors of one other material that material, `rounds` times: single
/// triangles and teeth along the border between two materials go. Stripes that are two triangles
/// wide stay. O(rounds n); the same at any number of threads.
void cleanMaterialBorders(TriangleMesh& mesh, int rounds);

}  // namespace exemplar
