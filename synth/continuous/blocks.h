// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "core/progress.h"
#include "core/random.h"
#include "synth/continuous/search.h"

namespace exemplar::continuous {

struct BlockOptions {
  Vec3l spacing;               ///< of planes along the axes, units
  int side = 20;               ///< of a block, spacings, >= 2; rounded up to an even number
  int rounds = 2;              ///< of all blocks
  std::int64_t budget = 1000;  ///< failed choices in a block
  const Guide* guide = nullptr;
  bool backtracking = true;  ///< off: the papers' own algorithm
};

struct BlockCounts {
  std::int64_t blocks = 0, kept = 0, choices = 0, failures = 0;
};

/// Makes a result anew block by block (Merrell and Manocha 2008, section 3.3; thesis,
/// section 4.5.6): blocks overlap by half, all that is strictly within one is free and all else
/// stays, and a block that fails keeps what it had. `labels` has one label in each inner vertex,
/// consistent, and so it ends. Blocks that no edge joins run in parallel; which they are does not
/// depend on threads. Throws `Cancelled`.
BlockCounts modifyInBlocks(const Puzzle& puzzle, std::span<const double> weights, Domains& labels,
                           const Random& random, const BlockOptions& options,
                           const Progress& progress = {});

}  // namespace exemplar::continuous
