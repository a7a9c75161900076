// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "measure/example_nature.h"
#include "tests/example_shapes.h"

/// What goes wrong with results, done to a field on purpose: each figure has to see its own.
namespace exemplar::testing {

/// Moved, what leaves the box at one side coming in at the other; a `size` other than the field's
/// crops or tiles it.
inline DistanceField rolledField(const DistanceField& field, const Vec3i& shift,
                                 const Vec3i& size) {
  return shapeField(size, [&](const Vec3d& p) {
    Vec3i from;
    for (int axis = 0; axis < 3; ++axis) {
      const int n = field.size()[axis];
      from[axis] = ((static_cast<int>(p[axis]) - shift[axis]) % n + n) % n;
    }
    return static_cast<double>(field.values[from]);
  });
}
inline DistanceField rolledField(const DistanceField& field, const Vec3i& shift) {
  return rolledField(field, shift, field.size());
}

/// The smallest box around the solid.
inline CellBox solidBox(const DistanceField& field) { return natureOf(Occupancy(field)).solid; }

/// Both fields' solid.
inline DistanceField unitedFields(const DistanceField& a, const DistanceField& b) {
  return shapeField(a.size(), [&](const Vec3d& p) {
    const Vec3i c = cast<int>(p);
    return static_cast<double>(std::min(a.values[c], b.values[c]));
  });
}

/// Fallen to pieces: gaps of three voxels along planes through it.
inline DistanceField shards(const DistanceField& field, std::uint64_t seed = 0) {
  const Random random(seed, 90);
  const CellBox solid = solidBox(field);
  const Vec3d middle = cast<double>(solid.begin + solid.end) * 0.5;
  const double reach = length(cast<double>(solid.size())) / 5;
  return shapeField(field.size(), [&](const Vec3d& p) {
    double d = field.values[cast<int>(p)];
    for (std::uint64_t plane = 0; plane < 6; ++plane) {
      const Vec3d normal =
          normalized(Vec3d{random.normal(plane), random.normal(plane, 2), random.normal(plane, 4)});
      const double offset = random.uniform(-reach, reach, plane, 6);
      d = std::max(d, 1.5 - std::abs(dot(p - middle, normal) - offset));
    }
    return d;
  });
}

/// Without what is above this share of its height.
inline DistanceField shearedTop(const DistanceField& field, double share = 0.7) {
  const CellBox solid = solidBox(field);
  const double top = solid.begin.z + share * solid.size().z - 0.5;
  return shapeField(field.size(), [&](const Vec3d& p) {
    return std::max<double>(field.values[cast<int>(p)], p.z - top);
  });
}

/// Without its lowest `layers` layers of solid.
inline DistanceField lostFloor(const DistanceField& field, int layers = 5) {
  const double bottom = solidBox(field).begin.z + layers - 0.5;
  return shapeField(field.size(), [&](const Vec3d& p) {
    return std::max<double>(field.values[cast<int>(p)], bottom - p.z);
  });
}

/// Itself and itself again beside it, fused.
inline DistanceField doubled(const DistanceField& field) {
  const Vec3i n = field.size();
  return unitedFields(field, rolledField(field, {n.x / 3, n.y / 4, 0}));
}

/// Moved through a side of its box, which cuts it.
inline DistanceField cutByBox(const DistanceField& field) {
  const int by = field.size().x / 3;
  return shapeField(field.size(), [&](const Vec3d& p) {
    const Vec3i from = cast<int>(p) + Vec3i{by, 0, 0};
    return field.values.contains(from) ? static_cast<double>(field.values[from]) : kShapeTruncation;
  });
}

/// Full of small holes: balls of radius 2.2 taken out around a share of its surface's cells.
inline DistanceField torn(const DistanceField& field, std::uint64_t seed = 0) {
  const Random random(seed, 91);
  std::vector<Vec3d> holes;
  for (std::size_t s = 0; s < field.values.count(); ++s)
    if (std::abs(field.values.data()[s]) < 0.5f && random.uniform(s) < 0.004)
      holes.push_back(cast<double>(field.values.ijk(s)));
  return shapeField(field.size(), [&](const Vec3d& p) {
    double d = field.values[cast<int>(p)];
    for (const Vec3d& hole : holes) d = std::max(d, 2.2 - length(p - hole));
    return d;
  });
}

/// With a slab in the air above it.
inline DistanceField withDebris(const DistanceField& field) {
  const Vec3i n = field.size();
  const Vec3d at{n.x * 0.3, n.y * 0.5, n.z - 7.0};
  return shapeField(field.size(), [&](const Vec3d& p) {
    return std::min<double>(field.values[cast<int>(p)],
                            boxDistance(p, at - Vec3d{6, 2, 1}, at + Vec3d{6, 2, 1}));
  });
}

}  // namespace exemplar::testing
