// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/material_borders.h"

#include <array>
#include <numeric>

#include "core/loop_progress.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 4096;
/// How far inside a triangle, from its corner to its middle, the corner's material is asked for: a
/// vertex on a crease belongs to both sides of it.
constexpr double kInside = 0.05;
/// Halvings of a side in search of the border.
constexpr int kHalvings = 6;
/// Borders nearer to a side's end than this share of it go through the end.
constexpr double kAtEnd = 0.1;
constexpr float kUncut = -1;

/// Triangles with a vertex at which regions meet.
std::vector<std::uint32_t> borderTriangles(const TriangleMesh& mesh,
                                           const std::vector<std::uint32_t>& region) {
  std::vector<std::uint32_t> seen(mesh.positions.size(), kNone);
  std::vector<std::uint8_t> mixed(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (seen[v] == kNone) seen[v] = region[t];
      mixed[v] |= seen[v] != region[t];
    }
  }
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (mixed[a] || mixed[b] || mixed[c]) triangles.push_back(t);
  }
  return triangles;
}

}  // namespace

std::vector<std::uint32_t> cutBorders(TriangleMesh& mesh, std::vector<std::uint32_t>& region,
                                      const RegionAt& regionAt, const Progress& progress) {
  const std::size_t before = mesh.triangles.size();
  std::vector<std::uint32_t> parent(before);
  std::iota(parent.begin(), parent.end(), 0u);
  const std::vector<std::uint32_t> zone = borderTriangles(mesh, region);
  std::vector<std::uint8_t> inZone(before, 0);
  std::vector<float> cuts(3 * before, kUncut);  // where each halfedge is cut, 0..1
  LoopProgress done(progress, "cutting borders between materials", zone.size());
  parallelFor(0, zone.size(), 64, [&](std::size_t n0, std::size_t n1) {
    for (std::size_t n = n0; n < n1; ++n) {
      done.advance();
      const std::uint32_t t = zone[n];
      inZone[t] = 1;
      const Vec3d normal = normalized(areaNormal(mesh, t)), middle = triangleMiddle(mesh, t);
      std::array<Vec3d, 3> p;
      std::array<std::uint32_t, 3> at;
      for (int c = 0; c < 3; ++c) {
        const Vec3d& corner = mesh.positions[mesh.triangles[t][c]];
        p[c] = corner + (middle - corner) * kInside;
        at[c] = regionAt(p[c], normal, t);
      }
      if (at[0] == at[1] && at[1] == at[2]) {
        region[t] = at[0];
        continue;
      }
      region[t] = regionAt(middle, normal, t);
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3;
        if (at[c] == at[d]) continue;
        double low = 0, high = 1;
        for (int halving = 0; halving < kHalvings; ++halving) {
          const double s = (low + high) / 2;
          (regionAt(p[c] + (p[d] - p[c]) * s, normal, t) == at[c] ? low : high) = s;
        }
        cuts[3 * t + c] = static_cast<float>((low + high) / 2);
      }
    }
  });

  // One place for each edge: the mean of what its two triangles found, or what one of them did.
  const EdgeGroups edges = edgeGroups(mesh.triangles, mesh.positions.size());
  std::vector<std::uint32_t> middles(3 * before, kNone);
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto group = edges.group(e);
    const std::uint32_t from = fromVertex(mesh.triangles, group[0]);
    const std::uint32_t to = toVertex(mesh.triangles, group[0]);
    double sum = 0;
    int count = 0;
    for (const std::uint32_t h : group) {
      if (cuts[h] == kUncut) continue;
      sum += fromVertex(mesh.triangles, h) == from ? cuts[h] : 1 - cuts[h];
      ++count;
    }
    if (count == 0) continue;
    const double share = sum / count;
    if (share < kAtEnd || share > 1 - kAtEnd) continue;
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(mesh.positions[from] +
                             (mesh.positions[to] - mesh.positions[from]) * share);
    for (const std::uint32_t h : group) middles[h] = v;
  }
  std::vector<std::uint32_t> pieces;
  for (std::uint32_t t = 0; t < before; ++t) {
    const std::size_t first = mesh.triangles.size();
    cutTriangle(mesh, t, {middles[3 * t], middles[3 * t + 1], middles[3 * t + 2]});
    parent.resize(mesh.triangles.size(), t);
    region.resize(mesh.triangles.size(), region[t]);
    if (mesh.triangles.size() == first || !inZone[t]) continue;
    pieces.push_back(t);
    for (std::size_t p = first; p < mesh.triangles.size(); ++p) {
      pieces.push_back(static_cast<std::uint32_t>(p));
    }
  }
  parallelFor(0, pieces.size(), 64, [&](std::size_t n0, std::size_t n1) {
    progress.check();
    for (std::size_t n = n0; n < n1; ++n) {
      const std::uint32_t t = pieces[n];
      region[t] = regionAt(triangleMiddle(mesh, t), normalized(areaNormal(mesh, t)), parent[t]);
    }
  });
  return parent;
}

std::vector<std::uint32_t> cutMaterialBorders(TriangleMesh& mesh, const RegionAt& materialAt,
                                              const Progress& progress) {
  std::vector<std::uint32_t> materials = mesh.triangleMaterials;
  std::vector<std::uint32_t> parent = cutBorders(mesh, materials, materialAt, progress);
  mesh.triangleMaterials = std::move(materials);
  return parent;
}

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

}  // namespace exemplar
