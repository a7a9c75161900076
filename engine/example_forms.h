// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "engine/example.h"
#include "mesh/scene.h"

/// The ways of reading an example; what `readExample` calls.
namespace exemplar {

/// Fills the example whose source, kind and reading options are set, as distances or as labels.
void readAsField(Example& example, const Progress& progress);
void readAsLabels(Example& example, const Progress& progress);
void readAsPolygons(Example& example, const Progress& progress);
void readAsMap(Example& example, const Progress& progress);
void readAsHeights(Example& example, const Progress& progress);
/// Gives the faces of a result the material and texture coordinates of a face of the example's mesh
/// that has the same substance and looks the same way: its origin, of which that with most area
/// counts. `faces` says which polygon each triangle is a part of.
void paintFaces(const continuous::PolygonModel& model, const Example& example,
                std::span<const std::uint32_t> faces, TriangleMesh& mesh);

/// How the mesh of an example is read: what is left out, and which files it names, are kept in it.
MeshFileOptions meshReading(Example& example);

/// The scene of a file or its bytes.
Scene readSceneOf(const Source& source, const ReadOptions& options, const Progress& progress);

/// Samples an example with the voxels of `first`. Throws `InputError` for a volume of others.
void sampleAlike(Example& example, const Example& first, const Progress& progress);

/// Throws `InputError` where a height map has other cells than `first`.
void requireAlike(const Example& example, const Example& first);
/// Makes one example of height maps that are tiles side by side, in the place of the first of them.
/// Warns of those that lie side by side and do not fit.
void joinTiles(std::vector<Example>& examples);

/// Gives the examples, all labels, one numbering of labels.
void numberAlike(std::vector<Example>& examples);

}  // namespace exemplar
