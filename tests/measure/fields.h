// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

// Fields made by formulas, in voxels of size 1 unless said otherwise, for the tests of measure/.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/cells.h"
#include "core/origin.h"
#include "core/random.h"
#include "sdf/distance_field.h"

namespace exemplar::testing {

/// The field whose sample at ijk is `phi(ijk)`.
template <class Phi>
DistanceField makeField(const Vec3i& size, const Phi& phi) {
  DistanceField field;
  field.values = Array3D<float>(size);
  field.truncation = std::numeric_limits<float>::infinity();
  forEachCell(size,
              [&](const Vec3i& p) { field.values[p] = static_cast<float>(phi(cast<double>(p))); });
  return field;
}

inline DistanceField emptyField(const Vec3i& size) {
  return makeField(size, [](const Vec3d&) { return 10; });
}
inline DistanceField solidField(const Vec3i& size) {
  return makeField(size, [](const Vec3d&) { return -10; });
}
inline DistanceField ball(const Vec3i& size, const Vec3d& center, double radius) {
  return makeField(size, [&](const Vec3d& p) { return length(p - center) - radius; });
}

/// The solid box low..high.
inline DistanceField box(const Vec3i& size, const Vec3d& low, const Vec3d& high) {
  const Vec3d center = (low + high) * 0.5, half = (high - low) * 0.5;
  return makeField(size, [&](const Vec3d& p) {
    const Vec3d q{std::abs(p.x - center.x) - half.x, std::abs(p.y - center.y) - half.y,
                  std::abs(p.z - center.z) - half.z};
    return length(max(q, Vec3d{})) + std::min(0.0, std::max({q.x, q.y, q.z}));
  });
}

/// Normal deviates of one voxel, a share `solid` of them below zero.
inline DistanceField noise(const Vec3i& size, double solid, std::uint64_t seed) {
  const Random random(seed, 77);
  // The offset whose normal tail is `solid`, by bisection.
  double low = -5, high = 5;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > solid ? low : high) = middle;
  }
  DistanceField field = emptyField(size);
  for (std::size_t n = 0; n < field.values.count(); ++n)
    field.values.data()[n] = static_cast<float>(random.normal(n) + low);
  return field;
}

/// Centers of balls that lie at least 2 radius + `gap` apart, by random sequential addition: the
/// same process at every seed. They reach past the box, so that its faces cut some; with a `margin`
/// > 0 they stay wholly that far inside.
inline std::vector<Vec3d> packing(const Vec3i& size, double radius, double gap, std::uint64_t seed,
                                  double margin = 0) {
  const Random random(seed, 78);
  const double reach = margin > 0 ? radius + margin : -radius;
  std::vector<Vec3d> centers;
  for (int attempt = 0; attempt < 20000; ++attempt) {
    Vec3d c;
    for (int axis = 0; axis < 3; ++axis)
      c[axis] = random.uniform(reach, size[axis] - 1 - reach, attempt, axis);
    const double least = 2 * radius + gap;
    if (std::none_of(centers.begin(), centers.end(),
                     [&](const Vec3d& o) { return dot(c - o, c - o) < least * least; }))
      centers.push_back(c);
  }
  return centers;
}

inline DistanceField balls(const Vec3i& size, double radius, const std::vector<Vec3d>& centers) {
  return makeField(size, [&](const Vec3d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3d& c : centers) nearest = std::min(nearest, dot(p - c, p - c));
    return std::sqrt(nearest) - radius;
  });
}

/// A sample of a process: balls of radius 5 packed at random.
inline DistanceField ballPacking(const Vec3i& size, std::uint64_t seed, double margin = 0) {
  return balls(size, 5, packing(size, 5, 0.5, seed, margin));
}

/// `field` moved by `shift`; what comes in is far outside.
inline DistanceField moved(const DistanceField& field, const Vec3i& shift) {
  return makeField(field.size(), [&](const Vec3d& p) {
    const Vec3i from = cast<int>(p) - shift;
    return field.values.contains(from) ? field.values[from] : 10.0f;
  });
}

/// The field that `origins` gather from `example`.
inline DistanceField gathered(const DistanceField& example, const Origins& origins) {
  return makeField(origins.size(),
                   [&](const Vec3d& p) { return example.values[origins[cast<int>(p)].cell()]; });
}

/// The origins `origin(ijk)`.
template <class Function>
Origins makeOrigins(const Vec3i& size, const Function& origin) {
  Origins origins(size);
  forEachCell(size, [&](const Vec3i& p) { origins[p] = origin(p); });
  return origins;
}

}  // namespace exemplar::testing
