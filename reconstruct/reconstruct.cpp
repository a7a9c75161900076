// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/reconstruct.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"
#include "reconstruct/blend_seams.h"
#include "reconstruct/decimate.h"
#include "reconstruct/manifold.h"
#include "reconstruct/smooth.h"

namespace exemplar {

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  std::span<const ReconstructExample> examples,
                                  const ReconstructOptions& options, const Progress& progress) {
  if (!(options.simplify >= 0)) {
    throw InputError("simplify: " + std::to_string(options.simplify) +
                     " voxels are out of range; 0 or more is right");
  }
  Reconstruction result;
  TriangleMesh& mesh = result.mesh;
  FieldToMeshOptions contour = options.contour;
  contour.checkHealth = false;
  if (options.blend > 0) {
    progress.report("blending seams", 0);
    std::vector<const DistanceField*> fields;
    for (const ReconstructExample& example : examples) fields.push_back(&example.field);
    const DistanceField blended = blendSeams(field, origins, fields, {.width = options.blend});
    progress.report("contouring", 0.2);
    mesh = fieldToMesh(blended, contour, &result.contour);
  } else {
    progress.report("contouring", 0.2);
    mesh = fieldToMesh(field, contour, &result.contour);
  }
  if (options.relax > 0) {
    progress.report("relaxing seams", 0.5);
    SmoothOptions relax;
    relax.iterations = options.relax;
    relax.weights = seamWeights(mesh, field, origins);
    relax.box = field.box();
    smooth(mesh, relax);
  }
  if (options.simplify > 0) {
    progress.report("simplifying", 0.6);
    decimate(mesh, {.error = options.simplify * field.voxelSize, .box = field.box()});
  }
  if (options.relax > 0 || options.simplify > 0) makeManifold(mesh);  // triangles gone flat
  if (std::all_of(examples.begin(), examples.end(),
                  [](const ReconstructExample& example) { return example.mesh; })) {
    std::vector<ExampleView> views;
    for (const ReconstructExample& example : examples) {
      views.push_back({*example.mesh, example.field});
    }
    transferAppearance(mesh, field, origins, views, options.appearance, progress);
  }
  result.health = meshHealth(mesh);
  return result;
}

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  const ReconstructExample& example,
                                  const ReconstructOptions& options, const Progress& progress) {
  return reconstructSurface(field, origins, std::span(&example, 1), options, progress);
}

}  // namespace exemplar
