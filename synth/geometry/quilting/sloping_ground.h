// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "sdf/distance_field.h"

namespace exemplar {

/// Whether an example is ground (solid all over its lowest layer, air all over its highest) that is
/// higher at one side than at the opposite one by more than a voxel, along x or y. The ends of
/// large blocks of such ground would meet in cliffs. O(samples).
bool isSlopingGround(const DistanceField& example);

}  // namespace exemplar
