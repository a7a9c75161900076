// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "search/block_match.h"

namespace exemplar {

/// The nearest block, by looking at every one: the oracle and the honest baseline.
///
/// Vectorised along x, and a block is left as soon as its sum exceeds the best one so far; rows are
/// visited in an order that spreads over the block, so that this happens early. O(blocks × samples)
/// at worst, single-threaded. Throws `InputError` when the block does not fit into the source.
template <class Sample>
BlockMatch linearScan(const Array3D<Sample>& source, const BlockQuery<Sample>& query);

/// The `count` nearest blocks (fewer where there are fewer positions), nearest first, ties by
/// lowest index.
template <class Sample>
std::vector<BlockMatch> linearScanNearest(const Array3D<Sample>& source,
                                          const BlockQuery<Sample>& query, int count);

/// All blocks whose distance is at most (1 + `tolerance`) times the smallest one, nearest first,
/// ties by lowest index; of more than `limit` of them the first `limit`. `tolerance` >= 0.
template <class Sample>
std::vector<BlockMatch> linearScanWithin(const Array3D<Sample>& source,
                                         const BlockQuery<Sample>& query, double tolerance,
                                         int limit);

}  // namespace exemplar
