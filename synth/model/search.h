// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "core/outcome.h"
#include "core/progress.h"
#include "synth/model/catalog.h"

namespace exemplar {

/// Picks one of the labels left to a cell; `draw` is new at each call of one search.
using ChooseLabel = std::function<int(int cell, std::span<const LabelWord> labels, int draw)>;

/// Decides the cells of `order`, in that order, with propagation after each decision (thesis,
/// Algorithm 3.1). A label that leaves some cell without any is taken away at once and counted;
/// false where a cell so loses all of its labels: the catalog is then arc consistent, and the cells
/// decided so far are among `order`'s first. The catalog must be arc consistent, without marks.
bool labelInOrder(Catalog& catalog, std::span<const std::int32_t> order, const ChooseLabel& choose,
                  std::int64_t& contradictions, const Progress& progress = {});

/// Decides the cells of `order`, in that order, by depth-first search with propagation after each
/// decision and conflict-directed backjumping (Prosser 1993, as in `Catalog`): where a cell is left
/// without labels, the search goes back to the last decision that had a part in it, however far
/// that is, and takes its label away.
///
/// The catalog must be arc consistent, without marks. When Complete it holds the solution; when
/// Impossible none exists; otherwise more than `conflicts` cells were left without labels, or
/// `Catalog::steps` has passed `lastStep`, and the catalog is back where it was but for labels that
/// were shown not to work.
Outcome searchLabels(Catalog& catalog, std::span<const std::int32_t> order,
                     const ChooseLabel& choose, std::int64_t conflicts,
                     const Progress& progress = {},
                     std::int64_t lastStep = std::numeric_limits<std::int64_t>::max());

}  // namespace exemplar
