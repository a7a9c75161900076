// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Faces with holes into triangles: holes are joined to the outline by bridges, ears are cut off.
// D. Eberly, "Triangulation by Ear Clipping" (2002). Signs of turns are exact.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/loop_progress.h"
#include "core/parallel.h"
#include "synth/continuous/polygons.h"
#include "synth/continuous/touching.h"

namespace exemplar::continuous {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

class EarClipper {
 public:
  EarClipper(const PolygonModel& model, const Polygon& polygon)
      : model_(model), polygon_(polygon), normal_(polygon.plane.normal) {
    const Vec3l size{std::abs(normal_.x), std::abs(normal_.y), std::abs(normal_.z)};
    drop_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  /// Appends triangles that are counterclockwise seen from the tip of the normal.
  void run(std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> rings;
    for (const std::vector<std::uint32_t>& loop : polygon_.loops) rings.push_back(addRing(loop));
    std::vector<std::uint32_t> holes;
    for (std::size_t n = 1; n < rings.size(); ++n) holes.push_back(leftmost(rings[n]));
    std::ranges::sort(holes, [&](std::uint32_t a, std::uint32_t b) {
      return u_[a] != u_[b] ? u_[a] < u_[b] : v_[a] < v_[b];
    });
    for (const std::uint32_t hole : holes) bridge(rings[0], hole);
    makeGrid();
    clip(rings[0], triangles);
  }

 private:
  std::uint32_t add(std::uint32_t point) {
    const Vec3d p = model_.points[point].approximately();
    const double flip = normal_[drop_] < 0 ? -1 : 1;
    point_.push_back(point);
    u_.push_back(p[(drop_ + 1) % 3]);
    v_.push_back(flip * p[(drop_ + 2) % 3]);
    next_.push_back(0);
    previous_.push_back(0);
    gone_.push_back(0);
    return static_cast<std::uint32_t>(point_.size() - 1);
  }
  std::uint32_t addRing(const std::vector<std::uint32_t>& corners) {
    const auto first = static_cast<std::uint32_t>(point_.size());
    const auto n = static_cast<std::uint32_t>(corners.size());
    for (const std::uint32_t corner : corners) add(corner);
    for (std::uint32_t c = 0; c < n; ++c) {
      next_[first + c] = first + (c + 1) % n;
      previous_[first + c] = first + (c + n - 1) % n;
    }
    return first;
  }
  std::uint32_t leftmost(std::uint32_t ring) const {
    std::uint32_t best = ring;
    for (std::uint32_t n = next_[ring]; n != ring; n = next_[n])
      if (u_[n] < u_[best] || (u_[n] == u_[best] && v_[n] < v_[best])) best = n;
    return best;
  }

  /// The sign of the turn a, b, c: by rounded numbers where these are sure, else exact.
  int turnOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const double x = (u_[b] - u_[a]) * (v_[c] - v_[a]), y = (v_[b] - v_[a]) * (u_[c] - u_[a]);
    const double most = std::max({std::abs(u_[a]), std::abs(u_[b]), std::abs(u_[c]),
                                  std::abs(v_[a]), std::abs(v_[b]), std::abs(v_[c])});
    const double reach = std::max({std::abs(u_[b] - u_[a]), std::abs(u_[c] - u_[a]),
                                   std::abs(v_[b] - v_[a]), std::abs(v_[c] - v_[a])});
    const double bound = 0x1p-49 * reach * (most + reach);
    if (x - y > bound) return 1;
    if (x - y < -bound) return -1;
    return turn(model_.points[point_[a]], model_.points[point_[b]], model_.points[point_[c]],
                normal_);
  }

  bool samePoint(std::uint32_t a, std::uint32_t b) const { return point_[a] == point_[b]; }

