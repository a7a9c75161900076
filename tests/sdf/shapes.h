// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "core/random.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"
#include "tests/temporary_files.h"

// Solids with a known signed distance, and what the tests of this room share.
namespace exemplar::test {

using Shape = std::function<double(const Vec3d&)>;

inline Shape sphere(const Vec3d& center, double radius) {
  return [=](const Vec3d& p) { return length(p - center) - radius; };
}
/// A torus around the z axis.
inline Shape torus(const Vec3d& center, double ring, double wire) {
  return [=](const Vec3d& q) {
    const Vec3d p = q - center;
    return std::hypot(std::hypot(p.x, p.y) - ring, p.z) - wire;
  };
}
inline Shape box(const Box3d& b) {
  return [=](const Vec3d& p) {
    const Vec3d d = max(b.min - p, p - b.max);
    const double inside = std::min(std::max({d.x, d.y, d.z}), 0.0);
    return length(max(d, Vec3d{})) + inside;
  };
}

/// The shape's distance sampled, clamped to ±truncation.
inline DistanceField sampled(const Shape& shape, const Vec3i& size, double voxelSize,
                             const Vec3d& origin, double truncation) {
  DistanceField field{Array3D<float>(size), voxelSize, origin, static_cast<float>(truncation)};
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const double d = shape(field.position(cast<double>(field.values.ijk(s))));
    field.values.values()[s] = static_cast<float>(std::clamp(d, -truncation, truncation));
  }
  return field;
}

/// The largest difference between a field and a shape's clamped distance, in voxels.
inline double worstError(const DistanceField& field, const Shape& shape) {
  double worst = 0;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const double d = shape(field.position(cast<double>(field.values.ijk(s))));
    const double t = field.truncation;
    worst = std::max(worst, std::abs(field.values.values()[s] - std::clamp(d, -t, t)));
  }
  return worst / field.voxelSize;
}

/// Runs `work` in an arena of its own with this many threads.
template <class Work>
auto withThreads(int threads, const Work& work) {
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

}  // namespace exemplar::test
