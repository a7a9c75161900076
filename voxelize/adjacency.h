// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/axes.h"
#include "core/progress.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// A step from one cell to another, in cells; `t` counts frames of a model that changes over time.
struct CellOffset {
  int x = 0, y = 0, z = 0, t = 0;
  auto operator<=>(const CellOffset&) const = default;
};

/// Two labels that an example shows at an offset, `second` that far from `first`.
struct LabelPair {
  Label first = 0, second = 0;
  std::int64_t count = 0;  ///< how often the example shows it; >= 1
  bool operator==(const LabelPair&) const = default;
};

/// Which labels may be neighbors at one offset: the transition matrix of a direction (thesis,
/// equation 3.2) with the frequencies that it drops.
struct PairRule {
  CellOffset offset;
  std::vector<LabelPair> pairs;  ///< ascending by `first`, then `second`; nothing twice

  /// How often `second` is at the offset from `first`; 0: never. O(log pairs).
  std::int64_t count(Label first, Label second) const;
  bool allows(Label first, Label second) const { return count(first, second) > 0; }
};

/// The sides of a box of cells, in the order in which arrays of six hold them.
enum class Side { MinX, MaxX, MinY, MaxY, MinZ, MaxZ };

/// All that model synthesis knows of an example (Merrell 2007, section 2; thesis, section 3.1).
struct Adjacency {
  int labelCount = 0;
  /// Along +x, +y, +z, and +t for an example of frames; then the further offsets. The rule of an
  /// axis along which the example is one cell thick has no pairs.
  std::vector<PairRule> rules;
  std::vector<std::int64_t> frequency;  ///< cells of each label; may be 0
  /// The labels in the example's outermost layer at each side, ascending: by default what a result
  /// may show there, so that objects end where the example's do (thesis, section 3.3.6).
  std::array<std::vector<Label>, 6> sides;

  const std::vector<Label>& side(Side s) const { return sides[static_cast<int>(s)]; }
};

struct AdjacencyOptions {
  Axes periodic;  ///< the example's opposite sides meet: its last cell is followed by its first
  /// Further pairs to keep: diagonals, cells two apart, the third axis {1, -1, 0} of a hexagonal
  /// grid (thesis, section 3.5.1). Not the zero offset, and none twice or against another.
  std::vector<CellOffset> offsets;
  /// The grids are the frames, one after the other, of one example that changes over time (thesis,
  /// section 3.5.4), not examples of their own.
  bool frames = false;
};

/// Counts the ordered pairs of labels in the examples, which share one numbering of labels:
/// equation 3.2, with frequencies. O(cells x log cells) for each offset. Throws `InputError` where
/// the examples' label counts differ, frames differ in size, or an example is empty.
Adjacency findAdjacency(std::span<const LabelGrid> examples, const AdjacencyOptions& options = {},
                        const Progress& progress = {});
Adjacency findAdjacency(const LabelGrid& example, const AdjacencyOptions& options = {},
                        const Progress& progress = {});

}  // namespace exemplar
