// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Which material an example's triangles have around each place, where it is only one: so the
/// material of the nearest triangle is mostly known without a search for it.
class NearMaterials {
 public:
  /// Several materials, or nothing known.
  static constexpr std::uint32_t kUnknown = std::numeric_limits<std::uint32_t>::max();

  /// `materials`: one for each triangle of `mesh`. `reach`, voxels, > 0: how far around a place
  /// triangles count. Places are told apart by `cells` >= 1 a voxel along each axis. 8 bytes a
  /// cell of the field's box; O(n + m) for n triangles that cover m cells.
  NearMaterials(const TriangleMesh& mesh, std::span<const std::uint32_t> materials,
                const DistanceField& field, double reach, int cells);

  /// The material of all triangles within `reach` of a place (in samples of the field), or of some
  /// that are little farther away; `kUnknown` where they have several, and where there is none.
  std::uint32_t only(const Vec3d& index) const {
    const Vec3i cell = cellOf(index);
    return material_.contains(cell) ? material_[cell] : kUnknown;
  }

  /// A triangle near a place: that with its middle nearest to it, of those within `reach` or little
  /// farther away; `kUnknown` where there is none. Of large triangles, parts count.
  std::uint32_t triangleNear(const Vec3d& index) const {
    const Vec3i cell = cellOf(index);
    return triangle_.contains(cell) ? triangle_[cell] : kUnknown;
  }

 private:
  Vec3i cellOf(const Vec3d& index) const;
  void mark(const std::array<Vec3d, 3>& corners, std::uint32_t triangle, std::uint32_t material,
            int halvings);

  double reach_;
  int cells_;
  Array3D<std::uint32_t> material_, triangle_;
  Array3D<float> away_;  // squared, of the triangles' middles, cells; while triangles are marked
};

}  // namespace exemplar
