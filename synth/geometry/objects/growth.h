// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "synth/geometry/objects/stretched_object.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

struct GrowthOptions {
  AxisPlaces places;  ///< how it is stretched
  std::uint64_t seed = 0;
  double truncation = 4;  ///< distances count up to here, voxels; > 0
};

/// One larger object made of an example that stands alone, with as much solid as that has for the
/// size of its box, within a tenth where it can be.
///
/// What is made of planes is stretched as space is (`stretchSpace`), what is made of limbs or thin
/// walls along its medial axis (`stretchSkeleton`, where all `places` are in order): that is the
/// result. A lump is then made anew of patches of the example, as large as ever, by voting that
/// starts from the stretched object and is guided by it, on a level on which it is seen as a whole;
/// where a part has been made too large there are several (Simakov, Caspi, Shechtman, Irani:
/// "Summarizing visual data using bidirectional similarity", CVPR 2008,
/// doi:10.1109/CVPR.2008.4587842, section 3, there for pictures that become smaller).
///
/// Each sample has the sign of the example at its origin. The cost of `stretchSkeleton`, or of
/// `synthesizeByVoting` up to three times on each of two levels. The same bytes at any number of
/// threads. Throws `Cancelled`.
SynthesisResult growObject(const DistanceField& example, const GrowthOptions& options,
                           const Progress& progress = {});

}  // namespace exemplar
