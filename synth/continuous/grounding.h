// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>

#include "synth/continuous/search.h"

/// Solids that hang in the air.
namespace exemplar::continuous {

/// Whether anything of an example with a ground hangs in the air: is not joined to the ground by
/// what is not air. `figures` are those of the vertices of an arrangement that the example fills.
bool anyFloats(const Puzzle& puzzle, std::span<const std::uint32_t> figures, Substance ground);

/// Turns into air what hangs in the air in a solved puzzle, and returns how many pieces that were.
/// What is left agrees with itself: no vertex of such a piece has anything else around it. Pieces
/// at which `allowed` excludes air stay.
std::int64_t removeFloating(const Puzzle& puzzle, const Domains& allowed,
                            std::span<const std::uint32_t> vertices, Substance ground,
                            Domains& labels);

/// Turns all but the largest connected pieces of what is built (neither air nor the ground's) into
/// background in a solved puzzle, and returns how many pieces are left; a piece that cannot be
/// (pins, or a relief around it) stays. Pieces hang together by edges.
std::int64_t keepLargest(const Puzzle& puzzle, const Domains& allowed,
                         std::span<const std::uint32_t> vertices, const Growth& growth, int most,
                         Domains& labels);

}  // namespace exemplar::continuous
