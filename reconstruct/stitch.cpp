// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/stitch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "reconstruct/adjacency.h"

namespace exemplar {
namespace {

using Cell = std::array<std::int64_t, 3>;

Cell cellOf(const Vec3d& p, double size) {
  return {static_cast<std::int64_t>(std::floor(p.x / size)),
          static_cast<std::int64_t>(std::floor(p.y / size)),
          static_cast<std::int64_t>(std::floor(p.z / size))};
}

/// Points in buckets of a regular grid; sorted, so that looking up is a binary search and the order
/// within a bucket is that of the indices.
class PointGrid {
 public:
  PointGrid(const std::vector<Vec3d>& positions, const std::vector<std::uint32_t>& points,
            double size)
      : size_(size) {
    entries_.reserve(points.size());
    for (const std::uint32_t v : points) entries_.emplace_back(cellOf(positions[v], size), v);
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls `visit` with every point in the buckets that the box touches.
  template <class Visit>
  void visitBox(const Vec3d& low, const Vec3d& high, const Visit& visit) const {
    const Cell a = cellOf(low, size_), b = cellOf(high, size_);
    for (std::int64_t x = a[0]; x <= b[0]; ++x) {
      for (std::int64_t y = a[1]; y <= b[1]; ++y) {
        auto entry = std::lower_bound(entries_.begin(), entries_.end(),
                                      std::pair<Cell, std::uint32_t>({x, y, a[2]}, 0));
        for (; entry != entries_.end() && entry->first <= Cell{x, y, b[2]}; ++entry) {
          visit(entry->second);
        }
      }
    }
  }

 private:
  double size_;
  std::vector<std::pair<Cell, std::uint32_t>> entries_;
};

/// Gives every vertex the index `target` has for it; groups meet at the mean of their positions and
/// colors.
void merge(TriangleMesh& mesh, const std::vector<std::uint32_t>& target,
           std::vector<std::uint32_t>& part) {
  const std::size_t vertices = mesh.positions.size();
  std::vector<Vec3d> positions(vertices);
  std::vector<std::array<double, 4>> colors(mesh.hasColors() ? vertices : 0);
  std::vector<int> count(vertices, 0);
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::uint32_t to = target[v];
    positions[to] += mesh.positions[v];
    for (int k = 0; k < 4 && mesh.hasColors(); ++k) colors[to][k] += mesh.colors[v][k];
    ++count[to];
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (count[v] < 2) continue;
    mesh.positions[v] = positions[v] / count[v];
    for (int k = 0; k < 4 && mesh.hasColors(); ++k) {
      mesh.colors[v][k] = static_cast<float>(colors[v][k] / count[v]);
    }
  }
  std::vector<std::uint8_t> keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t) {
    for (std::uint32_t& v : mesh.triangles[t]) v = target[v];
    const auto& [a, b, c] = mesh.triangles[t];
    keep[t] = a != b && b != c && c != a;
  }
  // `keepTriangles` drops unused vertices; the parts follow.
  std::vector<std::uint8_t> used(vertices, 0);
  for (std::size_t t = 0; t < keep.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) used[v] |= keep[t];
  }
  keepTriangles(mesh, keep);
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (used[v]) part[kept++] = part[v];
  }
  part.resize(kept);
}

std::vector<std::uint32_t> rimVertices(const TriangleMesh& mesh,
                                       const std::vector<std::uint32_t>& mates) {
  std::vector<std::uint8_t> rim(mesh.positions.size(), 0);
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (mates[h] != kNone) continue;
    rim[fromVertex(mesh.triangles, h)] = rim[toVertex(mesh.triangles, h)] = 1;
  }
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < rim.size(); ++v) {
    if (rim[v]) vertices.push_back(v);
  }
  return vertices;
}

/// Joins rim vertices of different parts that are each other's nearest.
bool joinNearest(TriangleMesh& mesh, double tolerance, const Progress& progress,
                 std::vector<std::uint32_t>& part) {
  const std::vector<std::uint32_t> rim =
      rimVertices(mesh, mateHalfedges(mesh.triangles, mesh.positions.size()));
  const PointGrid grid(mesh.positions, rim, tolerance);
  const Vec3d reach{tolerance, tolerance, tolerance};
  std::vector<std::uint32_t> nearest(mesh.positions.size(), kNone);
  for (const std::uint32_t v : rim) {
    progress.check();
    double best = tolerance;
    const Vec3d& p = mesh.positions[v];
    grid.visitBox(p - reach, p + reach, [&](std::uint32_t w) {
      if (part[w] == part[v]) return;
      const double distance = length(mesh.positions[w] - p);
      if (distance < best || (distance == best && w < nearest[v])) {
        best = distance;
        nearest[v] = w;
      }
    });
  }
  std::vector<std::uint32_t> target(mesh.positions.size());
  std::iota(target.begin(), target.end(), 0u);
  bool any = false;
  for (const std::uint32_t v : rim) {
    if (nearest[v] == kNone || nearest[nearest[v]] != v || nearest[v] < v) continue;
    target[nearest[v]] = v;
    any = true;
  }
  if (any) merge(mesh, target, part);
  return any;
}

