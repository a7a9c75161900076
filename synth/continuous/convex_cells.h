// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/continuous/exact.h"
#include "synth/continuous/solids.h"

/// Solids cut into convex cells.
namespace exemplar::continuous {

/// A convex cell: its sides, outward, and their corners, rounded.
struct ConvexCell {
  struct Side {
    ExactPlane plane;
    std::vector<Vec3d> corners;
  };
  std::vector<Side> sides;

  bool empty() const { return sides.size() < 4; }
  std::vector<Vec3d> corners() const;
};

/// A polygon of a surface, and the plane that stands for it.
struct SurfacePolygon {
  std::vector<Vec3d> corners;
  std::uint32_t plane = 0;
};

/// Cuts a box along the planes of the polygons in it, each only where polygons are (a binary space
/// partition: Fuchs, Kedem, Naylor 1980), and returns the cells that are `inside`, joined again
/// where both halves are. Polygons need not lie on their planes: what is less than `room` on the
/// other side of one does not count there.
std::vector<ConvexCell> convexCells(const ExactBox& box, std::span<const ExactPlane> planes,
                                    std::vector<SurfacePolygon> polygons, double room,
                                    const std::function<bool(const ConvexCell&)>& inside,
                                    const Progress& progress = {});

}  // namespace exemplar::continuous
