// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/smooth.h"

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/cells.h"
#include "core/error.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 2048;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// Frequency up to which the filter passes everything, as an eigenvalue of the umbrella operator
/// (0..2): Taubin's k_PB.
constexpr double kPassBand = 0.1;

/// The mesh's one-rings as a halfedge mesh. OpenMesh takes manifold faces only, so each fan of
/// triangles at a vertex has a halfedge vertex of its own: vertex v's are [begin[v], begin[v + 1]).
struct Rings {
  HalfedgeMesh mesh;
  std::vector<std::uint32_t> begin;
};

Rings buildRings(const TriangleMesh& mesh, const std::vector<std::uint32_t>& mates,
                 const Progress& progress) {
  const Triangles& triangles = mesh.triangles;
  DisjointSets fans = cornerFans(mates);

  Rings rings;
  rings.begin.assign(mesh.positions.size() + 1, 0);
  for (std::uint32_t c = 0; c < mates.size(); ++c) {
    if (fans.find(c) == c) ++rings.begin[fromVertex(triangles, c) + 1];
  }
  std::partial_sum(rings.begin.begin(), rings.begin.end(), rings.begin.begin());
  std::vector<std::uint32_t> fill(rings.begin.begin(), rings.begin.end() - 1);
  std::vector<std::uint32_t> vertexOfFan(mates.size());
  rings.mesh.reserve(rings.begin.back(), 3 * triangles.size() / 2, triangles.size());
  for (std::uint32_t n = 0; n < rings.begin.back(); ++n) rings.mesh.new_vertex();
  for (std::uint32_t c = 0; c < mates.size(); ++c) {
    if (fans.find(c) == c) vertexOfFan[c] = fill[fromVertex(triangles, c)]++;
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    progress.check();
    std::array<OpenMesh::VertexHandle, 3> v;
    for (int c = 0; c < 3; ++c) {
      v[c] = OpenMesh::VertexHandle(static_cast<int>(vertexOfFan[fans.find(3 * t + c)]));
    }
    // Two sheets may share both ends of an edge; OpenMesh takes one of them.
    bool fits = v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
    for (int c = 0; c < 3 && fits; ++c) {
      const auto side = rings.mesh.find_halfedge(v[c], v[(c + 1) % 3]);
      fits = rings.mesh.is_boundary(v[c]) && (!side.is_valid() || rings.mesh.is_boundary(side));
    }
    if (fits) rings.mesh.add_face(v[0], v[1], v[2]);
  }
  return rings;
}

/// From each vertex to the middle of its neighbors; of its rim neighbors only on an open rim.
std::vector<Vec3d> umbrellas(const Rings& rings, const std::vector<std::uint32_t>& vertexOfRing,
                             const std::vector<Vec3d>& positions) {
  std::vector<Vec3d> result(positions.size());
  parallelFor(0, positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    for (std::size_t v = v0; v < v1; ++v) {
      Vec3d sum{};
      int fans = 0;
      for (std::uint32_t n = rings.begin[v]; n < rings.begin[v + 1]; ++n) {
        const OpenMesh::VertexHandle handle(static_cast<int>(n));
        if (rings.mesh.is_isolated(handle)) continue;
        const bool rim = rings.mesh.is_boundary(handle);
        Vec3d ring{};
        int neighbors = 0;
        for (auto h = rings.mesh.cvoh_iter(handle); h.is_valid(); ++h) {
          if (rim && !rings.mesh.is_boundary(rings.mesh.edge_handle(*h))) continue;
          ring += positions[vertexOfRing[rings.mesh.to_vertex_handle(*h).idx()]];
          ++neighbors;
        }
        if (neighbors == 0) continue;
        sum += ring / neighbors - positions[v];
        ++fans;
      }
      if (fans > 0) result[v] = sum / fans;
    }
  });
  return result;
}

