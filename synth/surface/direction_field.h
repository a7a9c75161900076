// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"
#include "synth/surface/sheet.h"

namespace exemplar::surface {

/// Where a direction field points no way: a triangle around which it turns.
struct Singularity {
  std::uint32_t triangle = 0;
  int index = 0;  ///< in turns of 2 pi / symmetry
};

/// One direction at each node, or several that are alike: `symmetry` of them, 2 pi / symmetry
/// apart, of which one is named.
struct DirectionField {
  int symmetry = 1;
  std::vector<double> angle;  ///< n, at each node (`Sheet`)
  std::vector<Singularity> singularities;
  double residual = 0;  ///< how far indices are off whole numbers, at most: rounding

  /// How often the direction named at `edge.b` is turned, anticlockwise, against the parallel one
  /// of that named at `edge.a`: 0 .. symmetry - 1.
  int turns(const Sheet::Edge& edge) const;
};

/// Which way a field should point.
struct Guidance {
  std::vector<double> angle;       ///< n
  std::vector<double> confidence;  ///< n, 0..1; 0: it does not matter
  /// How far around them the directions wanted win over smoothness, world units, > 0.
  double reach = 1;
};

/// The smoothest field of a symmetry: the eigenvector of the smallest eigenvalue of a connection
/// Laplacian, by inverse iteration (Knöppel, Crane, Pinkall, Schröder: "Globally optimal direction
/// fields", SIGGRAPH 2013, doi:10.1145/2461912.2462005, section 6.1). With `guidance`, what is
/// nearest to that and smooth (section 6.2): one system.
///
/// Each connected part has its own. `symmetry` 1, 2, 4 or 6. About n^1.5 operations; the same bytes
/// at any number of threads. Throws `Cancelled`.
DirectionField smoothestField(const Sheet& sheet, int symmetry, const Guidance* guidance = nullptr,
                              const Progress& progress = {});

/// The direction in space that should be followed, at each node: its part in the tangent plane,
/// with as much confidence as there is of it. `reach` as in `Guidance`.
Guidance along(const Sheet& sheet, const Vec3d& direction, double reach);

/// The direction in which the surface bends least, as along a limb, at each node: that of the
/// principal curvature of the smaller size (Taubin: "Estimating the tensor of curvature of a
/// surface from a polyhedral approximation", ICCV 1995), upward of its two ways. With as much
/// confidence as the two curvatures differ, none where the surface is flat within `reach`.
Guidance alongLeastCurvature(const Sheet& sheet, double reach);

/// Directions along polylines, at the nodes within `width` of them, world units.
Guidance alongStrokes(const Sheet& sheet, const std::vector<std::vector<Vec3d>>& strokes,
                      double width, double reach);

}  // namespace exemplar::surface
