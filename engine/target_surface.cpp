// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/target_surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.h"
#include "engine/painted_surface.h"
#include "engine/words.h"
#include "mesh/mesh_health.h"
#include "reconstruct/manifold.h"

namespace exemplar {
namespace {

/// Vertices at equal positions become one; triangles that lose a corner, and all but one of those
/// with equal corners, go. Returns how many were doubled.
std::int64_t joinEqual(TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    const Vec3d& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(key(a), a) < std::tuple(key(b), b);
  });
  std::vector<std::uint32_t> joined(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const bool same = n > 0 && key(order[n]) == key(order[n - 1]);
    joined[order[n]] = same ? joined[order[n - 1]] : order[n];
  }
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::size_t>> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto [a, b, c] = mesh.triangles[t];
    std::array<std::uint32_t, 3> sorted{joined[a], joined[b], joined[c]};
    mesh.triangles[t] = sorted;
    // Rotated to begin with the lowest, so that the winding stays.
    std::rotate(sorted.begin(), std::min_element(sorted.begin(), sorted.end()), sorted.end());
    if (sorted[0] != sorted[1] && sorted[1] != sorted[2] && sorted[0] != sorted[2])
      corners.emplace_back(sorted, t);
  }
  std::sort(corners.begin(), corners.end());
  std::vector<std::size_t> kept;
  for (std::size_t n = 0; n < corners.size(); ++n)
    if (n == 0 || corners[n].first != corners[n - 1].first) kept.push_back(corners[n].second);
  std::sort(kept.begin(), kept.end());
  TriangleMesh bare;
  bare.positions = std::move(mesh.positions);
  bare.colors = std::move(mesh.colors);
  for (const std::size_t t : kept) bare.triangles.push_back(mesh.triangles[t]);
  const auto doubled = static_cast<std::int64_t>(corners.size() - kept.size());
  mesh = std::move(bare);
  return doubled;
}

/// Joins equal positions, and cuts what is no manifold into sheets.
void makeSheets(TriangleMesh& mesh, const std::string& name, Warnings* warnings,
                const Progress& progress) {
  const std::int64_t doubled = joinEqual(mesh);
  if (doubled > 0)
    warn(warnings,
         name + ": " + withThousands(doubled) + " triangles are there twice; one of each is taken");
  if (mesh.triangles.empty()) throw InputError("`on`: " + name + " has no triangle with area");
  const ManifoldReport cut = makeManifold(mesh, {.repairDegenerate = false}, progress);
  if (mesh.triangles.empty())
    throw InputError("`on`: " + name + " encloses nothing: all of its triangles lie back to back");
  if (cut.splitVertices > 0 || cut.splitEdges > 0)
    warn(warnings, name +
                       ": the surface is no manifold, or not turned one way; it is cut where its "
                       "parts do not go together, and rows may break there");
}

bool isInsideOut(const TriangleMesh& mesh) {
  const MeshHealth health = meshHealth(mesh);
  return health.closed() && health.signedVolume < 0;
}

void turnOver(TriangleMesh& mesh) {
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
}

}  // namespace

TargetSurface targetSurface(const Source& source, const MeshFileOptions& options,
                            const std::string& cover, bool withBody, Warnings* warnings,
                            const Progress& progress) {
  const SourceKind kind = sourceKind(source);
  if (kind != SourceKind::Mesh)
    throw InputError("`on`: " + source.name() + " is no mesh; a surface of triangles is wanted");
  TargetSurface target;
  TriangleMesh mesh = readTriangles(source, options, progress.part(0, 0.4));
  target.surface = cover.empty() ? std::move(mesh) : coveredPart(mesh, cover, source.name());
  makeSheets(target.surface, source.name(), warnings, progress.part(0.4, 0.7));
  bool turned = isInsideOut(target.surface);
  if (!cover.empty() && withBody) {
    makeSheets(mesh, source.name(), nullptr, progress.part(0.7, 1));
    turned = isInsideOut(mesh);
    if (turned) turnOver(mesh);
    target.body = std::move(mesh);
  }
  if (turned) {
    turnOver(target.surface);
    warn(warnings, source.name() + ": the surface is inside out; it is turned");
  }
  return target;
}

}  // namespace exemplar
