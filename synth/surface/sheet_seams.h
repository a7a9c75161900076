// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "synth/surface/placements.h"
#include "synth/surface/sheet.h"
#include "synth/surface/slab.h"

namespace exemplar::surface {

struct SheetSeamOptions {
  int passes = 2;        ///< over all placements, >= 0
  double length = 0.05;  ///< cost of a seam in itself, samples a height; >= 0
  double slope = 1;      ///< weight of slopes that differ across a seam; >= 0
};

struct SheetSeams {
  std::int64_t before = 0, after = 0;  ///< what all seams cost
  std::int64_t seamEdges = 0;          ///< edges between nodes of two placements, afterwards
};

/// Moves the seams between placements to where both sides agree best: `refineSeams`
/// (synth/geometry/seams) on the graph of a sheet's nodes, whose values are the example's columns.
///
/// Where node x shows placement a and its neighbor y placement b, the edge costs |A(x) - B(x)| +
/// |A(y) - B(y)| + slope |(A(x) - B(x)) - (A(y) - B(y))|, summed over heights, times the length of
/// the edge's dual. Each placement in turn takes the best subset of its map, by a minimum cut; the
/// sum never rises. Placements whose maps share no node move in parallel. The same bytes at any
/// number of threads. Throws `Cancelled`, with owners still sound.
SheetSeams cutSeams(const Sheet& sheet, const Slab& slab, Placements& placements,
                    const SheetSeamOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar::surface
