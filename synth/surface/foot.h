// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "sdf/triangle_tree.h"
#include "synth/surface/sheet.h"

namespace exemplar::surface {

/// A place on a sheet over or under which a point is.
struct Foot {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};  ///< of its corners
  double height = 0;                ///< along the sheet's normal, world units; negative inside
  double distance = 0;              ///< to the nearest point of the sheet, signed alike
  double beyond = 0;                ///< how far the point is past the sheet's border, world units
};

/// Finds the foot of a point: where the interpolated normal points to it, else the nearest point.
/// A point has one, so that what stands on the sheet cannot cross itself: in creases the nearer
/// side wins. Immutable; any number of threads may ask.
class FootFinder {
 public:
  explicit FootFinder(const Sheet& sheet, const Progress& progress = {});

  /// Nothing farther away than `limit`, world units. `near` starts at `TriangleTree::kNone` and
  /// should be the one of a point close by.
  std::optional<Foot> find(const Vec3d& point, double limit, std::uint32_t& near) const;

  /// Whether the sheet is nearer to a point than `limit`.
  bool within(const Vec3d& point, double limit, std::uint32_t& near) const {
    return tree_.distance(point, limit, near) < limit;
  }

 private:
  const Sheet& sheet_;
  std::vector<std::array<Vec3d, 3>> edgeNormals_;  // of each triangle's sides
  std::vector<Vec3d> faceNormals_, cornerNormals_;
  TriangleTree tree_;
};

}  // namespace exemplar::surface
