// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <span>
#include <vector>

#include "core/progress.h"
#include "core/warnings.h"
#include "engine/example.h"
#include "engine/source.h"
#include "maps/height_map.h"

namespace exemplar {

/// Height maps that belong together, the example first: in one unit, and with cells of a size that
/// some may know and others not. `cell-size` and `height-scale` of `reading` are those of the
/// first; the scale is also that of further files of integers beside which nothing says what they
/// stand for. Those whose cells have a size that nobody said get that of the first that knows one.
/// Throws `InputError` and `Cancelled`.
std::vector<HeightMap> readHeightsAlike(std::span<const Source> sources, const ReadOptions& reading,
                                        Warnings& warnings, const Progress& progress = {});

}  // namespace exemplar
