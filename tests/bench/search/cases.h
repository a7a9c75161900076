// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "search/block_match.h"

namespace exemplar::bench {

using Levels = Array3D<std::uint8_t>;
using Query = BlockQuery<std::uint8_t>;

/// A source, and queries from another field of the same process: what matching is measured on.
struct MatchCase {
  std::string scene;  ///< balls, terrain, chainmail or noise
  int n = 0;          ///< side of the source, samples
  int block = 0;      ///< side of a block
  Levels source, target;

  /// Query `number`: a block at random with one octant, at random, unknown; or known in full. The
  /// surface passes through it: where nothing is, synthesis has nothing to match.
  Query query(int number) const;
  Query wholeQuery(int number) const;
};

/// Made on first use; the last one used is kept. Features scale with n: the same matter at a finer
/// resolution. The radius of balls is n / 10.
const MatchCase& matchCase(const std::string& scene, int n);

}  // namespace exemplar::bench
