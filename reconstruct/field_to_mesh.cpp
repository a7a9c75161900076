// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/field_to_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/contour_field.h"
#include "reconstruct/dual_contour.h"
#include "sdf/redistance.h"

namespace exemplar {
namespace {

/// Vertices that were moved a little off the box's faces go back.
void returnToBox(const ContourField& field, TriangleMesh& mesh) {
  for (Vec3d& p : mesh.positions) {
    for (int a = 0; a < 3; ++a) {
      for (const int side : {-1, 1}) {
        const double plane = field.facePlane(side, a);
        if (side * (p[a] - plane) > -0.3) p[a] = plane;
      }
    }
  }
}

/// Drops the closed parts that enclose less than `smallest` voxels and do not touch the box.
std::int64_t dropSpecks(const ContourField& field, double smallest, TriangleMesh& mesh) {
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> part =
      vertexComponents(mesh.triangles, mesh.positions.size(), &count);
  std::vector<double> volumes(count, 0);
  std::vector<std::uint8_t> touches(count, 0);
  std::vector<Vec3d> anchor(count);
  std::vector<std::uint8_t> anchored(count, 0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d& p = mesh.positions[v];
    for (int a = 0; a < 3; ++a) {
      if (p[a] <= -0.5 || p[a] >= field.size()[a] - 0.5) touches[part[v]] = 1;
    }
    if (!anchored[part[v]]) {
      anchored[part[v]] = 1;
      anchor[part[v]] = p;
    }
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t p = part[a];
    volumes[p] += dot(mesh.positions[a] - anchor[p],
                      cross(mesh.positions[b] - anchor[p], mesh.positions[c] - anchor[p])) /
                  6;
  }
  std::vector<std::uint8_t> hasTriangles(count, 0), keep(mesh.triangles.size());
  std::int64_t dropped = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const std::uint32_t p = part[mesh.triangles[t][0]];
    keep[t] = touches[p] || std::abs(volumes[p]) >= smallest;
    if (!keep[t] && !hasTriangles[p]) {
      hasTriangles[p] = 1;
      ++dropped;
    }
  }
  keepTriangles(mesh, keep);
  return dropped;
}

void check(const DistanceField& field, const FieldToMeshOptions& options) {
  if (!(options.smallestPiece >= 0)) {
    throw InputError("`smallestPiece` is " + std::to_string(options.smallestPiece) +
                     "; it must be >= 0 voxels");
  }
  if (field.values.empty()) throw InputError("the field has no samples and so no surface");
  requireMemory((options.redistance ? 24.0 : 6.0) * static_cast<double>(field.values.count()),
                "contouring the field", "use a lower `resolution` or a smaller `scale`");
  const auto values = field.values.values();
  const auto bad =
      std::find_if(values.begin(), values.end(), [](float v) { return std::isnan(v); });
  if (bad != values.end()) {
    const Vec3i at = field.values.ijk(static_cast<std::size_t>(bad - values.begin()));
    throw InputError("the field is not a number (NaN) at sample " + std::to_string(at.x) + ", " +
                     std::to_string(at.y) + ", " + std::to_string(at.z) +
                     "; every sample must be a signed distance");
  }
}

[[noreturn]] void throwNoSurface(const DistanceField& field, std::int64_t dropped) {
  if (dropped > 0) {
    throw InputError(
        "the field's surface consists of " + std::to_string(dropped) +
        " specks below `smallestPiece`; lower that limit, or use a higher `resolution`");
  }
  const bool inside = field.values.values().front() < 0;
  throw InputError(
      std::string("the field has no surface: all of its samples are ") +
      (inside ? "inside" : "outside") +
      "; use a higher `resolution`, another `seed`, or an example whose box holds both "
      "solid and empty space");
}

}  // namespace

TriangleMesh fieldToMesh(const DistanceField& field, const FieldToMeshOptions& options,
                         const Progress& progress, FieldToMeshReport* report) {
  check(field, options);
  FieldToMeshReport done;
  progress.report("contouring", 0);
  const ContourField contourField(
      options.redistance ? redistanceJumps(field, options.wraps, progress.part(0, 0.4)) : field,
      options.close, options.wraps, progress);
  TriangleMesh mesh = dualContour(contourField, options.project, progress.part(0.4, 0.7));
  done.manifold = makeManifold(mesh, {.separation = 0.1}, progress.part(0.7, 0.9));
  returnToBox(contourField, mesh);
  done.droppedPieces = dropSpecks(contourField, options.smallestPiece, mesh);
  if (mesh.triangles.empty()) throwNoSurface(field, done.droppedPieces);
  for (Vec3d& p : mesh.positions) p = field.position(p);
  progress.report("contouring", 0.95);
  if (report) {
    if (options.checkHealth) done.health = meshHealth(mesh);
    *report = done;
  }
  progress.report("contouring", 1);
  return mesh;
}

}  // namespace exemplar
