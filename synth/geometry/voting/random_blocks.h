// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>

#include "core/axes.h"
#include "synth/geometry/pyramid/pyramid.h"

namespace exemplar {

/// How many levels a start from random blocks takes: the coarsest has about 16 samples along the
/// longest side, so that patches there see whatever is large.
int randomBlockLevels(const DistanceField& example);

/// Parts of a source that follow each other.
struct PartRange {
  std::uint32_t first = 0, count = 1;
};

/// The coarsest level's start: blocks of a patch's size and random content, of a random one of the
/// parts that `partsAt` has for each sample of the target, kept to their proportional place along
/// axes that are not stationary. Deterministic.
PyramidSources randomBlocks(const PyramidLevel& level, const Axes& stationary, std::uint64_t seed,
                            const std::function<PartRange(const Vec3i&)>& partsAt);

}  // namespace exemplar
