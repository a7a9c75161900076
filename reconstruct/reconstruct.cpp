// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/reconstruct.h"

#include <algorithm>
#include <vector>

namespace exemplar {

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  std::span<const ReconstructExample> examples,
                                  const ReconstructOptions& options, const Progress& progress) {
  Reconstruction result;
  FieldToMeshOptions contour = options.contour;
  contour.checkHealth = false;
  const bool dressed = std::all_of(examples.begin(), examples.end(),
                                   [](const ReconstructExample& e) { return e.mesh; });
  const double contoured = dressed ? 0.4 : 0.9;
  result.mesh = fieldToMesh(field, contour, progress.part(0, contoured), &result.contour);
  if (dressed) {
    std::vector<ExampleView> views;
    for (const ReconstructExample& example : examples) {
      views.push_back({*example.mesh, example.field});
    }
    transferAppearance(result.mesh, field, origins, views, options.appearance,
                       progress.part(contoured, 0.9));
  }
  progress.report("checking the surface", 0.9);
  result.health = meshHealth(result.mesh);
  progress.report("checking the surface", 1);
  return result;
}

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  const ReconstructExample& example,
                                  const ReconstructOptions& options, const Progress& progress) {
  return reconstructSurface(field, origins, std::span(&example, 1), options, progress);
}

}  // namespace exemplar
