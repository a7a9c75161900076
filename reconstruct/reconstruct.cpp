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

constexpr int kMostLods = 8;

void check(const ReconstructOptions& options) {
  if (!(options.simplify >= 0)) throw InputError("`simplify` must be 0 or more");
  if (options.triangles < 0) throw InputError("`triangles` must be 0 or more");
  if (options.lods < 0 || options.lods > kMostLods) throw InputError("`lods` must be 0 to 8");
  const bool merges = options.simplify > 0 || options.triangles > 0 || options.lods > 0;
  if (merges && options.contour.wraps.any()) {
    throw InputError(
        "`simplify`, `triangles`, `lods`: copies of a periodic result join only where its "
        "triangles are as they are; leave these out, or `periodic`");
  }
}

/// Merges triangles within `error` (world units) until there are no more than `triangles`.
void merge(TriangleMesh& mesh, const DistanceField& field, double error, std::int64_t triangles,
           const Progress& progress) {
  DecimateOptions options;
  options.error = error;
  options.triangles = triangles;
  options.box = field.box();
  decimate(mesh, options, progress.part(0, 0.8));
  makeManifold(mesh, {}, progress.part(0.8, 1));  // triangles gone flat
}

/// Merges triangles as the options say.
void simplify(TriangleMesh& mesh, const DistanceField& field, const ReconstructOptions& options,
              const Progress& progress) {
  if (options.simplify == 0 && options.triangles == 0) return;
  merge(mesh, field,
        options.simplify > 0 ? options.simplify * field.voxelSize
                             : std::numeric_limits<double>::infinity(),
        options.triangles, progress);
}

/// A coarser copy of a surface, whose triangles `finish` may cut along borders of materials: where
/// that makes many more than `triangles`, so many fewer are left for it.
template <class Finish>
CoarserSurface coarser(const TriangleMesh& mesh, const DistanceField& field, std::int64_t triangles,
                       const Finish& finish, const Progress& progress) {
  constexpr double kAllowance = 1.05;
  std::int64_t left = triangles;
  for (int attempt = 0;; ++attempt) {
    const Progress part = progress.part(0.5 * attempt, 0.5 * (attempt + 1));
    CoarserSurface lod{mesh, {}};
    merge(lod.mesh, field, std::numeric_limits<double>::infinity(), left, part.part(0, 0.5));
    const auto merged = static_cast<double>(lod.mesh.triangles.size());
    lod.health = finish(lod.mesh, part.part(0.5, 1));
    const auto made = static_cast<double>(lod.mesh.triangles.size());
    const bool cut = made > merged && made > kAllowance * static_cast<double>(triangles);
    if (attempt == 1 || !cut) return lod;
    // Cuts go with the square root of triangles, or slower: what remains is near the mark.
    left = std::max<std::int64_t>(
        static_cast<std::int64_t>(merged * static_cast<double>(triangles) / made), 4);
  }
}

}  // namespace

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  std::span<const ReconstructExample> examples,
                                  const ReconstructOptions& options, const Progress& progress) {
  check(options);
  Reconstruction result;
  FieldToMeshOptions contour = options.contour;
  contour.checkHealth = false;
  const bool dressed = std::all_of(examples.begin(), examples.end(),
                                   [](const ReconstructExample& e) { return e.mesh; });
  // What the coarser copies take comes last.
  const double whole = options.lods > 0 ? 0.6 : 1;
  const double contoured = (dressed ? 0.4 : 0.9) * whole;
  result.mesh = fieldToMesh(field, contour, progress.part(0, 0.8 * contoured), &result.contour);
  result.contoured = static_cast<std::int64_t>(result.mesh.triangles.size());
  simplify(result.mesh, field, options, progress.part(0.8 * contoured, contoured));
  const TriangleMesh bare = options.lods > 0 ? result.mesh : TriangleMesh{};
  std::vector<ExampleView> views;
  for (const ReconstructExample& example : examples)
    if (dressed) views.push_back({*example.mesh, example.field});
  const auto finish = [&](TriangleMesh& mesh, const Progress& part) {
    if (dressed)
      transferAppearance(mesh, field, origins, views, options.appearance, part.part(0, 0.85));
    return meshHealth(mesh, part.part(0.85, 1));
  };
  result.health = finish(result.mesh, progress.part(contoured, whole));
  // Each is made of the whole surface, so that their errors do not add up.
  for (int n = 0; n < options.lods; ++n) {
    const auto before = static_cast<std::int64_t>(
        n == 0 ? result.mesh.triangles.size() : result.lods.back().mesh.triangles.size());
    result.lods.push_back(coarser(bare, field, std::max<std::int64_t>(before / 4, 4), finish,
                                  progress.part(whole + (1 - whole) * n / options.lods,
                                                whole + (1 - whole) * (n + 1) / options.lods)));
  }
  return result;
}

Reconstruction reconstructSurface(const DistanceField& field, const Origins& origins,
                                  const ReconstructExample& example,
                                  const ReconstructOptions& options, const Progress& progress) {
  return reconstructSurface(field, origins, std::span(&example, 1), options, progress);
}

}  // namespace exemplar
