// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/origin.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// How geometry synthesis came out.
enum class SynthesisStatus { Complete, Cancelled };

/// What every geometry engine returns: a new field, and for each of its samples the sample of the
/// example that it was taken from (`core/origin.h`). Where `status` is not Complete the result is
/// partial.
struct SynthesisResult {
  SynthesisStatus status = SynthesisStatus::Complete;
  DistanceField field;
  Origins origins;           ///< the same size as `field`
  std::int64_t matches = 0;  ///< searches for a best block that were run
};

}  // namespace exemplar
