// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/pull.h"
#include "reconstruct/transfer.h"
#include "reconstruct/triangle_sources.h"

namespace exemplar {

// For surfaces that keep the example's textures: each triangle has the material and the texture
// coordinates of one place of the example. The same bytes at any number of threads; both throw
// `Cancelled`.

/// Gives every triangle a material where the example has some, with borders between materials and
/// between charts where the example has them; `charts` of the example's triangles
/// (`textureCharts`). Borders of charts that are a voxel or two wide are left along triangle sides.
/// `sources` follow: a piece of a cut triangle comes from where its triangle did, but from a
/// triangle of its chart.
void transferTriangleMaterials(TriangleMesh& result, const OriginPullView& pull,
                               const ExampleAttributes& attributes,
                               std::span<const ExampleView> examples,
                               const std::vector<std::uint32_t>& charts,
                               const TransferOptions& options, const Progress& progress,
                               TriangleSources& sources);

/// Gives each corner texture coordinates, looked up where the triangle's motion takes it but inside
/// the chart of the triangle's middle; with `keepSources` the place of the example, too.
/// `normals`: a unit normal per vertex; `charts` of the example's triangles.
void transferCoordinates(TriangleMesh& result, const std::vector<Vec3d>& normals,
                         const OriginPullView& pull, const ExampleAttributes& attributes,
                         std::span<const ExampleView> examples,
                         const std::vector<std::uint32_t>& charts, bool keepSources,
                         const Progress& progress, TriangleSources sources);

/// Gives each corner the place of the example where its triangle's motion takes it, for surfaces
/// without texture coordinates. Each triangle has a source.
void transferSources(TriangleMesh& result, const std::vector<Vec3d>& normals,
                     const OriginPullView& pull, const TriangleSources& sources,
                     const ExampleAttributes& attributes, const Progress& progress);

}  // namespace exemplar
