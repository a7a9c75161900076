// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "maps/grid.h"

namespace exemplar {

/// Gives every row of `costs` a column, each of which serves exactly `capacities` times, at the
/// least sum of costs: the auction algorithm for transportation problems (Bertsekas, Castanon 1989,
/// "The auction algorithm for the transportation problem", section 2). Rows bid for columns in
/// turn, each so much that its second choice would be as good; a full column drops its lowest
/// bidder. Bids are raised by at least an ε, which shrinks from a quarter of the largest cost to
/// less than 1 / rows: then, as costs are integers, the sum is the least.
///
/// The sum of `capacities` is the number of rows. O(rows x columns x log(rows x largest cost)) in
/// practice; in the worst case rows x columns x largest cost / ε. Memory: that of `costs`, and
/// O(rows + columns). One thread, so that the result is the same at any number. Returns nothing
/// where prices grow beyond 32 bits, which costs of boundary patches have never made them do.
/// Throws `Cancelled`.
std::optional<std::vector<std::uint32_t>> assignByAuction(const Grid<std::uint16_t>& costs,
                                                          std::span<const std::uint32_t> capacities,
                                                          const Progress& progress = {});

}  // namespace exemplar
