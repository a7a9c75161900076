// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"

namespace exemplar {

/// Marks every sample that has a mark (anything but 0) at most `reach` >= 0 samples away along each
/// axis: a dilation by a cube. O(n) for n samples, whatever the reach.
Array3D<std::uint8_t> dilated(Array3D<std::uint8_t> marks, int reach);

}  // namespace exemplar
