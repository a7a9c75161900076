// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mesh_health.h"

#include <tbb/parallel_sort.h>

#include <algorithm>

#include "core/parallel.h"
#include "mesh/self_intersection.h"

namespace exemplar {
namespace {

/// Sets of indices that are joined one pair after another.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) {
    parent_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) parent_.push_back(i);
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// A triangle's side, under the vertices that it joins. Corner c's side runs from corner c to the
/// next one.
struct Side {
  std::uint32_t low, high;
  std::uint64_t corner;  // 3 t + c

  bool operator<(const Side& b) const {
    return low != b.low ? low < b.low : high != b.high ? high < b.high : corner < b.corner;
  }
  bool isSameEdge(const Side& b) const { return low == b.low && high == b.high; }
};

bool hasEqualCorners(const std::array<std::uint32_t, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Below this share of its longest side's square, a triangle's doubled area is rounding: a cross
/// product of doubles is off by a few 2^-53 of the product of its factors' lengths.
constexpr double kZeroArea = 1e-14;

bool isDegenerate(const TriangleMesh& mesh, std::size_t t) {
  if (hasEqualCorners(mesh.triangles[t])) return true;
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3d &pa = mesh.positions[a], &pb = mesh.positions[b], &pc = mesh.positions[c];
  const double longest =
      std::max({dot(pb - pa, pb - pa), dot(pc - pb, pc - pb), dot(pa - pc, pa - pc)});
  return length(areaNormal(mesh, t)) <= kZeroArea * longest;
}

/// The sides of all triangles with three different corners, equal edges one behind the other.
std::vector<Side> sortedSides(const TriangleMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    if (hasEqualCorners(triangle)) continue;
    for (int c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(triangle[c], triangle[(c + 1) % 3]);
      sides.push_back({low, high, 3 * t + c});
    }
  }
  tbb::parallel_sort(sides.begin(), sides.end());
  return sides;
}

void countEdgesAndFans(const TriangleMesh& mesh, MeshHealth& health) {
  const std::vector<Side> sides = sortedSides(mesh);
  const auto vertexAt = [&](std::uint64_t corner) {
    return mesh.triangles[corner / 3][corner % 3];
  };
  const auto next = [](std::uint64_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  // Corners at a vertex belong to one fan where sides at that vertex are joined.
  DisjointSets fans(3 * mesh.triangles.size());
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].isSameEdge(sides[begin])) ++end;
    const std::size_t count = end - begin;
    if (count == 1) ++health.boundaryEdges;
    if (count > 2) ++health.nonManifoldEdges;
    const std::uint64_t first = sides[begin].corner;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const std::uint64_t other = sides[i].corner;
      const bool sameWay = vertexAt(first) == vertexAt(other);
      if (count == 2 && sameWay) ++health.misorientedEdges;
      fans.join(first, sameWay ? other : next(other));
      fans.join(next(first), sameWay ? next(other) : other);
    }
    begin = end;
  }
  // Each fan has one corner that leads it; a vertex with two leaders has two fans.
  std::vector<std::uint8_t> leaders(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (hasEqualCorners(mesh.triangles[t])) continue;
    for (std::uint64_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
      if (fans.find(corner) != corner) continue;
      std::uint8_t& seen = leaders[vertexAt(corner)];
      if (seen == 1) ++health.nonManifoldVertices;
      if (seen < 2) ++seen;
    }
  }
}

std::int64_t countComponents(const TriangleMesh& mesh) {
  DisjointSets sets(mesh.positions.size());
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(b, c);
    used[a] = used[b] = used[c] = true;
  }
  std::int64_t count = 0;
  for (std::size_t v = 0; v < used.size(); ++v) count += used[v] && sets.find(v) == v;
  return count;
}

/// The sum of the tetrahedra between each triangle and the middle of the mesh.
double signedVolume(const TriangleMesh& mesh) {
  const Vec3d middle = boundingBox(mesh).center();
  return parallelSum<double>(
      0, mesh.triangles.size(), 4096, [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t t = begin; t < end; ++t) {
          const auto& [a, b, c] = mesh.triangles[t];
          sum += dot(mesh.positions[a] - middle,
                     cross(mesh.positions[b] - middle, mesh.positions[c] - middle));
        }
        return sum / 6;
      });
}

}  // namespace

MeshHealth meshHealth(const TriangleMesh& mesh, const MeshHealthOptions& options) {
  MeshHealth health;
  health.vertices = static_cast<std::int64_t>(mesh.positions.size());
  health.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  if (mesh.triangles.empty()) return health;
  health.degenerateTriangles = parallelSum<std::int64_t>(0, mesh.triangles.size(), 4096,
                                                         [&](std::size_t begin, std::size_t end) {
                                                           std::int64_t count = 0;
                                                           for (std::size_t t = begin; t < end; ++t)
                                                             count += isDegenerate(mesh, t);
                                                           return count;
                                                         });
  countEdgesAndFans(mesh, health);
  health.components = countComponents(mesh);
  health.signedVolume = signedVolume(mesh);
  if (options.selfIntersections) health.selfIntersections = countSelfIntersections(mesh);
  return health;
}

}  // namespace exemplar
