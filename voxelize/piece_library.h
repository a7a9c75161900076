// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "voxelize/model_pieces.h"

/// Model pieces for programs that place meshes in cells: each shape once, and how it lies.
namespace exemplar {

/// What a label's piece is made of: another label's, mirrored and turned in its cell.
struct PieceForm {
  Label shape = 0;        ///< the lowest label of this shape, itself where it is the first
  bool mirrored = false;  ///< first mirrored across the plane x = the cell's center
  int turns = 0;  ///< then quarter turns about the cell's vertical axis, anticlockwise, 0..3
  bool operator==(const PieceForm&) const = default;
};

/// The form of each label. Labels without triangles (empty, inside) are their own shape.
std::vector<PieceForm> pieceForms(const ModelPieces& pieces);

/// What a label's piece is called in files: its name with nothing but ASCII letters, digits and
/// "_", which no importer changes ("roof_12_concrete").
std::string pieceName(const ModelPieces& pieces, Label label);

/// Writes a `.glb`, y up, with a mesh and a node for each shape, both called `pieceName`; positions
/// are from the center of a cell. Nodes are laid out in rows. Returns the number of meshes. Throws
/// `InputError` where the file cannot be written, and `Cancelled`.
std::size_t writePieceLibrary(const std::filesystem::path& path, const ModelPieces& pieces,
                              const Progress& progress = {});

}  // namespace exemplar
