// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace exemplar {
namespace {

constexpr double kQuarter = std::numbers::pi / 2, kDegree = std::numbers::pi / 180;
// How much of the steep faces' area stands across the axes, and how exactly.
constexpr double kAligned = 0.6, kAlignedWithin = 2 * kDegree;
constexpr double kFacesTurned = 1 * kDegree, kRectangleTurned = 3 * kDegree;
constexpr double kFilled = 0.8;
// Faces are steep where the normal's rise is less than this: 60 degrees from level.
constexpr double kSteep = 0.5;

struct Point {
  double x, y;
};

// An angle modulo a quarter turn: -pi/4 < angle <= pi/4.
double reduced(double angle) {
  angle -= kQuarter * std::floor(angle / kQuarter + 0.5);
  return angle <= -kQuarter / 2 ? angle + kQuarter : angle;
}

// The points seen from above, from the middle of their box.
std::vector<Point> pointsOf(const TriangleMesh& mesh, const Vec3d& middle) {
  std::vector<std::uint8_t> used(mesh.positions.size());
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t corner : t) used[corner] = 1;
  std::vector<Point> points;
  for (std::size_t p = 0; p < used.size(); ++p)
    if (used[p]) points.push_back({mesh.positions[p].x - middle.x, mesh.positions[p].y - middle.y});
  return points;
}

// The convex hull, anticlockwise (Andrew's monotone chain).
std::vector<Point> hullOf(std::vector<Point> points) {
  std::ranges::sort(points, [](const Point& a, const Point& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  });
  std::vector<Point> hull;
  const auto turnsLeft = [](const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
  };
  const auto walk = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= first + 2 &&
             !turnsLeft(hull[hull.size() - 2], hull[hull.size() - 1], *p))
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  walk(points.begin(), points.end());
  walk(points.rbegin(), points.rend());
  return hull;
}

// The extents of points along an angle and across it.
Point extentsOf(const std::vector<Point>& points, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const Point& p : points) {
    const double u = c * p.x + s * p.y, v = c * p.y - s * p.x;
    low = {std::min(low.x, u), std::min(low.y, v)};
    high = {std::max(high.x, u), std::max(high.y, v)};
  }
  return {high.x - low.x, high.y - low.y};
}

double areaOf(const Point& extents) { return extents.x * extents.y; }

// The angle across which most of the steep faces stand, where enough do.
std::optional<double> angleOfFaces(const TriangleMesh& mesh) {
  constexpr int kBins = 360;  // a quarter of a degree each
  std::array<double, kBins> bins{};
  std::vector<std::pair<double, double>> faces;  // angle, area
  double total = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d n = areaNormal(mesh, t);
    const double level = std::hypot(n.x, n.y);
    if (!(level > 0) || std::abs(n.z) > kSteep * length(n)) continue;
    const double angle = reduced(std::atan2(n.y, n.x));
    const double share = (angle + kQuarter / 2) / kQuarter;
    bins[std::min(kBins - 1, static_cast<int>(share * kBins))] += level;
    faces.emplace_back(angle, level);
    total += level;
  }
  if (!(total > 0)) return std::nullopt;
  constexpr int kReach = static_cast<int>(kAlignedWithin / kQuarter * kBins + 0.5);
  int best = 0;
  double most = -1;
  for (int bin = 0; bin < kBins; ++bin) {
    // The bin itself twice, so that the middle of what is equal wins.
    double sum = bins[bin];
    for (int d = -kReach; d <= kReach; ++d) sum += bins[(bin + d + kBins) % kBins];
    if (sum > most) {
      most = sum;
      best = bin;
    }
  }
  const double peak = (best + 0.5) / kBins * kQuarter - kQuarter / 2;
  double weight = 0, offset = 0;
  for (const auto& [angle, area] : faces) {
    const double off = reduced(angle - peak);
    if (std::abs(off) > kAlignedWithin) continue;
    weight += area;
    offset += area * off;
  }
  if (weight < kAligned * total) return std::nullopt;
  return reduced(peak + offset / weight);
}

}  // namespace

Footprint footprintOf(const TriangleMesh& mesh, const Progress& progress) {
  Footprint footprint;
  const std::vector<Point> points = pointsOf(mesh, boundingBox(mesh).center());
  if (points.size() < 3) return footprint;
  progress.check();
  const std::vector<Point> hull = hullOf(points);
  progress.check();
  const auto take = [&](double angle, bool straight) {
    const Point extents = extentsOf(hull, angle);
    footprint = {angle, extents.x, extents.y, straight};
    return footprint;
  };
  if (const std::optional<double> angle = angleOfFaces(mesh))
    return std::abs(*angle) < kFacesTurned ? take(0, true) : take(*angle, false);
  double least = areaOf(extentsOf(hull, 0)), angle = 0;
  const double box = least;
  for (std::size_t p = 0; p < hull.size(); ++p) {
    const Point &a = hull[p], &b = hull[(p + 1) % hull.size()];
    const double side = reduced(std::atan2(b.y - a.y, b.x - a.x));
    const double area = areaOf(extentsOf(hull, side));
    // Rounding does not decide between rectangles that are equally good.
    if (area < least * (1 - 1e-9)) {
      least = area;
      angle = side;
    }
  }
  if (std::abs(angle) < kRectangleTurned || least > kFilled * box) return take(0, true);
  return take(angle, false);
}

void turn(TriangleMesh& mesh, const Turn& by) {
  if (by.none()) return;
  for (Vec3d& p : mesh.positions) p = by(p);
}

}  // namespace exemplar
