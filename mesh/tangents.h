// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "mesh/shading_normals.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A unit vector along which u grows, and 1 or -1: v grows (upwards) along their product with the
/// normal, or against it.
using Tangent = std::array<float, 4>;

/// Tangents, and which of them each corner of each triangle has.
struct CornerTangents {
  std::vector<Tangent> tangents;
  std::vector<std::array<std::uint32_t, 3>> corners;  ///< m triangles: indices, or 0xffffffff
};

/// The tangent space that normal maps are baked in and shaded with: MikkTSpace's default, by its
/// rules (M. S. Mikkelsen, "Simulation of wrinkled surfaces revisited", master's thesis, University
/// of Copenhagen, 2008, and its reference code).
///
/// Corners of equal position, normal and texture coordinate are one vertex. Around it, triangles
/// that meet in edges whose two ends are the same vertices, and that the texture covers with the
/// same side up, share a tangent: the sum of their directions of growing u, in the plane of the
/// normal, weighted by their angles. Triangles that the texture covers with no area join their
/// neighbors; corners that have no tangent by that get one at a right angle to their normal.
///
/// `lookups`: for each material how its normal map is looked up; nothing for materials without,
/// whose corners have none. The mesh has texture coordinates, materials and `normals`. Different
/// from the reference: directions that are opposite to the last digit are added, too. O(n log n);
/// deterministic. Throws `Cancelled`.
CornerTangents cornerTangents(const TriangleMesh& mesh, const ShadingNormals& normals,
                              const std::vector<std::optional<UvTransform>>& lookups,
                              const Progress& progress = {});

}  // namespace exemplar
