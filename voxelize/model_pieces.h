// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "voxelize/label_grid.h"

namespace exemplar {

struct ModelPiecesOptions {
  Vec3d cellSize{1, 1, 1};  ///< world units, each > 0
  /// What the grid covers; the mesh's bounding box by default. What lies outside is left out.
  std::optional<Box3d> box;
  int air = 0;  ///< empty cells added at the four sides and above, 0..1024
  /// How far corresponding points of two equal pieces may be apart, in cells; 1e-7..0.1. Unevenness
  /// of what is flat should be a tenth of it at most.
  double tolerance = 1e-4;
};

/// A mesh cut into model pieces (Merrell 2007, section 3; thesis, section 3.1 and figure 3.18): a
/// grid whose labels are what its cells hold.
struct ModelPieces {
  /// A label that no piece is.
  static constexpr Label kNone = 0xffff;

  /// Label 0 is empty; the next ones are pieces in the order in which they come, x fastest, from
  /// the bottom; cells without triangles that lie inside the mesh have a label "inside", so that a
  /// result's solids stay filled. Colors are those of the materials, by area. Names say where most
  /// of a piece's cells lie, its number, and the object (without the number of a copy) and material
  /// that most of it is of: "roof 12, tower, concrete".
  /// Places are "ground" (the lowest layer), "low" (on the ground, nothing above), "roof" (higher,
  /// nothing above), "wall" (something above and below, a side open), "inside" (no side open) and
  /// "span" (nothing below).
  LabelGrid grid;
  /// All pieces' triangles, in world units from their cell's corner, with the example's materials,
  /// textures, texture coordinates and colors.
  TriangleMesh mesh;
  std::vector<std::uint32_t> first;  ///< each label's first triangle in `mesh`, and their number
  double tolerance = 1e-4;           ///< that pieces were compared with, in cells

  /// The piece that each label is when mirrored across x or y, or turned a quarter counterclockwise
  /// about z; `kNone` where the example has none. Turning needs cells that are square seen from
  /// above.
  std::vector<Label> mirroredX, mirroredY, turned;
};

/// Cuts a mesh along a grid and finds the pieces that are equal: of the same materials, shape,
/// texture coordinates and colors, wherever their triangles' vertices lie in the order of the file
/// and however flat parts are cut into triangles. Cost: about 10 microseconds a part that the grid
/// cuts a triangle into, and comparisons of pieces of equally many edges. Deterministic. Throws
/// `InputError` for a mesh that does not `validate`, options out of range, more than 65,534 pieces,
/// and where memory would not do.
ModelPieces cutIntoPieces(const TriangleMesh& mesh, const ModelPiecesOptions& options = {},
                          const Progress& progress = {});

/// Puts pieces back where a grid of their labels has them. Points on the sides of cells that are as
/// near as equal pieces are become one; where a cell's edge ends along a neighbor's, that one is
/// divided, so that no cracks are left where pieces fit. `cellOf`, where given, receives the grid's
/// cell (an index) that each triangle came from. O(triangles). Throws `InputError` where the grid
/// has labels that are no pieces, where the result would have no triangle, or would not fit in
/// memory.
TriangleMesh assemblePieces(const LabelGrid& grid, const ModelPieces& pieces,
                            std::vector<std::uint32_t>* cellOf = nullptr,
                            const Progress& progress = {});

/// Writes a grid of pieces as a `.glb` that holds each piece once and a node for each cell: small,
/// and easy to take apart; cells are not joined. Returns the number of nodes. Throws `InputError`
/// as `assemblePieces` does, and where the file cannot be written.
std::size_t writePieceInstances(const std::filesystem::path& path, const LabelGrid& grid,
                                const ModelPieces& pieces, const Progress& progress = {});

}  // namespace exemplar
