// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <vector>

#include "core/progress.h"
#include "synth/model/choose.h"
#include "synth/model/problem.h"
#include "synth/model/region.h"
#include "synth/model/tile.h"

namespace exemplar {

/// A consistent labeling to begin with: a column of cells, or a tile of up to three by three of
/// them (eight by eight in a flat result), that repeats along x and y and meets every demand; where
/// none does, with one to four columns along each side that do not repeat, since what may be at a
/// side seldom goes on within. The thesis takes the example's corner or empty space for granted
/// (section 3.3.6); here tiles are searched, smallest first, exactly where propagation does not
/// decide. None: no tile of these sizes does. With `plain` cells take the label that is most
/// frequent in the examples, not one at random. O(cells) for each size tried.
std::optional<std::vector<Label>> findTiledStart(const ModelProblem& problem, const LabelSets& base,
                                                 const LabelChooser& chooser,
                                                 ModelStatistics& statistics,
                                                 const Progress& progress, bool plain = false);

/// Labels for all cells of `region`, which is all of a tile, by search and the exact solver, and
/// the tile laid over the result. None where nothing is found soon, or where a periodic side does
/// not meet its opposite after whole tiles.
std::optional<std::vector<Label>> layTile(const ModelProblem& problem, const Tile& tile,
                                          Region& region, const RegionChoice& choice,
                                          ModelStatistics& statistics,
                                          const Progress& progress = {});

/// Whether every pair of neighbors in the network is allowed.
bool consistent(const LabelNetwork& network, const std::vector<Label>& labels);

}  // namespace exemplar
