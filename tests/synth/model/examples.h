// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <vector>

#include "voxelize/label_grid.h"

namespace exemplar::test {

/// A grid drawn as text: one string a row (x to the right), rows from the front (y = 0) to the
/// back, layers from the bottom up; '.' is label 0, other characters get labels as they come.
LabelGrid drawn(const std::vector<std::vector<std::string>>& layers);
/// A flat grid; the first string is the topmost row (largest y), as on paper.
LabelGrid drawnFlat(const std::vector<std::string>& rows);

/// The thesis' figure 3.5 rebuilt from its description: from every '2' a path leads to a '6' two
/// cells above, over one of two ways that look alike in part. With `infallible`, the empty
/// cells that this encloses have labels of their own (figure 3.15).
LabelGrid figure35(bool infallible = false);
/// An example of figure 3.6's kind: ends of paths, which come in pairs. Labels are named by where a
/// path leaves the cell: "" for none, "e", "n", "w" or "s" at an end, two letters between.
LabelGrid figure36();

/// Terrain of the canyon's kind: 40-60 labels; plain propagation hardly ever fails.
LabelGrid canyon();
/// Streets, lamps, cars and houses of the city's kind: 100-130 labels.
LabelGrid city();
/// Machinery of the gadgets' kind: closed belts that run one way, geared shafts from side to side;
/// about 30 labels.
LabelGrid gadgets();
/// Wings, towers and a dome of the parliament's kind: about 95 labels.
LabelGrid parliament();
/// Paths over arches, pillars and stairs that never end, of the Escheresque example's kind.
LabelGrid escheresque();

}  // namespace exemplar::test
