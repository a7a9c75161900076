// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// What every geometry engine returns: a new field, and for each of its samples the sample of the
/// example that it was taken from (`core/origin.h`). A cancelled engine returns nothing; it throws
/// `Cancelled`.
struct SynthesisResult {
  DistanceField field;
  Origins origins;           ///< the same size as `field`
  std::int64_t matches = 0;  ///< searches for a best block or patch that were run
};

}  // namespace exemplar
