// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/convex_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace exemplar::continuous {
namespace {

/// Points nearer to a plane are on it: rounding of coordinates below 2^17 after a few cuts.
constexpr double kOnPlane = 1e-7;

double level(const ExactPlane& plane, const Vec3d& p) {
  const Vec3d n = cast<double>(plane.normal);
  return (dot(n, p) - static_cast<double>(plane.offset)) / length(n);
}

/// What of a polygon is not above a plane; empty where that is less than a triangle.
std::vector<Vec3d> clipped(const std::vector<Vec3d>& polygon, const ExactPlane& plane) {
  std::vector<Vec3d> kept;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3d &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    const double la = level(plane, a), lb = level(plane, b);
    if (la <= kOnPlane) kept.push_back(a);
    if ((la > kOnPlane && lb < -kOnPlane) || (la < -kOnPlane && lb > kOnPlane))
      kept.push_back(a + (b - a) * (la / (la - lb)));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

double area(const std::vector<Vec3d>& polygon) {
  Vec3d sum;
  for (std::size_t n = 2; n < polygon.size(); ++n)
    sum += cross(polygon[n - 1] - polygon[0], polygon[n] - polygon[0]);
  return length(sum) / 2;
}

/// The side that a cut makes: points on the plane, in order around their middle.
ConvexCell::Side cutSide(const ConvexCell& cell, const ExactPlane& plane) {
  ConvexCell::Side side{plane, {}};
  for (const Vec3d& p : cell.corners()) {
    const bool known = std::ranges::any_of(
        side.corners, [&](const Vec3d& q) { return length(p - q) < 4 * kOnPlane; });
    if (!known && std::abs(level(plane, p)) <= 2 * kOnPlane) side.corners.push_back(p);
  }
  if (side.corners.size() < 3) return side;
  Vec3d middle;
  for (const Vec3d& p : side.corners) middle += p / static_cast<double>(side.corners.size());
  const Vec3d n = normalized(cast<double>(plane.normal));
  const Vec3d u = normalized(side.corners[0] - middle), v = cross(n, u);
  std::ranges::sort(side.corners, {}, [&](const Vec3d& p) {
    return std::atan2(dot(p - middle, v), dot(p - middle, u));
  });
  return side;
}

/// What of a cell is below a plane.
ConvexCell below(const ConvexCell& cell, const ExactPlane& plane) {
  double low = 0, high = 0;
  for (const Vec3d& p : cell.corners()) {
    low = std::min(low, level(plane, p));
    high = std::max(high, level(plane, p));
  }
  if (high <= kOnPlane) return cell;
  if (low >= -kOnPlane) return {};
  ConvexCell made;
  for (const ConvexCell::Side& side : cell.sides) {
    std::vector<Vec3d> kept = clipped(side.corners, plane);
    if (area(kept) > kOnPlane) made.sides.push_back({side.plane, std::move(kept)});
  }
  ConvexCell::Side cut = cutSide(made, plane);
  if (area(cut.corners) > kOnPlane) made.sides.push_back(std::move(cut));
  if (made.empty()) made.sides.clear();
  return made;
}

ConvexCell cellOf(const ExactBox& box) {
  ConvexCell cell;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      Vec3l n;
      n[axis] = side;
      const std::int64_t at = side > 0 ? box.high[axis] : box.low[axis];
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      ConvexCell::Side made{{n, side * at}, {}};
      for (int c = 0; c < 4; ++c) {
        Vec3d p;
        p[axis] = static_cast<double>(at);
        p[u] = static_cast<double>(c == 1 || c == 2 ? box.high[u] : box.low[u]);
        p[v] = static_cast<double>(c >= 2 ? box.high[v] : box.low[v]);
        made.corners.push_back(p);
      }
      cell.sides.push_back(std::move(made));
    }
  }
  return cell;
}

class Partition {
 public:
  Partition(std::span<const ExactPlane> planes, double room,
            const std::function<bool(const ConvexCell&)>& inside, const Progress& progress)
      : planes_(planes), room_(room), inside_(inside), progress_(progress) {}

  struct Cells {
    std::vector<ConvexCell> inside;
    bool all = false;  // the whole cell is
  };
  Cells split(const ConvexCell& cell, std::vector<SurfacePolygon> polygons) const {
    progress_.check();
    while (!polygons.empty()) {
      const std::uint32_t chosen = largest(polygons);
      const ExactPlane plane = planes_[chosen], back{-plane.normal, -plane.offset};
      std::erase_if(polygons, [&](const SurfacePolygon& p) { return p.plane == chosen; });
      const ConvexCell low = below(cell, plane), high = below(cell, back);
      if (low.empty() || high.empty()) continue;
      Cells made = split(low, part(polygons, plane));
      Cells other = split(high, part(polygons, back));
      if (made.all && other.all) return {{cell}, true};
      made.all = false;
      std::ranges::move(other.inside, std::back_inserter(made.inside));
      return made;
    }
    if (!inside_(cell)) return {};
    return {{cell}, true};
  }

 private:
  /// The plane with most of the surface in a cell: it cuts the fewest others, as a rule.
  static std::uint32_t largest(const std::vector<SurfacePolygon>& polygons) {
    std::map<std::uint32_t, double> areas;
    for (const SurfacePolygon& p : polygons) areas[p.plane] += area(p.corners);
    return std::ranges::max_element(areas, {}, [](const auto& entry) { return entry.second; })
        ->first;
  }
  std::vector<SurfacePolygon> part(const std::vector<SurfacePolygon>& polygons,
                                   const ExactPlane& plane) const {
    std::vector<SurfacePolygon> kept;
    for (const SurfacePolygon& p : polygons) {
      const double deepest =
          level(plane, *std::ranges::min_element(p.corners, {},
                                                 [&](const Vec3d& q) { return level(plane, q); }));
      if (deepest > -room_) continue;
      std::vector<Vec3d> corners = clipped(p.corners, plane);
      if (area(corners) > 0.01 * room_ * room_) kept.push_back({std::move(corners), p.plane});
    }
    return kept;
  }

  std::span<const ExactPlane> planes_;
  double room_;
  const std::function<bool(const ConvexCell&)>& inside_;
  const Progress& progress_;
};

}  // namespace

std::vector<Vec3d> ConvexCell::corners() const {
  std::vector<Vec3d> all;
  for (const Side& side : sides) all.insert(all.end(), side.corners.begin(), side.corners.end());
  return all;
}

std::vector<ConvexCell> convexCells(const ExactBox& box, std::span<const ExactPlane> planes,
                                    std::vector<SurfacePolygon> polygons, double room,
                                    const std::function<bool(const ConvexCell&)>& inside,
                                    const Progress& progress) {
  return Partition(planes, room, inside, progress).split(cellOf(box), std::move(polygons)).inside;
}

}  // namespace exemplar::continuous
