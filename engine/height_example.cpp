// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as height maps.

#include <cmath>

#include "core/error.h"
#include "engine/example_forms.h"
#include "engine/words.h"

namespace exemplar {

void readAsHeights(Example& example, const Progress& progress) {
  if (example.kind != SourceKind::HeightMap) {
    throw InputError(example.name() +
                     ": the engine terrain takes height maps (.png .pgm .asc); try the engine "
                     "geometry");
  }
  HeightMap map = readHeights(example.source,
                              {.cellSize = example.reading.cellSize,
                               .heightScale = example.reading.heightScale,
                               .warnings = &example.warnings},
                              progress);
  example.heightSteps = map.steps;
  example.description = "height map of " + withThousands(map.width) + " x " +
                        withThousands(map.height) + " points, cells of " + numberText(map.cellSize);
  example.data = std::move(map);
}

void requireAlike(const Example& example, const Example& first) {
  const double cell = example.heights().cellSize, other = first.heights().cellSize;
  if (std::abs(cell / other - 1) < 1e-3) return;
  throw InputError(example.name() + ": cells of " + numberText(cell) + ", and " + first.name() +
                   " has cells of " + numberText(other) +
                   "; height maps that are used together have cells of one size");
}

}  // namespace exemplar