/// Rim edges take up rim vertices that lie on them. Returns whether there were any.
bool takeUpVertices(TriangleMesh& mesh, double tolerance, const Progress& progress,
                    const std::vector<std::uint32_t>& part) {
  const std::vector<std::uint32_t> mates = mateHalfedges(mesh.triangles, mesh.positions.size());
  const PointGrid grid(mesh.positions, rimVertices(mesh, mates), tolerance);
  const Vec3d reach{tolerance, tolerance, tolerance};
  bool any = false;
  const std::size_t count = mesh.triangles.size();
  for (std::uint32_t t = 0; t < count; ++t) {
    progress.check();
    // One side of a triangle a round: the next round sees what remains.
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (mates[h] != kNone) continue;
      const std::uint32_t a = fromVertex(mesh.triangles, h), b = toVertex(mesh.triangles, h);
      const std::uint32_t apex = apexVertex(mesh.triangles, h);
      const Vec3d p = mesh.positions[a], side = mesh.positions[b] - p;
      const double length2 = dot(side, side);
      if (length2 == 0) continue;
      std::vector<std::pair<double, std::uint32_t>> on;
      grid.visitBox(min(p, p + side) - reach, max(p, p + side) + reach, [&](std::uint32_t v) {
        if (v == a || v == b || v == apex) return;
        const double s = dot(mesh.positions[v] - p, side) / length2;
        if (!(s > 0 && s < 1)) return;
        const bool own = part[v] == part[a] || part[v] == part[b];
        const double distance = length(mesh.positions[v] - (p + side * s));
        if (distance <= (own ? tolerance * 1e-3 : tolerance)) on.emplace_back(s, v);
      });
      if (on.empty()) continue;
      std::sort(on.begin(), on.end());
      on.emplace_back(1, b);
      std::uint32_t from = a;
      const std::size_t corner = h % 3;
      const auto uvs = mesh.hasUvs() ? mesh.uvs[t] : std::array<Vec2f, 3>{};
      const Vec2f uvA = uvs[corner], uvB = uvs[(corner + 1) % 3], uvApex = uvs[(corner + 2) % 3];
      const auto uvAt = [&](double s) {
        const auto share = static_cast<float>(s);
        return Vec2f{uvA.x + (uvB.x - uvA.x) * share, uvA.y + (uvB.y - uvA.y) * share};
      };
      double fromShare = 0;
      for (std::size_t n = 0; n < on.size(); ++n) {
        const auto& [share, to] = on[n];
        if (to == from) continue;
        const std::array<std::uint32_t, 3> piece{from, to, apex};
        const std::array<Vec2f, 3> pieceUvs{uvAt(fromShare), uvAt(share), uvApex};
        if (n == 0) {
          mesh.triangles[t] = piece;
          if (mesh.hasUvs()) mesh.uvs[t] = pieceUvs;
        } else {
          mesh.triangles.push_back(piece);
          if (mesh.hasUvs()) mesh.uvs.push_back(pieceUvs);
          if (mesh.hasMaterials()) {
            mesh.triangleMaterials.push_back(std::uint32_t{mesh.triangleMaterials[t]});
          }
          if (!mesh.triangleObjects.empty())
            mesh.triangleObjects.push_back(std::uint32_t{mesh.triangleObjects[t]});
        }
        from = to;
        fromShare = share;
      }
      any = true;
      break;
    }
  }
  return any;
}

}  // namespace

void weldVertices(TriangleMesh& mesh, double tolerance, std::vector<std::uint32_t>& part,
                  const Progress& progress) {
  // Sweeping along x: candidates for each vertex are the ones before it within the tolerance.
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<std::uint32_t> all(vertices), target(vertices);
  std::iota(all.begin(), all.end(), 0u);
  std::iota(target.begin(), target.end(), 0u);
  const PointGrid grid(mesh.positions, all, std::max(tolerance * 16, 1e-300));
  const Vec3d reach{tolerance, tolerance, tolerance};
  for (std::uint32_t v = 0; v < vertices; ++v) {
    progress.check();
    const Vec3d& p = mesh.positions[v];
    std::uint32_t first = v;
    grid.visitBox(p - reach, p + reach, [&](std::uint32_t w) {
      const Vec3d d = mesh.positions[w] - p;
      if (std::abs(d.x) <= tolerance && std::abs(d.y) <= tolerance && std::abs(d.z) <= tolerance) {
        first = std::min(first, w);
      }
    });
    target[v] = target[first];
  }
  merge(mesh, target, part);
}

void stitchRims(TriangleMesh& mesh, double tolerance, std::vector<std::uint32_t>& part,
                const Progress& progress) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const bool joined = joinNearest(mesh, tolerance, progress, part);
    const bool taken = takeUpVertices(mesh, tolerance, progress, part);
    if (!joined && !taken) break;
  }
}

}  // namespace exemplar
