// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/array3d.h"
#include "search/block_match.h"

/// What the papers define, written down for the tests to compare with.
namespace exemplar {

/// Equation 1 for one block of the source: the yardstick. Every search returns exactly this number
/// for the block that it returns. Integers are summed exactly; squared differences of floats are
/// summed in double in an order that depends on the query's size and mask alone.
template <class Sample>
double blockDistance(const Array3D<Sample>& source, const Vec3i& position,
                     const BlockQuery<Sample>& query);

/// One block's pyramid: element l - 1 is level l, of 2^(l-1) cells a side; the last is the block.
/// Its side must be a power of two.
std::vector<Array3D<double>> blockPyramid(const Array3D<double>& block);

/// Equation 1 between two levels of the same size.
double levelDistance(const Array3D<double>& a, const Array3D<double>& b);

}  // namespace exemplar
