// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/reconstruct.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/error.h"
#include "reconstruct/decimate.h"
#include "reconstruct/manifold.h"

namespace exemplar {
namespace {

/// Merges triangles as the options say.
void simplify(TriangleMesh& mesh, const DistanceField& field, const ReconstructOptions& options,
              const Progress& progress) {
  if (!(options.simplify >= 0)) throw InputError("`simplify` must be 0 or more");
  if (options.triangles < 0) throw InputError("`triangles` must be 0 or more");
  if (options.simplify == 0 && options.triangles == 0) return;
  if (options.contour.wraps.any()) {
    throw InputError(
        "`simplify`, `triangles`: copies of a periodic result join only where its triangles are as "
        "they are; leave these out, or `periodic`");
  }
  DecimateOptions merge;
  merge.error = options.simplify > 0 ? options.simplify * field.voxelSize
                                     : std::numeric_limits<double>::infinity();
  merge.triangles = options.triangles;
  merge.box = field.box();
  decimate(mesh, merge, progress.part(0, 0.8));
  makeManifold(mesh, {}, progress.part(0.8, 1));  // triangles gone flat
}

}  // namespace

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  std::span<const ReconstructExample> examples,
                                  const ReconstructOptions& options, const Progress& progress) {
  Reconstruction result;
  FieldToMeshOptions contour = options.contour;
  contour.checkHealth = false;
  const bool dressed = std::all_of(examples.begin(), examples.end(),
                                   [](const ReconstructExample& e) { return e.mesh; });
  const double contoured = dressed ? 0.4 : 0.9;
  result.mesh = fieldToMesh(field, contour, progress.part(0, 0.8 * contoured), &result.contour);
  result.contoured = static_cast<std::int64_t>(result.mesh.triangles.size());
  simplify(result.mesh, field, options, progress.part(0.8 * contoured, contoured));
  if (dressed) {
    std::vector<ExampleView> views;
    for (const ReconstructExample& example : examples) {
      views.push_back({*example.mesh, example.field});
    }
    transferAppearance(result.mesh, field, origins, views, options.appearance,
                       progress.part(contoured, 0.9));
  }
  result.health = meshHealth(result.mesh, progress.part(0.9, 1));
  return result;
}

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  const ReconstructExample& example,
                                  const ReconstructOptions& options, const Progress& progress) {
  return reconstructSurface(field, origins, std::span(&example, 1), options, progress);
}

}  // namespace exemplar
