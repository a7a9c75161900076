// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "synth/continuous/central.h"
#include "synth/continuous/exact.h"

/// An example of continuous model synthesis: solids with exact planes.
namespace exemplar::continuous {

/// A material of space: 0 is air.
using Substance = std::uint8_t;
inline constexpr Substance kAir = 0;

/// A triangle of a closed shell.
struct ShellTriangle {
  std::array<std::uint32_t, 3> corners{};  ///< indices into `Solids::nearPoints`
  std::uint32_t plane = 0;                 ///< index into `Solid::sides`; its normal points outward
};

/// What has one substance: a convex part, the points on the inner side of all planes; or a closed
/// shell of triangles, the points around which it winds.
struct Solid {
  Substance substance = 1;
  std::vector<ExactPlane> sides;         ///< outward: normal . x <= offset is inside
  std::vector<ShellTriangle> triangles;  ///< of a shell; none for a convex part
};

/// A triangle of a mesh from which faces of a substance that look the same way come.
struct FaceOrigin {
  Substance substance = 1;
  Vec3l normal;  ///< outward
  std::uint32_t triangle = 0;
};

/// The half-space z <= height.
struct Ground {
  std::int64_t height = 0;
  Substance substance = 1;
};

/// Solids of an example in units of its grid; where several overlap, the last one counts. All but
/// the ground are bounded.
struct Solids {
  std::vector<Solid> solids;
  std::optional<Ground> ground;    ///< below all solids
  std::vector<ExactPoint> points;  ///< corners of shells at which three planes meet
  /// All corners of shells' triangles, rounded; those in the middle of a face or of a straight edge
  /// matter only by that triangles share them.
  std::vector<Vec3d> nearPoints;
  std::vector<FaceOrigin> origins;  ///< of solids that were read from a mesh

  /// Shapes of the plane: all solids are upright prisms of one height, from 0 on.
  bool flat = false;

  std::vector<std::string> substances;  ///< names; the first is "air"
  double unit = 1;                      ///< of the grid, world units
  Vec3d origin;                         ///< of the grid, world

  Vec3d toWorld(const ExactPoint& p) const { return origin + unit * p.approximately(); }
};

/// All distinct planes of the solids, with canonical normals.
std::vector<ExactPlane> planesOf(const Solids& solids);
/// The directions among planes; throws `InputError` for more than `kMostFamilies`.
std::vector<Vec3l> normalsOf(std::span<const ExactPlane> planes);

/// The points at which figures can be other than along an edge, on a face or within a solid; and
/// some more.
std::vector<ExactPoint> candidatePoints(const Solids& solids);

/// The smallest whole box around all solids but the ground. Throws `InputError` where there are
/// none, or one is unbounded.
struct ExactBox {
  Vec3l low, high;
  Vec3l size() const { return high - low; }
};
ExactBox boxOf(const Solids& solids);

/// The substance of each cell of `central` (of rank 3) around `point`, infinitely near to it. The
/// families of `central` are those with a plane of the solids through the point, and maybe more.
/// Exact: sides of planes are integers, and rays of shells are cast in directions in which rounding
/// cannot matter. Throws `InputError` where there is no such direction.
std::vector<Substance> substancesAround(const Solids& solids, const Central& central,
                                        const ExactPoint& point);

}  // namespace exemplar::continuous
