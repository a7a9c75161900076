// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "mesh/triangle_mesh.h"

namespace exemplar {

// Simple solids as triangle meshes: closed, manifold, oriented outwards, without materials, each
// one connected component. The vertices lie on the ideal surface and the triangles inside its
// convex parts, so a smooth solid of radius r whose longest edge is e is met to within
// r - sqrt(r² - e²/3), about e² / (6 r). Sizes are world units; a size or count out of its range is
// the caller's bug (an assertion).

/// A sphere from an icosahedron whose edges are cut in `frequency` >= 1 parts: 20 frequency²
/// triangles, nearly equal; the longest edge is about 1.26 radius / frequency.
TriangleMesh makeSphere(const Vec3d& center, double radius, int frequency = 8);

/// An axis-aligned box: 12 triangles, some without area where `box` is flat. `box` is not empty.
TriangleMesh makeBox(const Box3d& box);

/// A box with its edges and corners rounded by `radius`, which is above 0 and at most half of its
/// shortest side; `frequency` as of a sphere, even, so that the sides lie where those of `box` do.
TriangleMesh makeRoundedBox(const Box3d& box, double radius, int frequency = 8);

/// A torus around `axis` (any length but 0). `ringRadius`: from the center to the middle of the
/// wire; `wireRadius`: of the wire, less than `ringRadius`. Segments >= 3 along the ring and around
/// the wire; 2 ringSegments wireSegments triangles.
TriangleMesh makeTorus(const Vec3d& center, const Vec3d& axis, double ringRadius, double wireRadius,
                       int ringSegments = 48, int wireSegments = 16);

/// A cylinder from `a` to `b` with flat ends; `segments` >= 3 around. Triangles: 4 segments.
TriangleMesh makeCylinder(const Vec3d& a, const Vec3d& b, double radius, int segments = 24);

/// A cylinder from `a` to `b` with a half sphere on each end; `segments` >= 4 around.
TriangleMesh makeCapsule(const Vec3d& a, const Vec3d& b, double radius, int segments = 24);

/// A round tube along a polyline with half spheres on its ends. `path`: at least two points, no two
/// consecutive ones equal; `radii`: one for each point, > 0, or a single one for all. Cross
/// sections lie across the bisector of the path at each point and do not twist along it. A path
/// that bends tighter than its radius makes a mesh that crosses itself.
TriangleMesh makeTube(std::span<const Vec3d> path, std::span<const double> radii,
                      int segments = 16);

/// One cross section of a sweep: the ellipse center + cos(t) u + sin(t) v. cross(u, v) points along
/// the sweep.
struct SweepSection {
  Vec3d center, u, v;
};

/// The solid that elliptic cross sections sweep, closed by a fan to a point at each end.
/// `sections`: at least one; `segments` >= 3 around.
TriangleMesh makeSweep(const Vec3d& start, std::span<const SweepSection> sections, const Vec3d& end,
                       int segments);

/// A tapered blade, as of grass: a flat sweep along a curved spine, widest near its base and
/// pointed at its tip.
struct Blade {
  Vec3d root;               ///< where the middle of its base is
  Vec3d up{0, 0, 1};        ///< its direction at the base; any length but 0
  Vec3d lean{1, 0, 0};      ///< toward where it bends; not parallel to `up`
  double length = 1;        ///< along the spine, > 0
  double bend = 0.5;        ///< angle between base and tip, radians
  double twist = 0;         ///< of the cross section about the spine from base to tip, radians
  double width = 0.1;       ///< the whole blade's greatest width, > 0
  double thickness = 0.04;  ///< greatest thickness, > 0
  double tip = 0.1;         ///< width at the tip as a share of `width`, 0..1
};

/// `sections` >= 2 cross sections along the blade, `segments` >= 4 points around it.
TriangleMesh makeBlade(const Blade& blade, int sections = 16, int segments = 12);

/// The solid under a height field: top surface, walls and a flat floor. `heights`: columns * rows
/// values, row by row from the smallest y; point (c, r) is at corner + (c, r) * cellSize in x
/// and y and at height corner.z + heights[r * columns + c]. columns, rows >= 2; cellSize > 0; every
/// height is above `floor`, which is measured from corner.z too. Each cell is cut along the
/// diagonal whose ends differ less in height.
TriangleMesh makeHeightFieldSolid(const Vec3d& corner, double cellSize, int columns, int rows,
                                  std::span<const double> heights, double floor);

/// Paints every triangle of `mesh` with one material, in place of what it had.
void setMaterial(TriangleMesh& mesh, const Material& material);

}  // namespace exemplar
