// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "core/array3d.h"
#include "core/progress.h"

namespace exemplar {

/// How alike a result on a surface is to its example, both ways.
struct SurfaceLikeness {
  double likeness = 0;  ///< LP-dense: the share of the patches' windows that the example has; 0..1
  double coverage = 0;  ///< the share of the example's windows that the patches have; 0..1
  double meanIou = 0;   ///< the mean of the windows' best IoU, without a threshold's jumps; 0..1
  std::int64_t windows = 0;  ///< of the patches
};

/// `patchLikeness` (LP-dense and coverage) of pieces of a result that were laid flat again:
/// `patches` of distances with z up, all of one size, against `example`, which may be turned
/// `turns` times (1, 2, 4) in once around. Windows lie wholly inside a patch.
///
/// Patches have `perSample` places to a sample of the example along x and y. Where the example's
/// grid is in them is not known, and half a sample aside wires 3.5 samples thick have an IoU of .8
/// with themselves: of the perSample² grids of each patch the one counts that is most like the
/// example. Laying a result flat resamples it even so: compare with a plane's.
///
/// O(perSample² x windows x example); the same bytes at any number of threads. Throws `InputError`
/// where there are no patches or no room for a window, and `Cancelled`.
SurfaceLikeness surfaceLikeness(std::span<const Array3D<float>> patches, int perSample,
                                const Array3D<float>& example, int turns,
                                const Progress& progress = {});

}  // namespace exemplar
