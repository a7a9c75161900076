// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "maps/grid.h"

/// Heights from their gradients (Pérez, Gangnet, Blake: "Poisson image editing", SIGGRAPH 2003,
/// doi:10.1145/882262.882269; for terrain Gain, Merry, Marais 2015, section 5).
namespace exemplar {

/// The steps that heights should take, in their unit: `right(x, y)` from (x, y) to (x + 1, y), and
/// `down(x, y)` to (x, y + 1). The last column and row count only on a torus.
struct HeightSteps2D {
  Grid<float> right, down;
};

struct GradientDomainOptions {
  /// How much a sample's height counts beside its steps, in 1 / samples²: heights are free to
  /// follow the steps over about 1 / sqrt(screen) samples; > 0.
  double screen = 1.0 / 1024;
  int cycles = 4;  ///< of multigrid; each takes the error to about a tenth; >= 1
  bool wrapsX = false, wrapsY = false;
};

/// Changes `heights` so that their steps come as near to `steps` as they can while they stay near
/// what they were: least squares, of the screened Poisson equation. Where `hold` (one value for
/// each sample, 0..1; may be empty) is above 0 heights are held more strongly, at 1 to the bit.
/// Multigrid with red-black relaxation, O(samples), the same bytes at any number of threads. Throws
/// `Cancelled`.
void followSteps(Grid<float>& heights, const HeightSteps2D& steps, const Grid<float>& hold,
                 const GradientDomainOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
