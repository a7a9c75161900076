// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace exemplar {

/// The most corners of a polygon that is not convex: cutting one takes time that grows with their
/// number squared.
constexpr std::size_t kMostCorners = 5'000;

/// Cuts a polygon with n >= 3 corners into n - 2 triangles with the same winding; their corners are
/// indices into `corners`. Concave polygons are cut by clipping ears in the plane across their mean
/// normal, so that no triangle covers what the polygon leaves out; one that is not flat or crosses
/// itself gives some n - 2 triangles. Convex polygons become a fan, quadrilaterals are cut along
/// the diagonal inside them. Coordinates must be finite and below 1e15. Returns false, with nothing
/// added, when it is not convex and has more than `kMostCorners` corners. Deterministic.
bool triangulate(std::span<const Vec3d> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace exemplar
