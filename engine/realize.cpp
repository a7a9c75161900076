// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/realize.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "engine/example_forms.h"
#include "engine/height_mesh.h"
#include "engine/words.h"
#include "mesh/footprint.h"
#include "reconstruct/copy_triangles.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/transfer.h"
#include "synth/continuous/stand_ins.h"
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
  return {std::move(made.mesh), made.health, 0, {}};
}

Surface contoured(const Result& result, std::span<const Example> examples,
                  const SurfaceOptions& surface, const Progress& progress) {
  std::vector<ReconstructExample> views;
  for (const Example& example : examples) views.push_back(viewOf(example.field(), example));
  ReconstructOptions options;
  options.contour.wraps = result.periodic;
  options.simplify = surface.simplify;
  options.triangles = surface.triangles;
  options.lods = surface.lods;
  options.appearance.sources = surface.source;
  options.appearance.map = result.originMap.get();
  Reconstruction made =
      reconstructSurface(result.field(), result.origins, views, options, progress);
  return {std::move(made.mesh), made.health, made.contoured, std::move(made.lods), {}};
}

/// Gives a result the name of its example's object, or that of its example's file.
void nameAfter(const Example& example, TriangleMesh& mesh) {
  if (example.mesh && !example.mesh->name.empty()) {
    mesh.name = example.mesh->name;
    mesh.dataName = example.mesh->dataName;
  } else {
    mesh.name = example.source.path().stem().string();
  }
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
      settingRow<O>("lods", &O::lods,
                    "also write so many coarser copies (NAME_lod1, ...), each with a quarter of "
                    "the triangles of the one before",
                    {0, 8}),
      settingRow<O>("source", &O::source,
                    "write for each vertex the triangle of the example that it came from, and the "
                    "place there (.glb, .gltf)"),
      settingRow<O>(
          "detail", &O::detail,
          "re-make the result at this many times the resolution, with the example's finer "
          "detail",
          {1, 16})};
  static const SettingTable<O> labels{settingRow<O>(
      "instances", &O::instances, "a .glb of model pieces: write each piece once and place it")};
  static const SettingTable<O> polygons{
      settingRow<O>("shells", &O::shells,
                    "a closed shell of each material, with the faces between two of them, in place "
                    "of the surface that is seen")};
  static const SettingTable<O> maps(std::initializer_list<SettingTable<O>::Row>{});
  switch (form) {
    case Form::Field:
      return field;
    case Form::Labels:
      return labels;
    case Form::Polygons:
      return polygons;
    default:
      return maps;
  }
}

void requireSurface(const SurfaceOptions& options, std::size_t examples) {
  if (options.surface == SurfaceKind::Contour) return;
  if (options.simplify > 0 || options.triangles > 0 || options.lods > 0) {
    throw InputError(
        "`simplify`, `triangles`, `lods`: only a contour is simplified, not copied triangles");
  }
  if (options.source)
    throw InputError("`source`: only a contour says where it came from, not copied triangles");
  if (examples > 1) throw InputError("`surface` copy: there are several examples; use contour");
}

void requireSurface(const SurfaceOptions& options, std::span<const Example> examples) {
  requireSurface(options, examples.size());
  const bool allMeshes = std::ranges::all_of(
      examples, [](const Example& example) { return example.mesh.has_value(); });
  if (options.source && !allMeshes)
    throw InputError("`source`: an example has no triangles that could be named; leave it out");
  if (options.surface == SurfaceKind::Contour) return;
  if (!examples.front().mesh)
    throw InputError("`surface` copy: the example has no triangles to copy; use contour");
}

Surface realize(const Result& result, std::span<const Example> examples,
                const SurfaceOptions& options, const Progress& progress) {
  if (result.outcome != Outcome::Complete)
    throw InputError("there is no result to make a surface of: " + result.why);
  if (result.form() == Form::Map) throw InputError("a map has no surface; write a .png");
  requireSurface(options, examples);
  if (result.originMap && options.surface == SurfaceKind::Copy)
    throw InputError("`surface` copy: on a surface the example is bent; use contour");
  Surface surface;
  if (result.form() == Form::Heights) {
    surface.mesh = meshOfHeights(result.heights(), progress.part(0, 0.7));
    surface.health = meshHealth(surface.mesh, progress.part(0.7, 1));
    nameAfter(examples.front(), surface.mesh);
    return surface;
  }
  if (result.form() == Form::Polygons) {
    continuous::PolygonModel model = result.polygons();
    const std::vector<continuous::StandIn>& standIns = examples.front().solids->standIns;
    const std::vector<continuous::PlacedStandIn> placed = continuous::takeStandIns(model, standIns);
    surface.mesh = continuous::triangulate(
        model, options.shells ? continuous::Faces::Shells : continuous::Faces::Seen, &surface.faces,
        progress.part(0, 0.8));
    if (!options.shells) paintFaces(model, examples.front(), surface.faces, surface.mesh);
    for (const continuous::PlacedStandIn& box : placed) {
      if (const auto& mesh = standIns[box.standIn].mesh)
        append(surface.mesh, continuous::stretched(*mesh, box.box));
    }
    // The triangles of what was put back are faces of their own.
    for (auto face = static_cast<std::uint32_t>(model.polygons.size());
         surface.faces.size() < surface.mesh.triangles.size(); ++face)
      surface.faces.push_back(face);
    if (surface.mesh.triangles.empty()) throw InputError("the result is empty");
    surface.health = meshHealth(surface.mesh, progress.part(0.8, 1));
  } else if (result.form() == Form::Labels) {
    surface.mesh = realizeLabels(result.labels(), examples.front(), progress.part(0, 0.8));
    surface.health = meshHealth(surface.mesh, progress.part(0.8, 1));
  } else {
    surface = options.surface == SurfaceKind::Copy ? copied(result, examples, progress)
                                                   : contoured(result, examples, options, progress);
    const Turn turned = turnOf(result, examples.front());
    turn(surface.mesh, turned);
    for (CoarserSurface& lod : surface.lods) turn(lod.mesh, turned);
  }
  nameAfter(examples.front(), surface.mesh);
  for (CoarserSurface& lod : surface.lods) nameAfter(examples.front(), lod.mesh);
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

Surface contourOf(const Example& example, const SurfaceOptions& options, const Progress& progress) {
  ReconstructOptions contour;
  contour.contour.wraps = example.continues;
  contour.simplify = options.simplify;
  contour.triangles = options.triangles;
  contour.lods = options.lods;
  const ReconstructExample bare{example.field()};
  Reconstruction made = reconstructSurface(example.field(), {}, bare, contour, progress);
  Surface surface{std::move(made.mesh), made.health, made.contoured, std::move(made.lods), {}};
  turn(surface.mesh, example.turn);
  nameAfter(example, surface.mesh);
  for (CoarserSurface& lod : surface.lods) {
    turn(lod.mesh, example.turn);
    nameAfter(example, lod.mesh);
  }
  return surface;
}

TriangleMesh pictured(const Example& example, const Progress& progress) {
  if (example.form() == Form::Map)
    throw InputError(example.name() + ": a map is a picture already");
  if (example.form() == Form::Heights) return meshOfHeights(example.heights(), progress);
  if (example.form() == Form::Polygons) return *example.mesh;
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
  if (kind == SourceKind::Mesh || kind == SourceKind::Solids)
    return readTriangles(source, options.mesh, progress);
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
