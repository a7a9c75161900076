// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "sdf/distance_field.h"

namespace exemplar {

/// Throws `InputError` unless both fields have samples and voxels of the same size, to one in a
/// thousand: every figure that compares two fields counts in voxels.
void requireSameVoxels(const DistanceField& example, const DistanceField& result);

}  // namespace exemplar
