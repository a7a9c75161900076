// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "search/block_match.h"

namespace exemplar {

/// The nearest block, ties by lowest index, by looking at every one: `BlockSearch::Scan`, and what
/// the index is compared with.
///
/// Vectorized along x, and a block is left as soon as its sum exceeds the best one so far; rows are
/// visited in an order that spreads over the block, so that this happens early. O(blocks × samples)
/// at worst, single-threaded. Throws `InputError` when the block does not fit into the source.
template <class Sample>
BlockMatch linearScan(const Array3D<Sample>& source, const BlockQuery<Sample>& query);

}  // namespace exemplar
