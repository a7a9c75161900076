// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/vec.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// How a result repeats itself (thesis, section 3.5.2). The axes and planes of symmetry go through
/// the middle of the grid.
struct ModelSymmetry {
  bool mirrorX = false;   ///< left and right of the middle plane across x are mirror images
  bool mirrorY = false;   ///< front and back of the middle plane across y are mirror images
  int turns = 1;          ///< 1, 2 or 4: alike after a half or a quarter turn about z
  Vec3i copies{1, 1, 1};  ///< along each axis so many equal parts; each divides the size there

  /// What each label becomes when mirrored across x or y, or turned a quarter anticlockwise; a
  /// label whose entry is not a label has no image and does not occur where it would need one.
  /// Empty: each label is its own image.
  std::vector<Label> mirroredX, mirroredY, turned;

  bool any() const { return mirrorX || mirrorY || turns > 1 || copies != Vec3i{1, 1, 1}; }
};

}  // namespace exemplar
