// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/cell_cut.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/memory.h"
#include "core/stoppable.h"

namespace exemplar {
namespace {

using Polygon = std::vector<CutPoint>;

double snapped(double x, double tolerance) {
  const double whole = std::round(x);
  return std::abs(x - whole) <= tolerance ? whole : x;
}

bool comesBefore(const Vec3d& a, const Vec3d& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

class Cutter {
 public:
  Cutter(const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& cellSize, const Vec3i& size,
         double tolerance, const Progress& progress)
      : mesh_(mesh),
        origin_(origin),
        cellSize_(cellSize),
        size_(size),
        tolerance_(tolerance),
        progress_(progress) {
    cut_.size = size;
  }

  CellCut cut() {
    requireParts();
    const double triangles = static_cast<double>(mesh_.triangles.size());
    for (triangle_ = 0; triangle_ < mesh_.triangles.size(); ++triangle_) {
      if (triangle_ % 1024 == 0) progress_.report(kStage, 0.8 * triangle_ / triangles);
      Polygon polygon(3);
      for (int c = 0; c < 3; ++c) {
        const Vec3d p = mesh_.positions[mesh_.triangles[triangle_][c]] - origin_;
        for (int axis = 0; axis < 3; ++axis) {
          polygon[c].p[axis] = snapped(p[axis] / cellSize_[axis], tolerance_);
        }
        polygon[c].weights[c] = 1;
      }
      normal_ = cross(polygon[1].p - polygon[0].p, polygon[2].p - polygon[0].p);
      if (length(normal_) > 0) split(std::move(polygon), 0, {});
    }
    progress_.report(kStage, 0.8);
    sortByCell();
    return std::move(cut_);
  }

 private:
  static constexpr const char* kStage = "cutting triangles along cells";

  /// A bound on the parts from the triangles' boxes, so that a tiny cell is refused and not tried.
  void requireParts() const {
    double parts = 0;
    for (const auto& triangle : mesh_.triangles) {
      Box3d box;
      for (const std::uint32_t v : triangle) box.add(mesh_.positions[v]);
      // A triangle meets no more cells than its three projections together.
      Vec3d cells;
      for (int axis = 0; axis < 3; ++axis) {
        cells[axis] = std::min<double>(box.size()[axis] / cellSize_[axis] + 1, size_[axis]);
      }
      parts += cells.x * cells.y + cells.y * cells.z + cells.z * cells.x;
    }
    requireMemory(64 * parts + 8.0 * static_cast<double>(volume(size_)),
                  "the mesh cut along the grid", "use a larger `cell`");
  }

  /// Cuts a polygon along the planes across `axis`, and each part along those of the next axis.
  void split(Polygon polygon, int axis, Vec3i cell) {
    if (axis == 3) return add(polygon, cell);
    double low = polygon[0].p[axis], high = low;
    for (const CutPoint& point : polygon) {
      low = std::min(low, point.p[axis]);
      high = std::max(high, point.p[axis]);
    }
    const double end = size_[axis];
    if (high < 0 || low > end) return;
    if (low == high && low == std::round(low)) {
      cell[axis] = static_cast<int>(std::clamp(normal_[axis] > 0 ? low - 1 : low, 0.0, end - 1));
      return split(std::move(polygon), axis + 1, cell);
    }
    if (low < 0) {
      polygon = halves(polygon, axis, 0).second;
      low = 0;
    }
    for (double layer = std::floor(low); layer < std::min(high, end); ++layer) {
      if (axis == 0) progress_.check();
      cell[axis] = static_cast<int>(layer);
      if (layer + 1 >= high) {
        if (polygon.size() >= 3) split(std::move(polygon), axis + 1, cell);
        return;
      }
      auto [below, above] = halves(polygon, axis, layer + 1);
      if (below.size() >= 3) split(std::move(below), axis + 1, cell);
      polygon = std::move(above);
    }
  }

  /// The parts of a convex polygon on the two sides of a plane; points on it belong to both.
  std::pair<Polygon, Polygon> halves(const Polygon& polygon, int axis, double plane) const {
    Polygon below, above;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
      const CutPoint& a = polygon[n];
      const CutPoint& b = polygon[(n + 1) % polygon.size()];
      if (a.p[axis] <= plane) below.push_back(a);
      if (a.p[axis] >= plane) above.push_back(a);
      if ((a.p[axis] < plane) != (b.p[axis] < plane) && a.p[axis] != plane && b.p[axis] != plane) {
        const CutPoint point = crossing(a, b, axis, plane);
        below.push_back(point);
        above.push_back(point);
      }
    }
    return {std::move(below), std::move(above)};
  }

  /// Where an edge meets a plane: the same point whichever way the edge is run through.
  CutPoint crossing(const CutPoint& a, const CutPoint& b, int axis, double plane) const {
    const bool swap = comesBefore(b.p, a.p);
    const CutPoint& from = swap ? b : a;
    const CutPoint& to = swap ? a : b;
    const double t = (plane - from.p[axis]) / (to.p[axis] - from.p[axis]);
    CutPoint point;
    for (int i = 0; i < 3; ++i) {
      point.p[i] = snapped(from.p[i] + (to.p[i] - from.p[i]) * t, tolerance_);
      point.weights[i] = from.weights[i] + (to.weights[i] - from.weights[i]) * t;
    }
    point.p[axis] = plane;
    return point;
  }

  void add(const Polygon& polygon, const Vec3i& cell) {
    const auto begin = static_cast<std::uint32_t>(cut_.points.size());
    for (const CutPoint& point : polygon) {
      if (cut_.points.size() > begin && cut_.points.back().p == point.p) continue;
      cut_.points.push_back(point);
    }
    while (cut_.points.size() > begin + 1 && cut_.points.back().p == cut_.points[begin].p) {
      cut_.points.pop_back();
    }
    const auto count = static_cast<std::uint32_t>(cut_.points.size()) - begin;
    const CutPolygon part{static_cast<std::uint32_t>(triangle_), begin, count};
    if (count < 3 || length(areaNormal(cut_, part)) == 0) {
      cut_.points.resize(begin);
      return;
    }
    cut_.polygons.push_back(part);
    cellOf_.push_back((static_cast<std::uint64_t>(cell.z) * size_.y + cell.y) * size_.x + cell.x);
  }

  void sortByCell() {
    std::vector<std::uint32_t> order(cut_.polygons.size());
    std::iota(order.begin(), order.end(), 0u);
    sortInParallel(order, progress_, [&](std::uint32_t a, std::uint32_t b) {
      return cellOf_[a] != cellOf_[b] ? cellOf_[a] < cellOf_[b] : a < b;
    });
    std::vector<CutPolygon> sorted;
    sorted.reserve(order.size());
    cut_.first = filled<HugeVector<std::uint32_t>>(static_cast<std::size_t>(volume(size_)) + 1, 0,
                                                   progress_);
    for (const std::uint32_t n : order) {
      if (looksUp(sorted.size())) progress_.check();
      sorted.push_back(cut_.polygons[n]);
      ++cut_.first[cellOf_[n] + 1];
    }
    for (std::size_t c = 1; c < cut_.first.size(); ++c) {
      if (looksUp(c)) progress_.check();
      cut_.first[c] += cut_.first[c - 1];
    }
    cut_.polygons = std::move(sorted);
  }

  const TriangleMesh& mesh_;
  Vec3d origin_, cellSize_;
  Vec3i size_;
  double tolerance_;
  const Progress& progress_;
  std::size_t triangle_ = 0;
  Vec3d normal_;
  CellCut cut_;
  std::vector<std::uint64_t> cellOf_;
};

}  // namespace

CellCut cutAlongCells(const TriangleMesh& mesh, const Vec3d& origin, const Vec3d& cellSize,
                      const Vec3i& size, double tolerance, const Progress& progress) {
  return Cutter(mesh, origin, cellSize, size, tolerance, progress).cut();
}

Vec3d areaNormal(const CellCut& cut, const CutPolygon& polygon) {
  const CutPoint* points = &cut.points[polygon.first];
  Vec3d sum{};
  for (std::uint32_t n = 2; n < polygon.count; ++n) {
    sum += cross(points[n - 1].p - points[0].p, points[n].p - points[0].p);
  }
  return sum;
}

}  // namespace exemplar
