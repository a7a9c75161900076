// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/progress.h"
#include "engine/example.h"
#include "engine/result.h"
#include "engine/setting.h"
#include "mesh/mesh_health.h"
#include "mesh/triangle_mesh.h"

/// Results, and examples, as surfaces.
namespace exemplar {

/// How a field becomes triangles.
enum class SurfaceKind {
  Contour,  ///< the new field's zero: closed, manifold
  Copy,     ///< the example's own triangles, copied
};

struct SurfaceOptions {
  SurfaceKind surface = SurfaceKind::Contour;
  double simplify = 0;         ///< Field: merge triangles that stay within this many voxels, >= 0
  std::int64_t triangles = 0;  ///< Field: merge triangles down to this many; 0 for not at all
  int detail = 1;          ///< Field: re-make the result at this many times the resolution, 1..16
  bool instances = false;  ///< Labels: write each model piece once and place it (.glb)
};
/// The settings that fill `SurfaceOptions`, for results of a form.
const SettingTable<SurfaceOptions>& surfaceSettings(Form form);

/// Throws `InputError` where results of so many examples cannot have such a surface, and where
/// results of these cannot.
void requireSurface(const SurfaceOptions& options, std::size_t examples);
void requireSurface(const SurfaceOptions& options, std::span<const Example> examples);

struct Surface {
  TriangleMesh mesh;
  MeshHealth health;
  std::int64_t contoured = 0;  ///< triangles of a contour before they were merged
};

/// A complete result as triangles with the examples' materials: of a field its contour, or the
/// example's triangles copied; of labels the example's model pieces, or blocks of its field, or
/// boxes. Does not apply `SurfaceOptions::detail` (`withDetail` does). Throws `InputError` where
/// there is no surface, and `Cancelled`. Surfaces lie as in the example's file (`Example::turn`).
Surface realize(const Result& result, std::span<const Example> examples,
                const SurfaceOptions& options = {}, const Progress& progress = {});

/// A grid of an example's labels as triangles.
TriangleMesh realizeLabels(const LabelGrid& grid, const Example& example,
                           const Progress& progress = {});

/// The contour of an example's field, without materials, open where copies of the field join.
TriangleMesh contourOf(const Example& example, const Progress& progress = {});

/// An example as pictures show it: a mesh as it is; labels as boxes, or as the pieces or the field
/// that they were made of; a field contoured, closed where its box cuts it, with the materials of
/// its mesh.
TriangleMesh pictured(const Example& example, const Progress& progress = {});
/// The same from a source; a mesh or a scene of pieces is not sampled for it.
TriangleMesh pictured(const Source& source, const ReadOptions& options,
                      const Progress& progress = {});

/// "12,345 triangles, closed, manifold, oriented", with the counts of what is not so.
std::string readableHealth(const MeshHealth& health);

}  // namespace exemplar
