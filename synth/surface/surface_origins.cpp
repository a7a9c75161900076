// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/surface_origins.h"

#include <algorithm>
#include <cstdint>

namespace exemplar::surface {
namespace {

/// The gradients of a part's place over a triangle: one for x, one for y.
std::array<Vec3d, 2> gradients(const std::array<Vec3d, 3>& p, const std::array<Vec2d, 3>& source) {
  const Vec3d e1 = p[1] - p[0], e2 = p[2] - p[0], n = cross(e1, e2);
  const double square = dot(n, n);
  if (square == 0) return {};
  const Vec3d of1 = cross(e2, n) / square, of2 = cross(n, e1) / square;
  const Vec2d s1 = source[1] - source[0], s2 = source[2] - source[0];
  return {of1 * s1.x + of2 * s2.x, of1 * s1.y + of2 * s2.y};
}

}  // namespace

std::optional<Foot> SurfaceOrigins::footOf(const Vec3d& position) const {
  std::uint32_t near = TriangleTree::kNone;
  return feet_->find(position, scale_.limit, near);
}

void SurfaceOrigins::candidates(const Vec3d& position, std::vector<Candidate>& out) const {
  out.clear();
  const std::optional<Foot> foot = footOf(position);
  if (!foot) return;
  for (const SheetContent::Part& part : content_->at(foot->triangle)) {
    double weight = 0;
    for (int c = 0; c < 3; ++c) weight += foot->weights[c] * static_cast<double>(part.weight[c]);
    if (weight > 0) out.push_back({part.placement, weight});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
}

std::optional<OriginMap::Place> SurfaceOrigins::place(std::uint32_t part,
                                                      const Vec3d& position) const {
  const std::optional<Foot> foot = footOf(position);
  if (!foot) return std::nullopt;
  for (const SheetContent::Part& there : content_->at(foot->triangle)) {
    if (there.placement != part) continue;
    Vec2d source{};
    Vec3d up{};
    std::array<Vec3d, 3> corners;
    for (int c = 0; c < 3; ++c) {
      source += there.source[c] * foot->weights[c];
      up += sheet_->normals[foot->triangle][c] * foot->weights[c];
      corners[c] = sheet_->positions[sheet_->triangles[foot->triangle][c]];
    }
    const std::array<Vec3d, 2> g = gradients(corners, there.source);
    Place place;
    const double size = sheet_->sizeAt(foot->triangle, foot->weights);
    place.index = {source.x, source.y,
                   scale_.zero + foot->height / (scale_.sample * size * scale_.height)};
    place.rows = {normalized(g[0]), normalized(g[1]), normalized(up)};
    return place;
  }
  return std::nullopt;
}

}  // namespace exemplar::surface