/// For each vertex the axes along which it may not move, because it lies in a face of the box.
std::vector<std::uint8_t> heldAxes(const TriangleMesh& mesh, const SmoothOptions& options) {
  std::vector<std::uint8_t> held(mesh.positions.size(), 0);
  if (!options.box) return held;
  const Vec3d size = options.box->size();
  const double near = 1e-9 * std::max({size.x, size.y, size.z, 1e-300});
  for (std::size_t v = 0; v < held.size(); ++v) {
    for (int a = 0; a < 3; ++a) {
      const double x = mesh.positions[v][a];
      if (std::abs(x - options.box->min[a]) <= near || std::abs(x - options.box->max[a]) <= near) {
        held[v] |= static_cast<std::uint8_t>(1 << a);
      }
    }
  }
  return held;
}

double weightOf(const SmoothOptions& options, std::size_t v) {
  return options.weights.empty() ? 1.0 : double{options.weights[v]};
}

Vec3d freePart(Vec3d move, std::uint8_t held) {
  for (int a = 0; a < 3; ++a) {
    if (held & (1 << a)) move[a] = 0;
  }
  return move;
}

/// The volume under each part's triangles, seen from a point of the part's own.
std::vector<double> partVolumes(const TriangleMesh& mesh, const std::vector<std::uint32_t>& part,
                                const std::vector<Vec3d>& anchors) {
  std::vector<double> volumes(anchors.size(), 0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d& o = anchors[part[a]];
    volumes[part[a]] +=
        dot(mesh.positions[a] - o, cross(mesh.positions[b] - o, mesh.positions[c] - o)) / 6;
  }
  return volumes;
}

/// Shifts vertices along their normals until every closed part encloses what it should.
void restoreVolumes(TriangleMesh& mesh, const SmoothOptions& options,
                    const std::vector<std::uint8_t>& held, const std::vector<std::uint32_t>& part,
                    const std::vector<Vec3d>& anchors, const std::vector<std::uint8_t>& closed,
                    const std::vector<double>& wanted) {
  const VertexCorners corners = vertexCorners(mesh.triangles, mesh.positions.size());
  for (int round = 0; round < 4; ++round) {
    const std::vector<double> volumes = partVolumes(mesh, part, anchors);
    const std::vector<Vec3d> normals = vertexNormals(mesh, corners);
    std::vector<double> growth(anchors.size(),
                               0);  // of each part's volume, for a shift by one unit
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const Vec3d move = freePart(normalized(normals[v]), held[v]) * weightOf(options, v);
      growth[part[v]] += dot(move, normals[v]) / 6;
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const std::uint32_t p = part[v];
      if (!closed[p] || growth[p] <= 0) continue;
      const double shift = (wanted[p] - volumes[p]) / growth[p];
      mesh.positions[v] +=
          freePart(normalized(normals[v]), held[v]) * (weightOf(options, v) * shift);
    }
  }
}

void check(const TriangleMesh& mesh, const SmoothOptions& options) {
  if (options.iterations < 0 || options.iterations > 10000) {
    throw InputError("smoothing: `iterations` is " + std::to_string(options.iterations) +
                     "; it must be 0..10000");
  }
  if (!(options.strength >= 0 && options.strength <= 0.6)) {
    throw InputError("smoothing: `strength` is " + std::to_string(options.strength) +
                     "; it must be 0..0.6");
  }
  if (!(options.most >= 0)) {
    throw InputError("smoothing: `most` is " + std::to_string(options.most) +
                     "; it must be >= 0 world units");
  }
  if (!options.weights.empty() && options.weights.size() != mesh.positions.size()) {
    throw InputError("smoothing: " + std::to_string(options.weights.size()) + " weights for " +
                     std::to_string(mesh.positions.size()) +
                     " vertices; give one per vertex, or none");
  }
}

}  // namespace

