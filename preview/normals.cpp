// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/normals.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kMostTriangles = 512;  // around one vertex; the work grows with its square
constexpr std::size_t kGrain = 4096;

std::uint64_t hashPosition(const Vec3d& p) {
  std::uint64_t h = 0x9e3779b97f4a7c15u;
  for (int axis = 0; axis < 3; ++axis) {
    h ^= std::bit_cast<std::uint64_t>(p[axis] + 0.0);  // -0 is 0
    h *= 0xff51afd7ed558ccdu;
    h ^= h >> 32;
  }
  return h;
}

// For each vertex the first one at the same position.
std::vector<std::uint32_t> firstOfEqual(const std::vector<Vec3d>& positions) {
  const std::size_t n = positions.size();
  const std::size_t slots = std::bit_ceil(2 * n + 1);
  std::vector<std::uint32_t> table(slots, kNone), first(n);
  for (std::size_t v = 0; v < n; ++v) {
    std::size_t slot = hashPosition(positions[v]) & (slots - 1);
    while (table[slot] != kNone && !(positions[table[slot]] == positions[v]))
      slot = (slot + 1) & (slots - 1);
    if (table[slot] == kNone) table[slot] = static_cast<std::uint32_t>(v);
    first[v] = table[slot];
  }
  return first;
}

struct Facet {
  Vec3f normal;  // zero without area
  std::array<float, 3> angles;
};

Facet facetOf(const TriangleMesh& mesh, std::size_t t) {
  std::array<Vec3d, 3> p;
  double largest = 0;
  for (int c = 0; c < 3; ++c) p[c] = mesh.positions[mesh.triangles[t][c]];
  for (int c = 0; c < 3; ++c)
    for (int axis = 0; axis < 3; ++axis)
      largest = std::max(largest, std::abs(p[c][axis] - p[0][axis]));
  Facet facet{};
  if (!(largest > std::numeric_limits<double>::min())) return facet;
  // Edges of size 1, so that neither tiny nor huge coordinates leave the range of numbers.
  std::array<Vec3d, 3> edges;
  for (int c = 0; c < 3; ++c) edges[c] = (p[(c + 1) % 3] - p[c]) / largest;
  const Vec3d area = cross(edges[0], -edges[2]);
  if (!(length(area) > 0)) return facet;
  facet.normal = cast<float>(normalized(area));
  for (int c = 0; c < 3; ++c) {
    const Vec3d out = edges[c], in = -edges[(c + 2) % 3];
    facet.angles[c] = static_cast<float>(std::atan2(length(cross(out, in)), dot(out, in)));
  }
  return facet;
}

}  // namespace

std::vector<std::array<Vec3f, 3>> cornerNormals(const TriangleMesh& mesh, double creaseAngle) {
  const std::size_t m = mesh.triangles.size();
  std::vector<Facet> facets(m);
  parallelFor(0, m, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) facets[t] = facetOf(mesh, t);
  });

  // The corners (3 t + c) around each position, in rising order.
  const std::vector<std::uint32_t> vertex = firstOfEqual(mesh.positions);
  std::vector<std::size_t> start(mesh.positions.size() + 1, 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) ++start[vertex[v] + 1];
  for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
  std::vector<std::size_t> corners(3 * m), next(start.begin(), start.end() - 1);
  for (std::size_t corner = 0; corner < 3 * m; ++corner)
    corners[next[vertex[mesh.triangles[corner / 3][corner % 3]]]++] = corner;

  const float crease = static_cast<float>(std::cos(creaseAngle));
  std::vector<std::array<Vec3f, 3>> normals(m);
  parallelFor(0, m, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3f own = facets[t].normal;
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = vertex[mesh.triangles[t][c]];
        if (own == Vec3f{} || start[v + 1] - start[v] > kMostTriangles) {
          normals[t][c] = own;
          continue;
        }
        Vec3f sum{};
        for (std::size_t k = start[v]; k < start[v + 1]; ++k) {
          const Facet& facet = facets[corners[k] / 3];
          const float cosine = dot(own, facet.normal);
          if (corners[k] / 3 == t || std::abs(cosine) > crease)
            sum += facet.normal * std::copysign(facet.angles[corners[k] % 3], cosine);
        }
        const Vec3f mean = normalized(sum);
        normals[t][c] = dot(mean, own) > 0 ? mean : own;
      }
    }
  });
  return normals;
}

}  // namespace exemplar
