// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/normals.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/parallel.h"
#include "mesh/shading_normals.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kMostTriangles = 512;  // around one vertex; the work grows with its square
constexpr std::size_t kGrain = 4096;

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
