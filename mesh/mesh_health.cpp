// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mesh_health.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "mesh/self_intersection.h"

namespace exemplar {
namespace {

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

/// The corners, 3 t + c, of triangles with three different ones at each vertex.
struct CornersAtVertices {
  std::vector<std::uint64_t> corners, begin;

  explicit CornersAtVertices(const TriangleMesh& mesh) : begin(mesh.positions.size() + 2, 0) {
    // One place too far at first: filling a vertex's list moves its end there.
    for (const auto& t : mesh.triangles) {
      if (hasEqualCorners(t)) continue;
      for (const std::uint32_t v : t) ++begin[v + 2];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    corners.resize(begin.back());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (hasEqualCorners(mesh.triangles[t])) continue;
      for (int c = 0; c < 3; ++c) corners[begin[mesh.triangles[t][c] + 1]++] = 3 * t + c;
    }
  }
};

/// A triangle's side as one of its ends sees it.
struct Side {
  std::uint32_t other;   ///< the end that it leads to
  bool leaves;           ///< the triangle runs from here to there
  std::uint32_t corner;  ///< of this end, by its place in the vertex's list

  bool operator<(const Side& b) const {
    return other != b.other ? other < b.other : corner < b.corner;
  }
};

/// What is wrong with edges and fans.
struct Faults {
  std::int64_t boundary = 0, nonManifold = 0, misoriented = 0, vertices = 0;

  Faults& operator+=(const Faults& b) {
    boundary += b.boundary;
    nonManifold += b.nonManifold;
    misoriented += b.misoriented;
    vertices += b.vertices;
    return *this;
  }
};

void countEdgesAndFans(const TriangleMesh& mesh, MeshHealth& health, const Progress& progress) {
  const CornersAtVertices lists(mesh);
  const auto count = [&](std::size_t v0, std::size_t v1) {
    progress.check();
    Faults faults;
    std::vector<Side> sides;
    DisjointSets fan;
    for (std::size_t v = v0; v < v1; ++v) {
      const std::span<const std::uint64_t> corners(lists.corners.data() + lists.begin[v],
                                                   lists.begin[v + 1] - lists.begin[v]);
      sides.clear();
      for (std::uint32_t n = 0; n < corners.size(); ++n) {
        const auto& t = mesh.triangles[corners[n] / 3];
        const auto c = static_cast<int>(corners[n] % 3);
        sides.push_back({t[(c + 1) % 3], true, n});
        sides.push_back({t[(c + 2) % 3], false, n});
      }
      std::sort(sides.begin(), sides.end());
      // Corners belong to one fan where their triangles share a side at the vertex.
      fan.reset(corners.size());
      auto fans = static_cast<std::int64_t>(corners.size());
      for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        for (end = begin + 1; end < sides.size() && sides[end].other == sides[begin].other; ++end) {
          fans -= fan.join(sides[begin].corner, sides[end].corner);
        }
        if (sides[begin].other < v) continue;  // an edge counts at its lower end
        const std::size_t triangles = end - begin;
        faults.boundary += triangles == 1;
        faults.nonManifold += triangles > 2;
        faults.misoriented += triangles == 2 && sides[begin].leaves == sides[begin + 1].leaves;
      }
      faults.vertices += fans > 1;
    }
    return faults;
  };
  const Faults faults = parallelSum<Faults>(0, mesh.positions.size(), 4096, count);
  health.boundaryEdges = faults.boundary;
  health.nonManifoldEdges = faults.nonManifold;
  health.misorientedEdges = faults.misoriented;
  health.nonManifoldVertices = faults.vertices;
}

std::int64_t countComponents(const TriangleMesh& mesh, const Progress& progress) {
  DisjointSets sets(mesh.positions.size());
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % 65536 == 0) progress.check();
    const auto& [a, b, c] = mesh.triangles[t];
    sets.join(a, b);
    sets.join(b, c);
    used[a] = used[b] = used[c] = 1;
  }
  std::int64_t count = 0;
  for (std::uint32_t v = 0; v < used.size(); ++v) count += used[v] && sets.find(v) == v;
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

MeshHealth meshHealth(const TriangleMesh& mesh, const Progress& progress) {
  return meshHealth(mesh, MeshHealthOptions{}, progress);
}

MeshHealth meshHealth(const TriangleMesh& mesh, const MeshHealthOptions& options,
                      const Progress& progress) {
  constexpr const char* kStage = "checking the mesh";
  // Crossings take several times as long as the rest.
  const Progress edges = progress.part(0, options.selfIntersections ? 0.2 : 1);
  MeshHealth health;
  health.vertices = static_cast<std::int64_t>(mesh.positions.size());
  health.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  if (mesh.triangles.empty()) return health;
  edges.report(kStage, 0);
  health.degenerateTriangles = parallelSum<std::int64_t>(0, mesh.triangles.size(), 4096,
                                                         [&](std::size_t begin, std::size_t end) {
                                                           std::int64_t count = 0;
                                                           for (std::size_t t = begin; t < end; ++t)
                                                             count += isDegenerate(mesh, t);
                                                           return count;
                                                         });
  edges.report(kStage, 0.1);
  // Both have much to do that only one thread can.
  tbb::parallel_invoke([&] { countEdgesAndFans(mesh, health, edges); },
                       [&] { health.components = countComponents(mesh, edges); });
  edges.report(kStage, 0.9);
  health.signedVolume = signedVolume(mesh);
  edges.report(kStage, 1);
  if (options.selfIntersections) {
    health.selfIntersections = countSelfIntersections(mesh, progress.part(0.2, 1));
  }
  return health;
}

}  // namespace exemplar
