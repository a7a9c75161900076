// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/realize.h"

#include <utility>

#include "core/error.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "mesh/footprint.h"
#include "reconstruct/copy_triangles.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/transfer.h"
#include "voxelize/label_file.h"
#include "voxelize/label_mesh.h"

namespace exemplar {
namespace {

ReconstructExample viewOf(const DistanceField& field, const Example& example) {
  return {field, example.mesh ? &*example.mesh : nullptr};
}

/// Origins of a field that is its own example: every sample comes from itself.
Origins identityOrigins(const Vec3i& size) {
  Origins origins(size);
  for (std::size_t n = 0; n < origins.count(); ++n) origins.values()[n] = Origin(origins.ijk(n));
  return origins;
}

Surface copied(const Result& result, std::span<const Example> examples, const Progress& progress) {
  const Example& example = examples.front();
  CopiedTriangles made =
      copyTriangles(result.field(), result.origins, *example.mesh, example.field(), {}, progress);
  return {std::move(made.mesh), made.health, 0};
}

Surface contoured(const Result& result, std::span<const Example> examples,
                  const SurfaceOptions& surface, const Progress& progress) {
  std::vector<ReconstructExample> views;
  for (const Example& example : examples) views.push_back(viewOf(example.field(), example));
  ReconstructOptions options;
  options.contour.wraps = result.periodic;
  options.simplify = surface.simplify;
  options.triangles = surface.triangles;
  Reconstruction made =
      reconstructSurface(result.field(), result.origins, views, options, progress);
  return {std::move(made.mesh), made.health, made.contoured};
}

TriangleMesh boxesOf(const LabelGrid& grid, bool closedLabels, const std::string& what,
                     const Progress& progress) {
  TriangleMesh mesh = labelMesh(grid, {.closedLabels = closedLabels}, progress);
  if (mesh.triangles.empty()) throw InputError(what + ": all of its cells are empty");
  return mesh;
}

}  // namespace

const SettingTable<SurfaceOptions>& surfaceSettings(Form form) {
  using O = SurfaceOptions;
  static const SettingTable<O> field{
      choiceRow<O, SurfaceKind>(
          "surface", &O::surface,
          "contour the new field (closed, manifold), or copy the example's triangles",
          {{"contour", SurfaceKind::Contour}, {"copy", SurfaceKind::Copy}}),
      settingRow<O>("simplify", &O::simplify,
                    "merge triangles of the contour where the surface stays this near to where it "
                    "was",
                    kFromZero, "voxels"),
      settingRow<O>("triangles", &O::triangles,
                    "merge triangles of the contour until there are no more than this (0: do not)",
                    kFromZero),
      settingRow<O>(
          "detail", &O::detail,
          "re-make the result at this many times the resolution, with the example's finer "
          "detail",
          {1, 16})};
  static const SettingTable<O> labels{settingRow<O>(
      "instances", &O::instances, "a .glb of model pieces: write each piece once and place it")};
  return form == Form::Field ? field : labels;
}

void requireSurface(const SurfaceOptions& options, std::size_t examples) {
  if (options.surface == SurfaceKind::Contour) return;
  if (options.simplify > 0 || options.triangles > 0)
    throw InputError("`simplify`, `triangles`: only a contour is simplified, not copied triangles");
  if (examples > 1) throw InputError("`surface` copy: there are several examples; use contour");
}

void requireSurface(const SurfaceOptions& options, std::span<const Example> examples) {
  requireSurface(options, examples.size());
  if (options.surface == SurfaceKind::Contour) return;
  if (!examples.front().mesh)
    throw InputError("`surface` copy: the example has no triangles to copy; use contour");
}

Surface realize(const Result& result, std::span<const Example> examples,
                const SurfaceOptions& options, const Progress& progress) {
  if (result.outcome != Outcome::Complete)
    throw InputError("there is no result to make a surface of: " + result.why);
  requireSurface(options, examples);
  if (result.form() == Form::Field) {
    Surface surface = options.surface == SurfaceKind::Copy
                          ? copied(result, examples, progress)
                          : contoured(result, examples, options, progress);
    turn(surface.mesh, examples.front().turn);
    return surface;
  }
  Surface surface;
  surface.mesh = realizeLabels(result.labels(), examples.front(), progress.part(0, 0.8));
  surface.health = meshHealth(surface.mesh, progress.part(0.8, 1));
  return surface;
}

TriangleMesh realizeLabels(const LabelGrid& grid, const Example& example,
                           const Progress& progress) {
  progress.report("making the surface", 0);
  if (const auto* pieces = std::get_if<ModelPieces>(&example.content))
    return assemblePieces(grid, *pieces, nullptr, progress);
  if (const auto* labeled = std::get_if<LabeledField>(&example.content)) {
    const PlacedBlocks placed =
        placeBlocks(labeled->field, labeled->blocks, grid.cells, progress.part(0, 0.2));
    return reconstructSurface(placed.field, placed.origins, viewOf(labeled->field, example), {},
                              progress.part(0.2, 1))
        .mesh;
  }
  return boxesOf(grid, true, "the result has no geometry", progress);
}

TriangleMesh contourOf(const Example& example, const Progress& progress) {
  TriangleMesh mesh = fieldToMesh(example.field(), {.wraps = example.continues}, progress);
  turn(mesh, example.turn);
  return mesh;
}

TriangleMesh pictured(const Example& example, const Progress& progress) {
  if (example.form() == Form::Labels) {
    if (const auto* labeled = std::get_if<LabeledField>(&example.content)) {
      Example field = example;
      field.data = labeled->field;
      return pictured(field, progress);
    }
    return example.mesh ? *example.mesh
                        : boxesOf(example.labels(), false, example.name(), progress);
  }
  if (example.mesh && example.kind == SourceKind::Mesh) {
    TriangleMesh mesh = *example.mesh;
    turn(mesh, example.turn);
    return mesh;
  }
  const DistanceField& field = example.field();
  TriangleMesh mesh = fieldToMesh(field, {}, progress.part(0, 0.6));
  if (example.mesh) {
    transferAppearance(mesh, field, identityOrigins(field.size()), *example.mesh, field, {},
                       progress.part(0.6, 1));
  }
  turn(mesh, example.turn);
  return mesh;
}

TriangleMesh pictured(const Source& source, const ReadOptions& options, const Progress& progress) {
  const SourceKind kind = sourceKind(source);
  if (kind == SourceKind::Mesh) return readTriangles(source, options.mesh, progress);
  if (kind == SourceKind::Labels)
    return boxesOf(readLabelGrid(source), false, source.name(), progress);
  // A scene of model pieces is shown as it is, not as what a distance field leaves of it.
  if (kind == SourceKind::Pieces) return readSceneOf(source, {}, progress).mesh;
  return pictured(readExample(source, options, progress.part(0, 0.5)), progress.part(0.5, 1));
}

std::string readableHealth(const MeshHealth& health) {
  std::string text = withThousands(health.triangles) + " triangles, ";
  text += health.closed() ? "closed" : "open (" + withThousands(health.boundaryEdges) + " edges)";
  text += health.manifold()
              ? ", manifold"
              : ", not manifold (" +
                    withThousands(health.nonManifoldEdges + health.nonManifoldVertices) +
                    " places)";
  text += health.oriented() ? ", consistently oriented"
                            : ", not consistently oriented (" +
                                  withThousands(health.misorientedEdges) + " edges)";
  return text;
}

}  // namespace exemplar
