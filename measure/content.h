// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "measure/near_copies.h"
#include "voxelize/label_grid.h"

/// What grids of labels hold: a result can keep every adjacency and still be a lawn, a maze or a
/// copy. These figures say which.
namespace exemplar {

/// Figures of one result of labels against its example.
///
/// A cell is *built* if it is neither empty nor of its layer's *background*, the label that is most
/// frequent in that layer (z) of the example: air above, lawn or rock below, the paper of a
/// picture. Layers above the example's take its uppermost layer's background.
struct Content {
  /// Share of the example's labels that the result shows, 0..1; 1 is best.
  double labelsUsed = 0;
  /// Total variation distance of the shares of all labels, background included: 0..1; 0 is best.
  double labelShares = 0;
  /// Built cells per column over the example's; 1 is best. Nothing where the example has none.
  std::optional<double> density;
  /// The same of the columns that no vertical side of the box touches: the ends of a ground or of
  /// cliffs stand along sides, of which a larger result has less for its area.
  std::optional<double> densityInside;
  /// Jensen-Shannon divergence (bits, 0..1) of the blocks of 1, 2 and 3 cells a side that hold a
  /// built cell; 0 is best. Model synthesis may minimize it: read it with the others.
  std::array<double, 3> divergence{};
  /// The same between two halves of the example, for scale: what a fresh sample of a small example
  /// can reach. Nothing where the example is too small to halve.
  std::array<std::optional<double>, 3> halvesDivergence{};
  /// Of the result's blocks of 3 cells a side with a built cell, the share that the example shows,
  /// 0..1; 1 is best, and reached by copies.
  double known = 0;
  /// Sum over the layers of |built share of the result's layer - of the example's|, over the sum of
  /// the example's: 0 is best. Nothing where the example has no built cell.
  std::optional<double> layers;
  /// The same of the columns that no vertical side touches.
  std::optional<double> layersInside;
  /// Objects (of built cells, connected by faces) for each 100 columns. Streets, walls and floors
  /// may join everything near the ground, so objects are counted from layer `objectsFrom` up: that
  /// at which the example falls into most, each counted with its share of what is built. An object
  /// that touches a vertical side of the box is one that the box may have cut, and counts half.
  double objects = 0, exampleObjects = 0;
  int objectsFrom = 0;
  /// Kolmogorov-Smirnov distance of the sizes of objects, 0..1; 0 is best. Of whole objects; of all
  /// where the example or the result has no whole one. Nothing where either has no object.
  std::optional<double> objectSizes;
  /// Mean length of straight runs of one label over built cells along x, y and z, over the
  /// example's; 1 is best. Nothing along an axis where either has one cell, or nothing built.
  std::array<std::optional<double>, 3> runs;
  /// Of the windows of 8 x 8 columns of full height with a built cell, the share that is verbatim
  /// in the example, 0..1: 0 is new, 1 is a copy. Windows are smaller where the example is.
  double copied = 0;
  /// The same for windows that agree but for 5 % of what is built, and the largest area of these at
  /// one place (`findNearCopies`). Nothing where that would take more than a second or so: columns
  /// of the result x cells of the examples above 3 x 10^8.
  std::optional<NearCopies> nearCopies;
};

/// Measures `result` against its examples, which share one numbering of labels with it. Layers
/// correspond by height from the bottom. O(cells) time, 24 bytes a cell; blocks are distinguished
/// by 64-bit hashes. The same at any number of threads. Throws `InputError` where label counts
/// differ or a grid is empty, and `Cancelled`.
Content measureContent(std::span<const LabelGrid* const> examples, const LabelGrid& result,
                       const Progress& progress = {});
Content measureContent(const LabelGrid& example, const LabelGrid& result,
                       const Progress& progress = {});

}  // namespace exemplar