  /// Whether p is in the triangle a, b, c or on its border.
  bool covers(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const {
    return turnOf(a, b, p) >= 0 && turnOf(b, c, p) >= 0 && turnOf(c, a, p) >= 0;
  }
  /// Whether a vertex sees the direction of another one between its two edges.
  bool facing(std::uint32_t at, std::uint32_t to) const {
    const int left = turnOf(at, next_[at], to), right = turnOf(previous_[at], at, to);
    return turnOf(previous_[at], at, next_[at]) > 0 ? left > 0 && right > 0 : left > 0 || right > 0;
  }

  /// Joins a hole's leftmost vertex to one of the outline that it sees to its left.
  void bridge(std::uint32_t& ring, std::uint32_t hole) {
    const std::uint32_t to = visibleFrom(ring, hole);
    // to - hole ... around the hole ... - copy of hole - copy of to - what followed.
    const std::uint32_t after = next_[to], last = previous_[hole];
    const std::uint32_t hole2 = add(point_[hole]), to2 = add(point_[to]);
    next_[to] = hole;
    previous_[hole] = to;
    next_[last] = hole2;
    previous_[hole2] = last;
    next_[hole2] = to2;
    previous_[to2] = hole2;
    next_[to2] = after;
    previous_[after] = to2;
  }

  std::uint32_t visibleFrom(std::uint32_t ring, std::uint32_t hole) const {
    const double hu = u_[hole], hv = v_[hole];
    double reach = -std::numeric_limits<double>::infinity();
    std::uint32_t best = ring;
    bool found = false;
    std::uint32_t n = ring;
    do {
      if (samePoint(n, hole) && facing(n, next_[hole])) return n;
      const std::uint32_t m = next_[n];
      // The outline runs down where the hole is to the right of it.
      if (v_[n] >= hv && v_[m] <= hv && v_[n] != v_[m]) {
        const double at = u_[n] + (hv - v_[n]) * (u_[m] - u_[n]) / (v_[m] - v_[n]);
        if (at <= hu && at > reach) {
          reach = at;
          best = u_[n] < u_[m] ? n : m;
          if (v_[n] == hv) best = n;
          if (v_[m] == hv) best = m;
          found = true;
        }
      }
      n = m;
    } while (n != ring);
    if (!found) return ring;
    // A vertex in the triangle of the hole, the point to its left, and `best`, hides that; the one
    // nearest to the direction of the ray is seen.
    const double bu = u_[best], bv = v_[best];
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t seen = best;
    n = ring;
    do {
      const double pu = u_[n], pv = v_[n];
      if (pu <= hu && pu >= std::min(bu, reach) && !samePoint(n, hole) &&
          inside(hu, hv, reach, hv, bu, bv, pu, pv) && facing(n, hole)) {
        const double steep = std::abs(pv - hv) / std::max(hu - pu, 1e-300);
        if (steep < least || (steep == least && pu > u_[seen])) {
          least = steep;
          seen = n;
        }
      }
      n = next_[n];
    } while (n != ring);
    return seen;
  }
  static bool inside(double au, double av, double bu, double bv, double cu, double cv, double pu,
                     double pv) {
    const double ab = (bu - au) * (pv - av) - (bv - av) * (pu - au);
    const double bc = (cu - bu) * (pv - bv) - (cv - bv) * (pu - bu);
    const double ca = (au - cu) * (pv - cv) - (av - cv) * (pu - cu);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  }

  // Vertices in square cells, so that an ear asks those near it only.
  void makeGrid() {
    low_[0] = low_[1] = std::numeric_limits<double>::infinity();
    double high[2] = {-low_[0], -low_[0]};
    for (std::size_t n = 0; n < point_.size(); ++n) {
      low_[0] = std::min(low_[0], u_[n]);
      low_[1] = std::min(low_[1], v_[n]);
      high[0] = std::max(high[0], u_[n]);
      high[1] = std::max(high[1], v_[n]);
    }
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(point_.size()) / 2)));
    for (int axis = 0; axis < 2; ++axis)
      scale_[axis] = side_ / std::max(high[axis] - low_[axis], 1e-300);
    cells_.assign(static_cast<std::size_t>(side_) * side_, {});
    for (std::uint32_t n = 0; n < point_.size(); ++n)
      cells_[static_cast<std::size_t>(cell(v_[n], 1)) * side_ + cell(u_[n], 0)].push_back(n);
  }
  int cell(double x, int axis) const {
    return std::clamp(static_cast<int>((x - low_[axis]) * scale_[axis]), 0, side_ - 1);
  }

  bool isEar(std::uint32_t b) const {
    const std::uint32_t a = previous_[b], c = next_[b];
    if (turnOf(a, b, c) <= 0) return false;
    const int u0 = cell(std::min({u_[a], u_[b], u_[c]}), 0);
    const int u1 = cell(std::max({u_[a], u_[b], u_[c]}), 0);
    const int v0 = cell(std::min({v_[a], v_[b], v_[c]}), 1);
    const int v1 = cell(std::max({v_[a], v_[b], v_[c]}), 1);
    for (int v = v0; v <= v1; ++v) {
      for (int u = u0; u <= u1; ++u) {
        for (const std::uint32_t p : cells_[static_cast<std::size_t>(v) * side_ + u]) {
          if (gone_[p] || p == a || p == b || p == c) continue;
          if (samePoint(p, a) || samePoint(p, b) || samePoint(p, c)) {
            // Another visit of a corner: it blocks where its own outline goes into the ear.
            if (entersEar(a, b, c, p)) return false;
            continue;
          }
          if (covers(a, b, c, p)) return false;
        }
      }
    }
    return true;
  }
  bool entersEar(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const {
    for (const std::uint32_t q : {next_[p], previous_[p]}) {
      if (samePoint(q, a) || samePoint(q, b) || samePoint(q, c)) continue;
      const std::uint32_t at = samePoint(p, a) ? a : samePoint(p, b) ? b : c;
      const std::uint32_t left = at == a ? b : at == b ? c : a;
      const std::uint32_t right = at == a ? c : at == b ? a : b;
      if (turnOf(at, left, q) > 0 && turnOf(at, right, q) < 0) return true;
    }
    return false;
  }

  void clip(std::uint32_t at, std::vector<Triangle>& triangles) {
    std::size_t left = 1;
    for (std::uint32_t n = next_[at]; n != at; n = next_[n]) ++left;
    std::size_t tried = 0;
    while (left > 3) {
      // No ear: what is left touches itself; a convex corner, or any, is as good.
      const bool force = tried > left, forceAny = tried > 2 * left;
      if (isEar(at) || forceAny || (force && turnOf(previous_[at], at, next_[at]) > 0)) {
        triangles.push_back({point_[previous_[at]], point_[at], point_[next_[at]]});
        next_[previous_[at]] = next_[at];
        previous_[next_[at]] = previous_[at];
        gone_[at] = 1;
        at = next_[next_[at]];  // skip one, for fewer thin triangles
        --left;
        tried = 0;
      } else {
        at = next_[at];
        ++tried;
      }
    }
    triangles.push_back({point_[previous_[at]], point_[at], point_[next_[at]]});
  }

  const PolygonModel& model_;
  const Polygon& polygon_;
  Vec3l normal_;
  int drop_ = 2, side_ = 1;
  std::vector<std::uint32_t> point_, next_, previous_;
  std::vector<double> u_, v_;
  std::vector<std::uint8_t> gone_;
  double low_[2] = {}, scale_[2] = {};
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace

TriangleMesh triangulate(const PolygonModel& model, Faces faces,
                         std::vector<std::uint32_t>* facesOf, const Progress& progress) {
  std::vector<std::vector<Triangle>> made(model.polygons.size());
  LoopProgress loop(progress, "triangulating faces", model.polygons.size());
  parallelFor(0, model.polygons.size(), 16, [&](std::size_t from, std::size_t to) {
    for (std::size_t p = from; p < to; ++p) {
      const Polygon& polygon = model.polygons[p];
      if (polygon.outside() == 0 && faces == Faces::Seen) continue;
      EarClipper(model, polygon).run(made[p]);
    }
    loop.advance(to - from);
  });
  TriangleMesh mesh;
  mesh.materials = model.looks;
  if (!mesh.materials.empty()) mesh.materials.erase(mesh.materials.begin());
  if (facesOf) facesOf->clear();
  constexpr std::uint32_t kNew = 0xFFFFFFFF;
  std::vector<std::uint32_t> number(model.points.size(), kNew);
  // The triangles of one side of the faces that `wanted` says: up, down, or neither (0).
  const auto take = [&](auto&& wanted) {
    for (std::size_t p = 0; p < made.size(); ++p) {
      const int side = wanted(model.polygons[p]);
      if (side == 0) continue;
      const Substance owner = side > 0 ? model.polygons[p].below : model.polygons[p].above;
      for (Triangle triangle : made[p]) {
        if (side < 0) std::swap(triangle[1], triangle[2]);
        for (std::uint32_t& corner : triangle) {
          if (number[corner] == kNew) {
            number[corner] = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(model.toWorld(model.points[corner]));
          }
          corner = number[corner];
        }
        mesh.triangles.push_back(triangle);
        if (!mesh.materials.empty()) mesh.triangleMaterials.push_back(owner - 1u);
        if (facesOf) facesOf->push_back(static_cast<std::uint32_t>(p));
      }
    }
  };
  if (faces == Faces::Seen) {
    take([](const Polygon& polygon) { return polygon.outside(); });
    separateTouching(mesh);
    return mesh;
  }
  for (std::size_t s = 1; s < model.substances.size(); ++s) {
    std::ranges::fill(number, kNew);
    take([&](const Polygon& polygon) {
      return polygon.below == s ? 1 : polygon.above == s ? -1 : 0;
    });
  }
  separateTouching(mesh);
  return mesh;
}

}  // namespace exemplar::continuous
