// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>

#include "core/array3d.h"
#include "core/progress.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// The built cells of a grid of labels: `kNotBuilt` where a cell is not.
using BuiltLabels = Array3D<Label>;
inline constexpr Label kNotBuilt = 0xFFFF;

/// How much of a result looks copied, whatever few cells differ.
struct NearCopies {
  /// Of the result's windows of 8 x 8 columns of full height with a built cell, the share that
  /// agrees with a window of an example in at least 95 % of the cells that are built in either,
  /// 0..1. Windows are smaller where the example is.
  double windows = 0;
  /// Columns of the largest area that such windows cover, joined at one and the same offset between
  /// result and example, over the example's columns: 1 is the whole example once more.
  double largest = 0;
};

/// Compares a result with its examples at all offsets along x and y. O(columns of the result x
/// cells of the examples). The same at any number of threads. Throws `Cancelled`.
NearCopies findNearCopies(std::span<const BuiltLabels> examples, const BuiltLabels& result,
                          const Progress& progress = {});

}  // namespace exemplar
