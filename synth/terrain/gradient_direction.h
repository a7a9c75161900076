// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "maps/grid.h"

/// Whether a terrain's ridges and valleys run in a direction, and how it may be turned.
namespace exemplar {

/// The orientations (`turnedStep`) that keep the direction of heights: those that change the mean
/// of products of their gradients little. At least 0 and 2 (half a turn).
std::vector<int> turnsOf(std::span<const Grid<float>> examples);

/// By which angle they may be turned for the same reason, radians: up to pi / 4, which means any.
double greatestTurn(std::span<const Grid<float>> examples);

}  // namespace exemplar
