// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "synth/layered/shape_optimization.h"

namespace exemplar::bench {

/// The paper's matching of boundaries as it is written (Rosenberger, Cohen-Or, Lischinski 2009,
/// section 3.2): every use of an example's patch goes to its nearest patch of the shape, found by
/// looking at all of them in every orientation; of several at one the nearest stays; the others
/// look again among those that are left. The paper looks approximately, by hashing. On all cores.
std::vector<BoundaryMatch> matchPlainly(const BoundaryPatches& set, const BoundaryPatches& examples,
                                        const std::vector<std::uint32_t>& uses);

/// One shape optimized plainly on one resolution: that matching, and the threshold of certainty by
/// area.
Shape optimizePlainly(Shape start, const ShapeExample& example, int iterations,
                      const Random& random);

}  // namespace exemplar::bench
