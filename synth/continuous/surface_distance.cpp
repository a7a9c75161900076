// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

using Corners = std::array<Vec3d, 3>;

struct Sample {
  Vec3d point, normal;
};

constexpr int kMostSteps = 14;  // of a triangle's longest edge

void sampleTriangle(const Corners& c, double spacing, std::vector<Sample>& samples) {
  const Vec3d n = normalized(cross(c[1] - c[0], c[2] - c[0]));
  double longest = 0;
  for (int e = 0; e < 3; ++e) longest = std::max(longest, length(c[(e + 1) % 3] - c[e]));
  const int steps = std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, kMostSteps);
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
      samples.push_back({c[0] * (1 - s - t) + c[1] * s + c[2] * t, n});
    }
  }
}

/// The squared distance of a point from a triangle (C. Ericson, "Real-Time Collision Detection",
/// 2005, section 5.1.5).
double distance2(const Vec3d& p, const Corners& c) {
  const Vec3d ab = c[1] - c[0], ac = c[2] - c[0], ap = p - c[0];
  const auto to = [&](const Vec3d& q) { return dot(p - q, p - q); };
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return to(c[0]);
  const Vec3d bp = p - c[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return to(c[1]);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return to(c[0] + ab * (d1 / (d1 - d3)));
  const Vec3d cp = p - c[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return to(c[2]);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return to(c[0] + ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return to(c[1] + (c[2] - c[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const double whole = va + vb + vc;
  return to(c[0] + ab * (vb / whole) + ac * (vc / whole));
}

/// Triangles with boxes around them, so that most need no look.
struct Surface {
  std::vector<Corners> triangles;
  std::vector<Box3d> boxes;

  void add(const Corners& c) {
    triangles.push_back(c);
    Box3d box;
    for (const Vec3d& p : c) box.add(p);
    boxes.push_back(box);
  }
};

double distance2(const Vec3d& p, const Surface& surface) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < surface.boxes.size(); ++n) {
    const Box3d& box = surface.boxes[n];
    const Vec3d beyond = max(max(box.min - p, p - box.max), Vec3d{});
    if (dot(beyond, beyond) < least) least = std::min(least, distance2(p, surface.triangles[n]));
  }
  return least;
}

/// Whether a point is on the surface of the union, by what is on its two sides.
bool onUnion(std::span<const MeshPart> parts, const Sample& sample, double step) {
  const auto inside = [&](const Vec3d& p) {
    return std::ranges::any_of(parts, [&](const MeshPart& part) {
      return part.box.contains(p) && std::abs(windingNumber(part, p)) > 0.5;
    });
  };
  return inside(sample.point - sample.normal * step) != inside(sample.point + sample.normal * step);
}

}  // namespace

double surfaceDistance(std::span<const MeshPart> parts, const TriangleMesh& mesh, double spacing,
                       const Progress& progress) {
  Surface of, to;
  for (const MeshPart& part : parts)
    for (const PartTriangle& t : part.triangles) of.add(t.corners);
  for (const auto& t : mesh.triangles)
    to.add({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
  const auto farthest = [&](const Surface& from, const Surface& others, auto&& counts) {
    std::vector<Sample> samples;
    for (const Corners& c : from.triangles) sampleTriangle(c, spacing, samples);
    std::vector<double> found(samples.size());
    parallelFor(0, samples.size(), 64, [&](std::size_t first, std::size_t last) {
      progress.check();
      for (std::size_t n = first; n < last; ++n)
        if (counts(samples[n])) found[n] = distance2(samples[n].point, others);
    });
    return samples.empty() ? 0.0 : std::sqrt(std::ranges::max(found));
  };
  const double step = 1e-3 * spacing;
  return std::max(
      farthest(of, to, [&](const Sample& sample) { return onUnion(parts, sample, step); }),
      farthest(to, of, [](const Sample&) { return true; }));
}

}  // namespace exemplar::continuous
