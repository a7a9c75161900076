// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/array3d.h"
#include "voxelize/field_blocks.h"

namespace exemplar {

/// The adjacency of blocks that overlap: along each axis that has several blocks, which may be a
/// stride apart. `values` is the field that they were cut from, in voxels and truncated; of
/// `blocks` all but the adjacency is there. First blocks of labels are compared, each pair whose
/// shared samples agree on average: O(labels² × shared samples) at worst. Deterministic; parallel.
Adjacency overlapAdjacency(const Array3D<float>& values, const FieldBlocks& blocks,
                           const Progress& progress = {});

}  // namespace exemplar
