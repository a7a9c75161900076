// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "synth/continuous/polygons.h"
#include "synth/continuous/solid_scene.h"

/// Boxes back into the meshes for which they stand.
namespace exemplar::continuous {

/// A box of a model in which a mesh goes.
struct PlacedStandIn {
  std::size_t standIn = 0;
  Box3d box;  ///< world
};

/// Takes the boxes that stand for meshes out of a model, and says where they were, in the order of
/// their first faces: what of both halves hangs together is one.
std::vector<PlacedStandIn> takeStandIns(PolygonModel& model, std::span<const StandIn> standIns);

/// A mesh stretched from its own box to another one.
TriangleMesh stretched(const TriangleMesh& mesh, const Box3d& to);

}  // namespace exemplar::continuous
