// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "core/array3d.h"
#include "core/axes.h"
#include "core/progress.h"
#include "mesh/image.h"
#include "voxelize/adjacency.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// How a picture becomes a flat grid of labels.
struct ImageLabelsOptions {
  int piece = 1;  ///< pixels a side of what is one label, 1..256
  /// Whether pieces begin at every pixel rather than at every `piece`th: each label is then a pixel
  /// with what is right of it and above it, so that adjacency reaches that far.
  bool overlap = false;
  /// Axes, x and y, along which the picture goes on from its end with its beginning: pieces then
  /// reach over it, where they overlap; else the picture must be whole pieces long.
  Axes periodic;
  /// Pieces that overlap are neighbors only where the picture shows them so, not wherever they
  /// agree in what they share.
  bool seen = false;
  /// In how many ways the picture counts as an example: 1 as it is; 2 mirrored left and right, too;
  /// 4 also turned a quarter counterclockwise, and that mirrored; 8 in all ways. The order is that
  /// of wave function collapse.
  int symmetry = 1;
};

/// A picture as labels, and what each label looks like.
struct ImageLabels {
  /// One layer; x runs to the right, y up. Labels are numbered in the order in which pieces come,
  /// row by row from the picture's top. Their colors are those of the piece's lower left pixel
  /// where pieces overlap, else its average; a piece that is transparent throughout is empty.
  LabelGrid grid;
  ImageLabelsOptions options;
  std::vector<Image8> pieces;  ///< RGBA, one for each label, those of `turned` last
  /// The picture mirrored and turned, as further grids of the same labels.
  struct Turned {
    LabelGrid grid;
    Array3D<Vec3i> from;  ///< the cell of the picture's own grid that each cell shows
    bool upright = true;  ///< whether what is up is up
  };
  std::vector<Turned> turned;
};

/// Cuts a picture into labels: equal pieces (all transparent pixels are equal) are one label. What
/// is left at the right and top, less than a piece, is not taken. Throws `InputError` ("NAME: ...")
/// where the picture is smaller than a piece, has more than 65,536 different ones, or is not whole
/// pieces long along a periodic axis; where `symmetry` is not 1, 2, 4 or 8, or turns a picture that
/// is periodic along one axis only.
ImageLabels labelsFromImage(const Image8& image, const std::string& name,
                            const ImageLabelsOptions& options = {}, const Progress& progress = {});

/// Which labels may be neighbors: as the grids show (`findAdjacency`), and along x and y, where
/// pieces of more than one pixel overlap and `seen` is off, all that agree in the pixels they
/// share, as in wave function collapse with overlapping patterns. Pairs that are not shown count
/// once. All pixels of a grid of such pairs then form a picture in which every window is one of the
/// example's. `grids` share the labels of `labels`.
Adjacency imageAdjacency(std::span<const LabelGrid> grids, const ImageLabels& labels,
                         const AdjacencyOptions& options = {}, const Progress& progress = {});

/// The picture of a flat grid: a piece for each label; where pieces overlap, their lower left
/// pixels, and all of the pieces in the last column and the top row. Along `periodic` axes it is
/// the period, a step of pixels for each cell: what reaches over its end is at its beginning.
/// Throws `InputError` for a grid of more than one layer or with labels that have no piece.
Image8 imageFromLabels(const LabelGrid& grid, const ImageLabels& labels,
                       const Progress& progress = {}, const Axes& periodic = {});

/// The picture of a flat grid, a pixel for each cell in the label's own color.
Image8 imageFromLabels(const LabelGrid& grid, const Progress& progress = {});

}  // namespace exemplar
