// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include "core/progress.h"
#include "synth/continuous/snap.h"

/// Meshes that fit no grid, or are not closed, as solids between few planes.
namespace exemplar::continuous {

struct FitOptions {
  /// World length of a unit of the grid, > 0. By default the longest that is near enough.
  std::optional<double> unit;
  /// How far the surface may be moved, in lengths of the mesh's longest side, > 0; 0.07. It is
  /// moved by as little as leaves results a bearable number of vertices.
  std::optional<double> tolerance;
  /// World height below which all is ground.
  std::optional<double> ground;
};

/// What the fit is like.
struct FitReport {
  double moved = 0;  ///< the largest distance between the two surfaces, world units
  std::size_t parts = 0, openings = 0, sheets = 0, dropped = 0;
};

/// The union of a mesh's parts (`partsOf`), each cut into convex cells along the planes of its
/// faces; parts of another material that come later replace what they overlap. Faces take the
/// simplest direction that the tolerance allows, and one that others have where it allows that,
/// and whole offsets; those narrower than the tolerance are left out, as bevels. So gaps close,
/// parts may cross, faces need not be flat, and openings are closed. The distance of the surfaces
/// is measured, not assumed. Throws `InputError` where the tolerance does not do, with what would
/// help, and `Cancelled`.
Solids fitParts(const TriangleMesh& mesh, const FitOptions& options = {},
                FitReport* report = nullptr, const Progress& progress = {});

}  // namespace exemplar::continuous
