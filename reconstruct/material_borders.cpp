// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/material_borders.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "reconstruct/adjacency.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kRounds = 8;
/// Cosine of the angle to the vertex's normal beyond which a triangle makes a crease.
constexpr double kCrease = 0.82;
/// A triangle keeps at least this share of its area and this cosine to its old normal.
constexpr double kLeastArea = 0.2, kLeastTurn = 0.7;

/// A vertex inside a border line: its two neighbours along it.
struct BorderVertex {
  std::uint32_t vertex, before, after;
  Vec3d start, normal;
};

}  // namespace

void cleanMaterialBorders(TriangleMesh& mesh, int rounds) {
  if (!mesh.hasMaterials() || rounds <= 0) return;
  const std::vector<std::uint32_t> mates = mateHalfedges(mesh.triangles, mesh.positions.size());
  for (int round = 0; round < rounds; ++round) {
    const std::vector<std::uint32_t> before = mesh.triangleMaterials;
    parallelFor(0, before.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
      for (std::size_t t = t0; t < t1; ++t) {
        for (int c = 0; c < 3; ++c) {
          const std::uint32_t g = mates[3 * t + c], h = mates[3 * t + (c + 1) % 3];
          if (g == kNone || h == kNone || before[g / 3] != before[h / 3]) continue;
          mesh.triangleMaterials[t] = before[g / 3];
          break;
        }
      }
    });
    if (mesh.triangleMaterials == before) break;
  }
}

void straightenMaterialBorders(TriangleMesh& mesh, double most) {
  if (!mesh.hasMaterials()) return;
  const Triangles& triangles = mesh.triangles;
  const std::size_t vertices = mesh.positions.size();
  const std::vector<std::uint32_t> mates = mateHalfedges(triangles, vertices);

  // Up to two neighbours along borders; more, or an open rim, and the vertex stays.
  std::vector<std::array<std::uint32_t, 2>> along(vertices, {kNone, kNone});
  std::vector<std::uint8_t> stays(vertices, 0);
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    const std::uint32_t a = fromVertex(triangles, h), b = toVertex(triangles, h);
    if (mates[h] == kNone) {
      stays[a] = stays[b] = 1;
    } else if (mesh.triangleMaterials[h / 3] != mesh.triangleMaterials[mates[h] / 3]) {
      // Both halfedges of the edge come by; each serves the vertex that it starts from.
      if (along[a][0] == kNone) {
        along[a][0] = b;
      } else if (along[a][1] == kNone) {
        along[a][1] = b;
      } else {
        stays[a] = 1;
      }
    }
  }
  const VertexCorners corners = vertexCorners(triangles, vertices);
  std::vector<BorderVertex> border;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (stays[v] || along[v][1] == kNone) continue;
    Vec3d normal{};
    for (const std::uint32_t c : corners.at(v)) normal += areaNormal(mesh, c / 3);
    normal = normalized(normal);
    bool crease = false;
    for (const std::uint32_t c : corners.at(v)) {
      crease = crease || dot(normalized(areaNormal(mesh, c / 3)), normal) < kCrease;
    }
    if (!crease) border.push_back({v, along[v][0], along[v][1], mesh.positions[v], normal});
  }

  const std::vector<Vec3d> original = mesh.positions;
  const auto originalNormal = [&](std::size_t t) {
    const auto& [a, b, c] = triangles[t];
    return cross(original[b] - original[a], original[c] - original[a]);
  };
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Vec3d> moved(border.size());
    parallelFor(0, border.size(), kGrain, [&](std::size_t n0, std::size_t n1) {
      for (std::size_t n = n0; n < n1; ++n) {
        const BorderVertex& b = border[n];
        const Vec3d& p = mesh.positions[b.vertex];
        Vec3d move = (mesh.positions[b.before] + mesh.positions[b.after]) * 0.5 - p;
        Vec3d off = p + move * 0.5 - b.start;
        off -= b.normal * dot(off, b.normal);
        const double far = length(off);
        if (far > most) off *= most / far;
        moved[n] = b.start + off;
      }
    });
    // One after the other, each only where no triangle around it suffers.
    for (std::size_t n = 0; n < border.size(); ++n) {
      const std::uint32_t v = border[n].vertex;
      const Vec3d previous = mesh.positions[v];
      mesh.positions[v] = moved[n];
      for (const std::uint32_t c : corners.at(v)) {
        const Vec3d was = originalNormal(c / 3), is = areaNormal(mesh, c / 3);
        const double isLength = length(is), wasLength = length(was);
        if (isLength < kLeastArea * wasLength || dot(is, was) < kLeastTurn * isLength * wasLength) {
          mesh.positions[v] = previous;
          break;
        }
      }
    }
  }
}

}  // namespace exemplar
