// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/progress.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

struct StrewOptions {
  Vec3i size{0, 0, 0};  ///< of the result, samples; each component >= 1
  std::uint64_t seed = 0;
};

struct StrewnParts {
  SynthesisResult made;
  int parts = 0;  ///< that are in the result
};

/// Where an example is made of loose parts (stones that lie about, three or more of them, each
/// smaller than half of all, with at least two samples of air around it, none in another as rings
/// of a chain are), a result of such parts, each whole and each as often as the others: its places
/// are the example's, laid side by side, moved about by up to a quarter of their distance, with
/// parts drawn anew for them. Along z parts stay on the ground of their places. No two touch.
/// Nothing for other examples.
///
/// There is as much solid as in the example, for the size of its box, as nearly as whole parts
/// allow, unless they find no room. O(samples of the result, and parts x their volume). Each sample
/// is the example's, to the bit. The same bytes at any number of threads. Throws `Cancelled`.
std::optional<StrewnParts> strewParts(const DistanceField& example, const StrewOptions& options,
                                      const Progress& progress = {});

}  // namespace exemplar
