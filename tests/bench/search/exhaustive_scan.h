// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "search/block_match.h"

namespace exemplar::bench {

/// The linear search that Lagae 2004, table 1, compares with: equation 1 as written, every sample
/// of every block, one after another.
///
/// Looks at every `stride`-th slice of positions only (the cost of a slice is that of any other).
BlockMatch exhaustiveScan(const Array3D<std::uint8_t>& source,
                          const BlockQuery<std::uint8_t>& query, int stride);

}  // namespace exemplar::bench
