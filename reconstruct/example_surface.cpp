// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/example_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/memory.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Corners> cornersOf(const TriangleMesh& mesh) {
  requireMemory(220.0 * static_cast<double>(mesh.triangles.size()),
                "looking up points on the example's surface",
                "use an example with fewer triangles");
  std::vector<Corners> corners(mesh.triangles.size());
  for (std::size_t t = 0; t < corners.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    corners[t] = {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
  }
  return corners;
}

// The spheres that are searched first: the radius of the first, in mean sides of triangles, by how
// much each is wider than the one before, and how many.
constexpr double kFirst = 0.2, kWider = 3;
constexpr int kSpheres = 4;

/// The square of a little more than `distance`: triangles at the same cost must be seen, whatever
/// rounding took, for the lowest to be chosen.
double lookWithin2(double distance) {
  const double within = distance * (1 + 1e-5) + 1e-30;
  return within * within;
}

}  // namespace

ExampleSurface::ExampleSurface(const TriangleMesh& mesh, const Progress& progress)
    : tree_(cornersOf(mesh), progress, TriangleTree::Answers::Near),
      normals_(mesh.triangles.size()) {
  for (const auto& [a, b, c] : mesh.triangles) {
    meanSide_ += length(mesh.positions[b] - mesh.positions[a]) / double(mesh.triangles.size());
  }
  parallelFor(0, normals_.size(), 1 << 14, [&](std::size_t t0, std::size_t t1) {
    for (std::size_t t = t0; t < t1; ++t) normals_[t] = normalized(areaNormal(mesh, t));
  });
}

std::optional<SurfacePoint> ExampleSurface::closest(const Vec3d& point,
                                                    const ClosestOptions& options) const {
  double best = kInfinity, radius = options.radius;
  SurfacePoint found;
  const auto visit = [&](std::uint32_t t, const Corners& corners, double within2) {
    if (!options.groups.empty() && options.groups[t] != options.group) return within2;
    const auto [weights, offset] = closestPoint(point, corners);
    if (dot(offset, offset) > within2) return within2;
    const Vec3d position =
        corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
    const double distance = length(position - point);
    if (distance > radius) return within2;
    const double turned = options.facingCost == 0
                              ? 0
                              : options.facingCost * (1 - dot(normals_[t], options.facing)) / 2;
    const double cost = distance + turned;
    if (cost > best || (cost == best && t >= found.triangle)) return within2;
    best = cost;
    found = {t, weights, position, distance};
    return std::min(within2, lookWithin2(cost));
  };
  // Small spheres first: they hold few triangles, and mostly the nearest one. What lies beyond a
  // sphere costs more than its radius.
  double sphere = kFirst * meanSide_;
  for (int n = 0; n < kSpheres && sphere < options.radius; ++n, sphere *= kWider) {
    radius = sphere;
    tree_.visitNear(point, lookWithin2(radius), visit);
    if (best < radius) return found;
    best = kInfinity;
  }
  radius = options.radius;
  tree_.visitNear(point, lookWithin2(radius), visit);
  if (best == kInfinity) return std::nullopt;
  return found;
}

}  // namespace exemplar
