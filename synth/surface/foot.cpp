// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/foot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"

namespace exemplar::surface {
namespace {

constexpr int kNewton = 4, kWalk = 8;
/// A foot farther off than the nearest point by more than this is another part's.
constexpr double kFarther = 1.4;
/// Weights below count as on the triangle's side.
constexpr double kOnSide = 1e-7;

std::vector<Corners> cornersOf(const Sheet& sheet) {
  std::vector<Corners> corners;
  corners.reserve(sheet.triangles.size());
  for (const auto& [a, b, c] : sheet.triangles)
    corners.push_back({sheet.positions[a], sheet.positions[b], sheet.positions[c]});
  return corners;
}

/// Solves point = x(weights) + t n(weights) for weights that sum to 1 and t, near a start.
bool solveFoot(const Vec3d& point, const Corners& x, const std::array<Vec3d, 3>& n,
               std::array<double, 3>& weights, double& t) {
  const Vec3d e1 = x[1] - x[0], e2 = x[2] - x[0], m1 = n[1] - n[0], m2 = n[2] - n[0];
  double u = weights[1], v = weights[2];
  for (int i = 0; i < kNewton; ++i) {
    const Vec3d normal = n[0] + m1 * u + m2 * v;
    const Vec3d off = point - (x[0] + e1 * u + e2 * v) - normal * t;
    const Vec3d a = e1 + m1 * t, b = e2 + m2 * t;
    const double determinant = dot(a, cross(b, normal));
    if (determinant == 0) return false;
    const double du = dot(off, cross(b, normal)) / determinant;
    const double dv = dot(a, cross(off, normal)) / determinant;
    u += du;
    v += dv;
    t += dot(a, cross(b, off)) / determinant;
    if (std::abs(du) + std::abs(dv) < 1e-10) break;
  }
  weights = {1 - u - v, u, v};
  return std::isfinite(u) && std::isfinite(v) && std::isfinite(t);
}

}  // namespace

FootFinder::FootFinder(const Sheet& sheet, const Progress& progress)
    : sheet_(sheet),
      edgeNormals_(sheet.triangles.size()),
      faceNormals_(sheet.triangles.size()),
      cornerNormals_(sheet.positions.size()),
      tree_(cornersOf(sheet), progress, TriangleTree::For::Distances) {
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const auto& [a, b, c] = sheet.triangles[t];
    faceNormals_[t] = normalized(
        cross(sheet.positions[b] - sheet.positions[a], sheet.positions[c] - sheet.positions[a]));
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3d& p = sheet.positions[sheet.triangles[t][corner]];
      const Vec3d u = sheet.positions[sheet.triangles[t][(corner + 1) % 3]] - p;
      const Vec3d v = sheet.positions[sheet.triangles[t][(corner + 2) % 3]] - p;
      const double angle = std::atan2(length(cross(u, v)), dot(u, v));
      cornerNormals_[sheet.triangles[t][corner]] += faceNormals_[t] * angle;
    }
  }
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    for (int side = 0; side < 3; ++side) {
      const std::int32_t other = sheet.across[t][side];
      edgeNormals_[t][side] = other < 0
                                  ? faceNormals_[t]
                                  : faceNormals_[t] + faceNormals_[static_cast<std::size_t>(other)];
    }
  }
  for (Vec3d& n : cornerNormals_) n = normalized(n);
}

std::optional<Foot> FootFinder::find(const Vec3d& point, double limit, std::uint32_t& near) const {
  const double distance = tree_.distance(point, limit, near);
  if (!(distance < limit) || near == TriangleTree::kNone) return std::nullopt;
  Foot foot;
  foot.triangle = near;
  const ClosestPoint closest = closestPoint(point, tree_.triangle(near));
  foot.weights = closest.weights;
  int zeros = 0, zero = 0, one = 0;
  for (int c = 0; c < 3; ++c) {
    foot.weights[c] = std::clamp(foot.weights[c], 0.0, 1.0);
    if (foot.weights[c] <= kOnSide) {
      ++zeros;
      zero = c;
    } else {
      one = c;
    }
  }
  // Baerentzen, Aanaes: "Signed distance computation using the angle weighted pseudonormal", 2005.
  const std::uint32_t corner = sheet_.triangles[near][one];
  const int side = (zero + 1) % 3;
  const Vec3d& normal = zeros == 0   ? faceNormals_[near]
                        : zeros == 1 ? edgeNormals_[near][side]
                                     : cornerNormals_[corner];
  const double sign = dot(closest.offset, normal) < 0 ? -1 : 1;
  foot.distance = foot.height = sign * length(closest.offset);
  const bool onBorder =
      (zeros == 1 && sheet_.across[near][side] < 0) || (zeros == 2 && sheet_.atBorder[corner]);
  if (onBorder) {
    const Vec3d& up = zeros == 1 ? faceNormals_[near] : cornerNormals_[corner];
    foot.height = dot(closest.offset, up);
    foot.beyond = length(closest.offset - up * foot.height);
    return foot;
  }

  std::uint32_t t = near, before = TriangleTree::kNone;
  std::array<double, 3> weights = foot.weights;
  double along = foot.distance;
  for (int walk = 0; walk < kWalk; ++walk) {
    if (!solveFoot(point, tree_.triangle(t), sheet_.normals[t], weights, along)) return foot;
    const int out =
        static_cast<int>(std::min_element(weights.begin(), weights.end()) - weights.begin());
    const std::int32_t next = sheet_.across[t][(out + 1) % 3];
    const bool inside = weights[static_cast<std::size_t>(out)] >= -kOnSide;
    const bool between = next >= 0 && static_cast<std::uint32_t>(next) == before;
    if (inside || between) {
      double sum = 0;
      for (double& w : weights) {
        w = std::clamp(w, 0.0, 1.0);
        sum += w;
      }
      Vec3d foot3{}, up{};
      for (int c = 0; c < 3; ++c) {
        weights[c] /= sum;
        foot3 += tree_.triangle(t)[c] * weights[c];
        up += sheet_.normals[t][c] * weights[c];
      }
      const double far = length(point - foot3);
      if (far > kFarther * distance + 1e-12 || (along < 0) != (foot.distance < 0)) return foot;
      foot.triangle = t;
      foot.weights = weights;
      foot.height = along < 0 ? -far : far;
      return foot;
    }
    if (next < 0) return foot;
    before = t;
    t = static_cast<std::uint32_t>(next);
    weights = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    along = foot.distance;
  }
  return foot;
}

}  // namespace exemplar::surface
