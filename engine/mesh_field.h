// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "engine/example.h"

/// A mesh as distances: how it lies, where it goes on past its box, how finely it is sampled.
namespace exemplar {

/// Samples `mesh` for the example, whose reading options are set: turns it straight, finds along
/// which axes it goes on, takes the resolution that holds its detail where that is asked for, and
/// says what is lost where not. Fills the example's data, mesh, hints, padding, turn and `goesOn`.
void sampleMesh(TriangleMesh mesh, Example& example, const Progress& progress);

/// The field of an example's mesh in a box with other voxels, cut along the axes where it goes on.
DistanceField sampledMesh(const Example& example, double voxelSize, const Box3d& box,
                          const Padding& padding, const Progress& progress);

}  // namespace exemplar
