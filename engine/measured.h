// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <span>

#include "core/progress.h"
#include "engine/example.h"
#include "engine/result.h"
#include "measure/figures.h"
#include "measure/layers.h"
#include "measure/measure.h"
#include "mesh/triangle_mesh.h"

/// How alike, how new and how seamless a result is (docs/measures.md).
namespace exemplar {

/// Measures a complete result against its (first) example; `surface` is its mesh, where it was
/// realized. Nothing for labels that stand for no field. Throws `Cancelled`.
std::optional<Measures> measure(const Result& result, std::span<const Example> examples,
                                const TriangleMesh* surface = nullptr,
                                const Progress& progress = {});

/// What a complete result of labels holds, against its examples; of frames, the first. Nothing for
/// results of distances. Throws `Cancelled`.
std::optional<Content> measureContent(const Result& result, std::span<const Example> examples,
                                      const Progress& progress = {});
/// The same of a result in a file: a grid of labels or a picture, numbered as the example's labels
/// are where it is a .txt or .vdb, by color otherwise. `example` is of the form Labels. Throws
/// `InputError` and `Cancelled`.
Content measureContent(const Source& result, const Example& example, const Progress& progress = {});

/// A complete result of a height map as terrain: by the heights of its field's columns against the
/// example's, sampled alike. Nothing for other results. Throws `Cancelled`.
std::optional<TerrainLikeness> measureTerrain(const Result& result,
                                              std::span<const Example> examples,
                                              const Progress& progress = {});
/// Two volumes of labels as layers, the result's as the example's are found. Throws `InputError`
/// and `Cancelled`.
LayersLikeness measureLayers(const Source& example, const Source& result,
                             const Progress& progress = {});

/// Whether both are height maps, which are measured as terrain.
bool areHeights(const Source& example, const Source& result);
/// Two height maps against each other, at the example's `cell-size` and `height-scale`. What
/// neither the files nor the reading options say (the cells' size, what integers stand for) is
/// taken to be the same for both; `warnings` hears what is. Throws `InputError`, also where the
/// cells differ in size, and `Cancelled`.
TerrainLikeness measureTerrain(const Source& example, const Source& result,
                               const ReadOptions& reading, Warnings& warnings,
                               const Progress& progress = {});

/// What is measured against an example: a result, as it was made or read from files.
struct Measured {
  DistanceField field;
  std::optional<TriangleMesh> mesh;  ///< its triangles, where it was given as a mesh
  Origins origins;                   ///< none: without cells
};
/// Reads a result to measure: a .vdb, or another example, by its own samples; a mesh sampled where
/// a synthesis' samples were, of the example's voxels, at `scale` times its size or, where that is
/// not given, as its origins say or as it is guessed. `origins` may be nothing. Throws
/// `InputError`.
Measured readMeasured(const Source& result, const std::optional<Source>& origins,
                      const std::optional<Vec3d>& scale, const Example& example,
                      const Progress& progress = {});
/// Its triangles: as given, or made of its samples, with the example's materials where it has
/// origins. Throws `InputError` and `Cancelled`.
TriangleMesh surfaceOf(const Measured& result, const Example& example,
                       const Progress& progress = {});
Measures measure(const Measured& result, const Example& example, const Progress& progress = {});

}  // namespace exemplar
