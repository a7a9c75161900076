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

/// The thesis' figure 3.5 rebuilt from its description (section 3.3.4): a '2' implies a '6' two
/// cells on, over one of two ways, with a '3' or a '7' beside the '2' that both look possible until
/// they are not; in the infallible twin (section 3.3.8) a '9' replaces an enclosed '0', which
/// statement 3.11 and regions of 2 x 2 prove. The drawing itself is not copied: the letters, the
/// 'i', and which way is up are ours. So: from every '2' a path leads to a '6' two
/// cells above, over one of two ways that look alike in part. With `infallible`, the empty
/// cells that this encloses have labels of their own (figure 3.15).
LabelGrid figure35(bool infallible = false);
/// An example of figure 3.6's kind, after its description (section 3.3.4): ends of paths, which
/// come in pairs, so that three of them contradict each other long before a set is empty. The
/// figure has one path two cells wide; here many wind one cell wide. Labels are named by where a
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
