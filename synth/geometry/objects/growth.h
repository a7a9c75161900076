// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

struct GrowthOptions {
  /// Along each axis, where in the example each sample of the result is, samples: an example that
  /// is stretched where that advances by less than one.
  std::array<std::vector<double>, 3> places;
  std::uint64_t seed = 0;
  double truncation = 4;  ///< distances count up to here, voxels; > 0
};

/// One larger object of the parts of an example that stands alone. The example, stretched as
/// `places` say, is where synthesis by voting starts from and what it is guided by, on a level on
/// which it is seen as a whole; patches of the example are as large as ever. So what is long and
/// alike becomes longer, and where a part has been made too large there are several (Simakov,
/// Caspi, Shechtman, Irani: "Summarizing visual data using bidirectional similarity", CVPR 2008,
/// doi:10.1109/CVPR.2008.4587842, section 3, there for pictures that become smaller).
///
/// About the cost of `synthesizeByVoting`. The same bytes at any number of threads. Throws
/// `Cancelled`.
SynthesisResult growObject(const DistanceField& example, const GrowthOptions& options,
                           const Progress& progress = {});

}  // namespace exemplar
