// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/box_openings.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/polygon.h"

namespace exemplar {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
// The faces of a box that something lies in: bit 2 axis for the lower one, the next for the upper.
using Faces = std::uint8_t;

struct RimEdge {
  std::uint32_t a, b;
  Faces in;      // faces that the edge lies in
  Faces beside;  // faces that its triangle lies in: the rim of no opening there
  bool used = false;
};

// A loop of points of a rim in the plane of a face.
struct Loop {
  std::vector<std::uint32_t> points;
  double area = 0;  // twice, signed
};

double turnOf(const Vec3d& a, const Vec3d& b, const Vec3d& c, int u, int v) {
  return (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
}

class Openings {
 public:
  explicit Openings(const TriangleMesh& mesh) : box_(boundingBox(mesh)) {
    const Vec3d size = box_.size();
    tolerance_ = kInBoxFace * std::max({size.x, size.y, size.z});
    flat_ = !(std::min({size.x, size.y, size.z}) > 4 * tolerance_);
    if (!flat_) findRims(joined(mesh));
  }

  TriangleMesh close() {
    TriangleMesh caps;
    if (flat_ || rims_.empty()) return caps;
    for (int face = 0; face < 6; ++face) closeFace(face);
    caps.positions = points_;
    caps.triangles = std::move(caps_);
    return caps;
  }

 private:
  Faces facesOf(const Vec3d& p) const {
    Faces faces = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] - box_.min[axis] <= tolerance_) faces |= 1 << (2 * axis);
      if (box_.max[axis] - p[axis] <= tolerance_) faces |= 2 << (2 * axis);
    }
    return faces;
  }

  // The mesh's triangles that have an edge in a face, each once, with equal positions joined.
  std::vector<Triangle> joined(const TriangleMesh& mesh) {
    std::vector<Faces> faces(mesh.positions.size());
    for (std::size_t p = 0; p < faces.size(); ++p) faces[p] = facesOf(mesh.positions[p]);
    std::vector<Triangle> beside;
    std::vector<std::uint8_t> used(mesh.positions.size());
    for (const Triangle& t : mesh.triangles) {
      const Faces a = faces[t[0]], b = faces[t[1]], c = faces[t[2]];
      if (((a & b) | (b & c) | (c & a)) == 0) continue;
      beside.push_back(t);
      for (const std::uint32_t corner : t) used[corner] = 1;
    }
    std::vector<std::uint32_t> order, point(mesh.positions.size());
    for (std::uint32_t n = 0; n < used.size(); ++n)
      if (used[n]) order.push_back(n);
    const auto key = [&](std::uint32_t n) {
      const Vec3d& p = mesh.positions[n];
      return std::tie(p.x, p.y, p.z);
    };
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      return key(a) != key(b) ? key(a) < key(b) : a < b;
    });
    for (const std::uint32_t n : order) {
      if (points_.empty() || !(points_.back() == mesh.positions[n]))
        points_.push_back(mesh.positions[n]);
      point[n] = static_cast<std::uint32_t>(points_.size() - 1);
    }
    for (const Vec3d& p : points_) faces_.push_back(facesOf(p));
    std::vector<std::pair<Triangle, Triangle>> keyed;  // sorted corners first
    for (Triangle t : beside) {
      for (std::uint32_t& corner : t) corner = point[corner];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      Triangle sorted = t;
      std::ranges::sort(sorted);
      keyed.emplace_back(sorted, t);
    }
    std::ranges::sort(keyed);
    std::vector<Triangle> triangles;
    for (std::size_t n = 0; n < keyed.size(); ++n)
      if (n == 0 || keyed[n].first != keyed[n - 1].first) triangles.push_back(keyed[n].second);
    return triangles;
  }

  Faces facesOf(const Triangle& t) const { return faces_[t[0]] & faces_[t[1]] & faces_[t[2]]; }

  // Edges of an odd number of triangles.
  void findRims(const std::vector<Triangle>& triangles) {
    struct Side {
      std::uint32_t a, b;
      Faces beside;
    };
    std::vector<Side> sides;
    for (const Triangle& t : triangles) {
      const Faces beside = facesOf(t);
      for (int face = 0; face < 6; ++face)
        if (beside >> face & 1) covers_[face].push_back(t);
      for (int s = 0; s < 3; ++s)
        if ((faces_[t[s]] & faces_[t[(s + 1) % 3]]) != 0)
          sides.push_back({std::min(t[s], t[(s + 1) % 3]), std::max(t[s], t[(s + 1) % 3]), beside});
    }
    std::ranges::sort(sides, [](const Side& l, const Side& r) {
      return std::tie(l.a, l.b, l.beside) < std::tie(r.a, r.b, r.beside);
    });
    for (std::size_t b = 0, e = 0; b < sides.size(); b = e) {
      while (e < sides.size() && sides[e].a == sides[b].a && sides[e].b == sides[b].b) ++e;
      const Faces in = faces_[sides[b].a] & faces_[sides[b].b];
      if ((e - b) % 2 != 0) rims_.push_back({sides[b].a, sides[b].b, in, sides[b].beside});
    }
  }

  // The other face in which an opening goes on at the end of a rim; 6 where there is no single one.
  int nextFace(std::uint32_t point, int face) const {
    Faces found = 0;
    for (const std::uint32_t r : rimsAt_.at(point)) {
      const RimEdge& rim = rims_[r];
      if (!rim.used) found |= rim.in & ~rim.beside;
    }
    found &= faces_[point] & ~(1 << face);
    return std::has_single_bit(found) ? std::countr_zero(found) : 6;
  }

  void closeFace(int face) {
    const auto isRim = [&](const RimEdge& rim) {
      return !rim.used && (rim.in >> face & 1) && !(rim.beside >> face & 1);
    };
    rimsAt_.clear();
    std::map<std::uint32_t, std::vector<std::uint32_t>> at;
    for (std::uint32_t r = 0; r < rims_.size(); ++r) {
      for (const std::uint32_t p : {rims_[r].a, rims_[r].b}) {
        if (!rims_[r].used) rimsAt_[p].push_back(r);
        if (isRim(rims_[r])) at[p].push_back(r);
      }
    }
    if (at.empty()) return;
    // The ends of chains, joined along the box's edges: every other stretch between them is open.
    std::map<int, std::vector<std::uint32_t>> ends;
    for (const auto& [point, edges] : at)
      if (edges.size() == 1)
        if (const int next = nextFace(point, face); next < 6) ends[next].push_back(point);
    std::vector<RimEdge> closing;
    for (auto& [next, points] : ends) {
      const int along = 3 - face / 2 - next / 2;
      if (points.size() % 2 != 0) continue;
      std::ranges::sort(points, [&, along](std::uint32_t p, std::uint32_t q) {
        return std::pair(points_[p][along], p) < std::pair(points_[q][along], q);
      });
      for (std::size_t n = 0; n < points.size(); n += 2) {
        const std::uint32_t a = points[n], b = points[n + 1];
        closing.push_back(
            {a, b, static_cast<Faces>(faces_[a] & faces_[b]), static_cast<Faces>(1 << face)});
      }
    }
    const auto firstClosing = static_cast<std::uint32_t>(rims_.size());
    for (const RimEdge& edge : closing) {
      for (const std::uint32_t p : {edge.a, edge.b})
        at[p].push_back(static_cast<std::uint32_t>(rims_.size()));
      rims_.push_back(edge);
    }
    std::vector<std::uint8_t> kept(closing.size());
    for (const std::vector<Loop>& region : regions(loopsOf(at), face)) {
      if (!fill(region, face)) continue;
      for (const Loop& loop : region)
        for (std::size_t n = 0; n < loop.points.size(); ++n) {
          const std::uint32_t p = loop.points[n], q = loop.points[(n + 1) % loop.points.size()];
          for (const std::uint32_t r : at[p]) {
            if (rims_[r].a != q && rims_[r].b != q) continue;
            if (r < firstClosing) rims_[r].used = true;
            if (r >= firstClosing) kept[r - firstClosing] = 1;
          }
        }
    }
    for (std::size_t c = 0; c < kept.size(); ++c)
      if (!kept[c]) rims_[firstClosing + c].used = true;
  }

  // The closed loops of edges that meet two at each point.
  std::vector<Loop> loopsOf(const std::map<std::uint32_t, std::vector<std::uint32_t>>& at) const {
    std::vector<Loop> loops;
    std::vector<std::uint8_t> walked(rims_.size());
    for (const auto& [start, edges] : at) {
      if (edges.size() != 2 || walked[edges[0]]) continue;
      Loop loop;
      std::uint32_t point = start, edge = edges[0];
      bool closed = true;
      do {
        walked[edge] = 1;
        loop.points.push_back(point);
        point = rims_[edge].a == point ? rims_[edge].b : rims_[edge].a;
        const auto& next = at.at(point);
        closed = next.size() == 2;
        if (closed) edge = next[0] == edge ? next[1] : next[0];
      } while (closed && point != start);
      if (closed && loop.points.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
  }

  bool contains(const Loop& loop, const Vec3d& p, int u, int v) const {
    bool in = false;
    for (std::size_t n = 0; n < loop.points.size(); ++n) {
      const Vec3d &a = points_[loop.points[n]],
                  &b = points_[loop.points[(n + 1) % loop.points.size()]];
      if ((a[v] > p[v]) == (b[v] > p[v])) continue;
      if (p[u] < a[u] + (p[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u])) in = !in;
    }
    return in;
  }

  // Loops that lie within an odd number of others are holes of the smallest of them.
  std::vector<std::vector<Loop>> regions(std::vector<Loop> loops, int face) const {
    const int u = (face / 2 + 1) % 3, v = (face / 2 + 2) % 3;
    for (Loop& loop : loops) {
      const Vec3d base = points_[loop.points[0]];
      for (std::size_t n = 1; n + 1 < loop.points.size(); ++n)
        loop.area += turnOf(base, points_[loop.points[n]], points_[loop.points[n + 1]], u, v);
    }
    std::erase_if(loops, [&](const Loop& l) {
      return !(std::abs(l.area) > tolerance_ * tolerance_) || l.points.size() > kMostCorners;
    });
    std::ranges::stable_sort(
        loops, [](const Loop& a, const Loop& b) { return std::abs(a.area) > std::abs(b.area); });
    std::vector<std::vector<Loop>> regions;
    std::vector<std::size_t> regionOf(loops.size());
    for (std::size_t n = 0; n < loops.size(); ++n) {
      std::size_t within = 0, parent = n;
      for (std::size_t m = 0; m < n; ++m)
        if (contains(loops[m], points_[loops[n].points[0]], u, v)) {
          ++within;
          parent = m;
        }
      const bool hole = within % 2 != 0;
      // Outer loops run anticlockwise in the plane, holes clockwise.
      if ((loops[n].area > 0) == hole) std::ranges::reverse(loops[n].points);
      regionOf[n] = hole ? regionOf[parent] : regions.size();
      if (!hole) regions.emplace_back();
      regions[regionOf[n]].push_back(loops[n]);
    }
    return regions;
  }

  // Whether two segments of a face's plane cross, other than at common ends.
  bool cross(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, int u,
             int v) const {
    if (a == c || a == d || b == c || b == d) return false;
    const auto side = [&](std::uint32_t p, std::uint32_t q, std::uint32_t r) {
      return turnOf(points_[p], points_[q], points_[r], u, v);
    };
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
  }

  // Joins a hole to a polygon by the shortest cut that crosses neither, there and back.
  bool cutTo(std::vector<std::uint32_t>& polygon, const std::vector<std::uint32_t>& hole,
             const std::vector<Loop>& all, int u, int v) const {
    struct Cut {
      double length;
      std::size_t from, to;
      bool operator<(const Cut& o) const {
        return std::tie(length, from, to) < std::tie(o.length, o.from, o.to);
      }
    };
    std::vector<Cut> cuts;
    for (std::size_t p = 0; p < polygon.size(); ++p)
      for (std::size_t h = 0; h < hole.size(); ++h)
        cuts.push_back({length(points_[polygon[p]] - points_[hole[h]]), p, h});
    std::sort(cuts.begin(), cuts.end());
    for (const Cut& cut : cuts) {
      const std::uint32_t a = polygon[cut.from], b = hole[cut.to];
      bool free = true;
      const auto blocks = [&](const std::vector<std::uint32_t>& loop) {
        for (std::size_t n = 0; n < loop.size() && free; ++n)
          free = !cross(a, b, loop[n], loop[(n + 1) % loop.size()], u, v);
      };
      blocks(polygon);
      for (const Loop& loop : all) blocks(loop.points);
      if (!free) continue;
      std::vector<std::uint32_t> joined(
          polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(cut.from) + 1);
      for (std::size_t h = 0; h <= hole.size(); ++h)
        joined.push_back(hole[(cut.to + h) % hole.size()]);
      joined.insert(joined.end(), polygon.begin() + static_cast<std::ptrdiff_t>(cut.from),
                    polygon.end());
      polygon = std::move(joined);
      return true;
    }
    return false;
  }

  // Fills an outer loop with holes by triangles. False where it cannot be, or triangles in the face
  // cover it already.
  bool fill(const std::vector<Loop>& region, int face) {
    const int u = (face / 2 + 1) % 3, v = (face / 2 + 2) % 3;
    std::vector<std::uint32_t> polygon = region[0].points;
    for (std::size_t hole = 1; hole < region.size(); ++hole)
      if (polygon.size() > kMostCorners || !cutTo(polygon, region[hole].points, region, u, v))
        return false;
    std::vector<Vec3d> corners;
    for (const std::uint32_t p : polygon) corners.push_back(points_[p]);
    std::vector<Triangle> filled;
    if (!triangulate(corners, filled)) return false;
    for (Triangle& t : filled)
      for (std::uint32_t& corner : t) corner = polygon[corner];
    double open = 0, covered = 0;
    for (const Triangle& t : filled) {
      const Vec3d &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
      const double area = std::abs(turnOf(a, b, c, u, v));
      (isCovered((a + b + c) / 3.0, face, u, v) ? covered : open) += area;
    }
    if (covered > open) return false;
    caps_.insert(caps_.end(), filled.begin(), filled.end());
    return true;
  }

  bool isCovered(const Vec3d& p, int face, int u, int v) const {
    return std::ranges::any_of(covers_[face], [&](const Triangle& t) {
      const double ab = turnOf(points_[t[0]], points_[t[1]], p, u, v),
                   bc = turnOf(points_[t[1]], points_[t[2]], p, u, v),
                   ca = turnOf(points_[t[2]], points_[t[0]], p, u, v);
      return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    });
  }

  Box3d box_;
  double tolerance_ = 0;
  bool flat_ = true;
  std::vector<Vec3d> points_;
  std::vector<Faces> faces_;  // of each point
  std::vector<RimEdge> rims_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> rimsAt_;
  std::array<std::vector<Triangle>, 6> covers_;  // triangles in each face
  std::vector<Triangle> caps_;
};

}  // namespace

TriangleMesh boxOpenings(const TriangleMesh& mesh) {
  TriangleMesh caps = Openings(mesh).close();
  if (caps.triangles.empty()) caps.positions.clear();
  return caps;
}

}  // namespace exemplar
