// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/vec.h"

namespace exemplar {

/// On which side of a triangle's plane a point lies: 1 where `d` sees `a`, `b`, `c` run
/// counterclockwise, -1 where clockwise, 0 on the plane. The sign of the exact determinant, for
/// coordinates whose differences are 0 or between 1e-90 and 1e90 in size: computed in doubles, and
/// again with expansions where rounding could have changed the sign.
///
/// J. R. Shewchuk: "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates", Discrete & Computational Geometry 18, 1997, doi:10.1007/PL00009321, section 4.3
/// (first and last of its four stages).
int orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// Whether two triangles cross: each has corners strictly on both sides of the other's plane, and
/// they have more than a point in common. Triangles that touch in a point or along an edge, or that
/// lie in one plane, do not cross. Exact, as `orientation` is.
bool trianglesCross(const Vec3d (&first)[3], const Vec3d (&second)[3]);

}  // namespace exemplar
