// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/array3d.h"
#include "core/vec.h"

namespace exemplar {

/// What a cell is: a number from 0 to the grid's label count less one. By custom 0 is empty.
using Label = std::uint16_t;

/// The most labels that a grid can have.
inline constexpr int kMostLabels = 65536;

/// What a label looks like, where that is known.
struct LabelLook {
  std::string name;                                    ///< of its object or material; may be empty
  std::array<float, 4> color{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGB and opacity, 0..1
  /// Lines that describe its objects in the text format; carried from file to file, not read.
  std::vector<std::string> objects;
};

/// Whether cells of a label hold nothing: its opacity is 0.
inline bool isEmpty(const LabelLook& look) { return !(look.color[3] > 0); }

/// A box of cells, each with a label; z is up. The example of model synthesis and its result
/// (Merrell 2007, section 3; thesis, section 3.1).
struct LabelGrid {
  Array3D<Label> cells;
  std::vector<LabelLook> labels;  ///< one for each label there may be; cells hold only these
  Vec3d cellSize{1, 1, 1};        ///< world units
  Vec3d origin{};                 ///< world position of the lowest corner of cell (0, 0, 0)
  std::string name;               ///< of the scene; may be empty

  const Vec3i& size() const { return cells.size(); }
  int labelCount() const { return static_cast<int>(labels.size()); }
};

/// Throws `InputError` ("NAME: ...") unless the grid has a cell, every cell's label has a look,
/// colors are 0..1 and the cells' size and place are finite, the size positive.
void validate(const LabelGrid& grid, const std::string& name);

/// The look of label 0 in files that do not describe it: empty.
LabelLook emptyLook();

/// A color for a label whose own is not known, linear RGB and opacity 1: neighboring numbers
/// differ clearly, and a number has the same color in every grid.
std::array<float, 4> distinctColor(int label);

}  // namespace exemplar
