// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "reconstruct/pull.h"
#include "reconstruct/transfer.h"
#include "reconstruct/triangle_sources.h"

namespace exemplar {

/// Gives every triangle of `result` a material, by pieces: what was copied in one motion and has
/// one material keeps together, and where pieces meet, the material changes only where at least one
/// side has such a border itself (`settleMaterials`). Triangles without a source (where a box cuts
/// solid) take what is beside them, or else the nearest material of the example.
///
/// `sources` come from matches within `kFarthestSource`; `voxelSize` is that of the result's field.
/// Adds vertices where `options.cutBorders`. The same bytes at any number of threads. Throws
/// `Cancelled`.
void transferPieceMaterials(TriangleMesh& result, const OriginPullView& pull,
                            const ExampleAttributes& attributes,
                            std::span<const ExampleView> examples, double voxelSize,
                            const TransferOptions& options, const TriangleSources& sources,
                            const Progress& progress);

}  // namespace exemplar
