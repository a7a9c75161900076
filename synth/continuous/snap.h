// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>

#include "core/progress.h"
#include "core/warnings.h"
#include "mesh/triangle_mesh.h"
#include "synth/continuous/solids.h"

/// Meshes as solids with exact planes.
namespace exemplar::continuous {

struct SnapOptions {
  /// World length of a unit of the grid, > 0. By default the greatest common divisor of the
  /// distances between parallel faces.
  std::optional<double> unit;
  /// How far a vertex may be moved, in lengths of the mesh's longest side, >= 0.
  double tolerance = 1e-3;
  /// World height below which all is ground.
  std::optional<double> ground;
  Warnings* warnings = nullptr;
};

/// What snapping did to a mesh.
struct SnapReport {
  double moved = 0;  ///< the largest displacement of a vertex, world units
  int shells = 0;    ///< closed, connected parts
};

/// The integer vector of smallest components (up to `kMostNormal`) that is within an angle
/// (radians) of a direction, or the nearest.
Vec3l integerDirection(const Vec3d& direction, double within);

/// A closed mesh as solids: coplanar triangles become faces, the directions of faces primitive
/// integer vectors, their offsets whole numbers of the grid, and vertices are where three faces
/// meet again. Parts that hang together by edges have the substance that most of their surface has
/// as material, and one of another material that comes later replaces what it overlaps. Throws
/// `InputError` where the mesh is open, where it has too many directions, where faces no longer
/// meet, or where a vertex would move farther than the tolerance, with what would help.
Solids snapMesh(const TriangleMesh& mesh, const SnapOptions& options = {},
                SnapReport* report = nullptr, const Progress& progress = {});

}  // namespace exemplar::continuous
