// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/object_kind.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "core/cells.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// What is at most this thick, of its longest side, is limbs and walls: half its thickness.
constexpr double kThin = 1.0 / 8;

/// Directions that a surface faces are sorted by a cube whose sides have so many fields along
/// an edge; an object is made of planes where so much of its surface faces so many of them.
constexpr int kFields = 9;
constexpr std::size_t kFacings = 8;
constexpr double kPlanes = 0.45;

/// A place of the surface is an edge where its curvature is that of a ball of so many voxels, or
/// more; limbs have no more edges than this share, or they would be rounded.
constexpr float kEdge = 2;
constexpr double kEdges = 0.1;

/// Which field of a cube a direction passes through.
std::size_t facingOf(const Vec3f& direction) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(direction[axis]) > std::abs(direction[longest])) longest = axis;
  std::size_t field = direction[longest] < 0 ? 1 : 0;
  const float scale = 1 / std::max(1e-9F, std::abs(direction[longest]));
  for (int axis = 0; axis < 3; ++axis) {
    const float at = axis == longest ? 0 : (direction[axis] * scale + 1) / 2 * kFields;
    field = field * kFields +
            static_cast<std::size_t>(std::clamp<int>(static_cast<int>(at), 0, kFields - 1));
  }
  return field * 3 + static_cast<std::size_t>(longest);
}

/// Whether distances inside are clamped: nowhere else are a sample and all of its neighbors as
/// deep.
bool isClamped(const Array3D<float>& values, float deepest) {
  bool clamped = false;
  forEachCell(values.size(), [&](const Vec3i& p) {
    if (clamped || values[p] > -0.999F * deepest) return;
    clamped = std::ranges::all_of(kFaceSteps, [&](const Vec3i& d) {
      return values.contains(p + d) && values[p + d] <= -0.999F * deepest;
    });
  });
  return clamped;
}

}  // namespace

ObjectKind objectKind(const DistanceField& example) {
  const Array3D<float>& values = example.values;
  const auto voxel = static_cast<float>(example.voxelSize);
  const Vec3i n = example.size();
  std::vector<std::int64_t> facings(std::size_t{2} * 3 * kFields * kFields * kFields);
  std::int64_t surface = 0, edges = 0;
  float deepest = 0;
  forEachCell(n, [&](const Vec3i& p) {
    deepest = std::max(deepest, -values[p]);
    if (std::abs(values[p]) > voxel / 2) return;
    Vec3f slope;
    float bend = -6 * values[p];
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i step;
      step[axis] = 1;
      const float ahead = values[values.clamped(p + step)];
      const float behind = values[values.clamped(p - step)];
      slope[axis] = ahead - behind;
      bend += ahead + behind;
    }
    ++surface;
    edges += std::abs(bend) > 2 / kEdge * voxel;
    ++facings[facingOf(slope)];
  });
  std::partial_sort(facings.begin(), facings.begin() + kFacings, facings.end(), std::greater<>());
  const auto planes = std::accumulate(facings.begin(), facings.begin() + kFacings, std::int64_t{0});
  const auto share = [&](std::int64_t of) {
    return static_cast<double>(of) / static_cast<double>(std::max<std::int64_t>(1, surface));
  };
  // Of clamped distances no medial axis can be found.
  const double thick =
      deepest > 0 && isClamped(values, deepest) ? 1 : deepest / voxel / std::max({n.x, n.y, n.z});
  if (share(planes) > kPlanes || (thick <= kThin && share(edges) > kEdges))
    return ObjectKind::Planes;
  return thick > kThin ? ObjectKind::Lump : ObjectKind::Limbs;
}

}  // namespace exemplar
