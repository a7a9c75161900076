// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/origin.h"
#include "mesh/mesh_health.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

// Fields and checks that several tests of this room share.

namespace exemplar {

/// A field of `size` samples whose values, world units, are `value(position)`.
template <class Value>
DistanceField makeField(const Vec3i& size, double voxelSize, const Vec3d& origin,
                        const Value& value, double halfWidth = 3) {
  DistanceField field;
  field.values = Array3D<float>(size);
  field.voxelSize = voxelSize;
  field.origin = origin;
  field.truncation = static_cast<float>(halfWidth * voxelSize);
  for (std::size_t n = 0; n < field.values.count(); ++n) {
    const Vec3d p = field.position(cast<double>(field.values.ijk(n)));
    field.values.values()[n] =
        std::clamp(static_cast<float>(value(p)), -field.truncation, field.truncation);
  }
  return field;
}

inline double sphereDistance(const Vec3d& p, const Vec3d& center, double radius) {
  return length(p - center) - radius;
}

/// A torus around the z axis.
inline double torusDistance(const Vec3d& p, double ringRadius, double wireRadius) {
  const double ring = std::hypot(p.x, p.y) - ringRadius;
  return std::hypot(ring, p.z) - wireRadius;
}

inline double boxDistance(const Vec3d& p, const Vec3d& half) {
  const Vec3d q{std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z};
  const Vec3d outside = max(q, Vec3d{0, 0, 0});
  return length(outside) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

/// The example's own cells, in place.
inline Origins identityOrigins(const Vec3i& size) {
  Origins origins(size);
  for (std::size_t n = 0; n < origins.count(); ++n) origins.values()[n] = origins.ijk(n);
  return origins;
}

/// Every triangle of a sound surface: two to an edge, one fan to a vertex, oriented, with area.
inline void expectSound(const TriangleMesh& mesh, bool closed = true) {
  const MeshHealth health = meshHealth(mesh);
  if (closed) {
    EXPECT_EQ(health.boundaryEdges, 0);
  }
  EXPECT_EQ(health.nonManifoldEdges, 0);
  EXPECT_EQ(health.nonManifoldVertices, 0);
  EXPECT_EQ(health.misorientedEdges, 0);
  EXPECT_EQ(health.degenerateTriangles, 0);
}

/// V - E + F: 2 for a sphere, 0 for a torus.
inline std::int64_t eulerCharacteristic(const TriangleMesh& mesh) {
  const auto faces = static_cast<std::int64_t>(mesh.triangles.size());
  return static_cast<std::int64_t>(mesh.positions.size()) - 3 * faces / 2 + faces;
}

}  // namespace exemplar