void smooth(TriangleMesh& mesh, const SmoothOptions& options, const Progress& progress) {
  check(mesh, options);
  if (options.iterations == 0 || options.strength == 0 || mesh.triangles.empty()) return;

  progress.report("smoothing", 0);
  const std::size_t vertices = mesh.positions.size();
  const std::vector<std::uint32_t> mates = mateHalfedges(mesh.triangles, vertices);
  const Rings rings = buildRings(mesh, mates, progress);
  std::vector<std::uint32_t> vertexOfRing(rings.begin.back());
  for (std::uint32_t v = 0; v < vertices; ++v) {
    for (std::uint32_t n = rings.begin[v]; n < rings.begin[v + 1]; ++n) vertexOfRing[n] = v;
  }
  const std::vector<std::uint8_t> held = heldAxes(mesh, options);

  std::uint32_t parts = 0;
  const std::vector<std::uint32_t> part = vertexComponents(mesh.triangles, vertices, &parts);
  std::vector<Vec3d> anchors(parts);
  for (std::size_t v = vertices; v-- > 0;) anchors[part[v]] = mesh.positions[v];
  std::vector<std::uint8_t> closed(parts, 1);
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (mates[h] == kNone) closed[part[fromVertex(mesh.triangles, h)]] = 0;
  }
  const std::vector<double> wanted = partVolumes(mesh, part, anchors);

  const std::vector<Vec3d> before = mesh.positions;
  const double mu = 1 / (kPassBand - 1 / options.strength);
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    progress.report("smoothing", 0.3 + 0.6 * iteration / options.iterations);
    for (const double step : {options.strength, mu}) {
      const std::vector<Vec3d> moves = umbrellas(rings, vertexOfRing, mesh.positions);
      parallelFor(0, vertices, kGrain, [&](std::size_t v0, std::size_t v1) {
        for (std::size_t v = v0; v < v1; ++v) {
          mesh.positions[v] += freePart(moves[v] * (step * weightOf(options, v)), held[v]);
        }
      });
    }
  }
  progress.report("smoothing", 0.9);
  if (options.keepVolume) restoreVolumes(mesh, options, held, part, anchors, closed, wanted);
  parallelFor(0, vertices, kGrain, [&](std::size_t v0, std::size_t v1) {
    for (std::size_t v = v0; v < v1; ++v) {
      const Vec3d move = mesh.positions[v] - before[v];
      const double far = length(move);
      if (far > options.most) mesh.positions[v] = before[v] + move * (options.most / far);
    }
  });
  progress.report("smoothing", 1);
}

std::vector<float> seamWeights(const TriangleMesh& mesh, const DistanceField& field,
                               const Origins& origins, double width, const Progress& progress) {
  if (!(width > 0)) {
    throw InputError("seams: `width` is " + std::to_string(width) + "; it must be > 0 voxels");
  }
  if (origins.size() != field.size()) {
    throw InputError("the origins are not of the field's size; use those of the same synthesis");
  }
  // Far from the surface origins are arbitrary: all of empty space looks the same.
  const double near = 1.5 * field.voxelSize, reach = width + 1;
  std::vector<float> weights(mesh.positions.size(), 0);
  parallelFor(0, weights.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    progress.check();
    for (std::size_t v = v0; v < v1; ++v) {
      const Vec3d at = field.index(mesh.positions[v]);
      const Vec3i nearest = origins.clamped({static_cast<int>(std::floor(at.x + 0.5)),
                                             static_cast<int>(std::floor(at.y + 0.5)),
                                             static_cast<int>(std::floor(at.z + 0.5))});
      const OriginMotion here = motionAt(origins, nearest);
      const auto r = static_cast<int>(std::ceil(reach));
      const Vec3i low = origins.clamped(nearest - Vec3i{r, r, r});
      const Vec3i high = origins.clamped(nearest + Vec3i{r, r, r});
      double closest = reach;
      forEachCell(CellBox{low, high + Vec3i{1, 1, 1}}, [&](const Vec3i& p) {
        if (std::abs(field.values[p]) > near || motionAt(origins, p) == here) return;
        closest = std::min(closest, length(cast<double>(p) - at));
      });
      // The seam lies about half a voxel this side of the other part's sample.
      weights[v] = static_cast<float>(std::clamp(1 - (closest - 1) / width, 0.0, 1.0));
    }
  });
  return weights;
}

}  // namespace exemplar
