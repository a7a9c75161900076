// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "maps/shape.h"

namespace exemplar {

/// Fills the hole of each plane smoothly from around it: each cell of a coarser resolution is the
/// mean of those of its finer ones that are known.
void fillSmoothly(std::vector<Array3D<float>>& planes, const Shape& hole);

}  // namespace exemplar
