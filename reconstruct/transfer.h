// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "core/origin.h"
#include "core/origin_map.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// One of the examples that origins name: its triangles, and the field whose cells the origins are.
/// Both outlive the call.
struct ExampleView {
  const TriangleMesh& mesh;
  const DistanceField& field;
};

/// What becomes of textures.
enum class TextureTransfer {
  Automatic,     ///< Coordinates where the example has them, with a texture or without, else Drop
  Coordinates,   ///< texture coordinates: the texture's full detail, hard joints between copied
                 ///< parts
  VertexColors,  ///< the texture's color at each vertex, blended across joints: detail of a voxel
  Drop,
};

struct TransferOptions {
  TextureTransfer textures = TextureTransfer::Automatic;
  /// Colors of the parts that meet at a seam are mixed over this many voxels, 0.5..4.
  double blend = 1.5;
  /// Cut triangles where the material changes inside them, so that borders are as sharp and
  /// straight as the example's; else they run along triangle sides. The surface stays as it is.
  bool cutBorders = true;
  /// Rounds in which a triangle takes the material of most of its neighbors, 0..100: lone
  /// triangles at seams go.
  int materialRounds = 2;
  /// Where points came from, in place of the origins; none: the origins say it. Outlives the call.
  const OriginMap* map = nullptr;
  /// Keep for each corner the place of the example that it came from (`TriangleMesh::sources`).
  bool sources = false;
};

/// Gives `result`, the surface of `field`, the materials, vertex colors and textures of the
/// examples, pulled through the origins: a point of the result goes with the motion of a sample
/// beside it into the example and takes what the nearest triangle there has. "Our algorithm could
/// be extended to account for other signals present on the geometry, such as color information"
/// (Lagae 2004, section 7).
///
/// Several motions meet at seams. Each counts the more, the nearer its sample is and the nearer the
/// place it names is to the example's surface (a sample in the air can come from anywhere), and
/// triangles that face the other way count as farther, so a thin wall keeps its two sides apart.
/// Colors are the weighted mean; a material is the one with most weight, and borders between
/// materials are then cleaned. Texture coordinates come from the one best motion and stay inside
/// one chart for each triangle, so nothing is smeared across the atlas.
///
/// What `result` carried before is replaced; positions stay, and `cutBorders` adds vertices on
/// triangle sides. O(m log n) for m result and n example triangles. The same bytes at any
/// number of threads. Throws `InputError` for options out of range, and where origins and field do
/// not match or name an example that is not there.
void transferAppearance(TriangleMesh& result, const DistanceField& field, const Origins& origins,
                        std::span<const ExampleView> examples, const TransferOptions& options = {},
                        const Progress& progress = {});

/// The same for one example.
void transferAppearance(TriangleMesh& result, const DistanceField& field, const Origins& origins,
                        const TriangleMesh& example, const DistanceField& exampleField,
                        const TransferOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
