// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as height maps.

#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "maps/height_map_file.h"

namespace exemplar {

void readAsHeights(Example& example, const Progress& progress) {
  if (example.kind != SourceKind::HeightMap) {
    throw InputError(example.name() + ": the engine terrain takes height maps (" +
                     kHeightMapEndings + "); try the engine geometry");
  }
  HeightMap map = readHeights(example.source,
                              {.cellSize = example.reading.cellSize,
                               .heightScale = example.reading.heightScale,
                               .warnings = &example.warnings},
                              progress);
  example.heightSteps = map.steps;
  example.description = "height map of " + withThousands(map.width()) + " x " +
                        withThousands(map.height()) + " points, cells of " +
                        numberText(map.cellSize);
  const std::optional<HeightRange> range = rangeOf(map.heights);
  if (range && range->holes > 0) {
    example.warnings.push_back(
        example.name() + ": nothing is made of its " + counted(range->holes, "point") +
        " without data; `fill` makes land of them, `keep-holes` more of them");
  }
  example.data = std::move(map);
}

void requireAlike(const Example& example, const Example& first) {
  const HeightMap &map = example.heights(), &other = first.heights();
  if (!map.cellSizeKnown || !other.cellSizeKnown) return;
  if (std::abs(map.cellSize / other.cellSize - 1) < 1e-3) return;
  throw InputError(example.name() + ": cells of " + numberText(map.cellSize) + ", and " +
                   first.name() + " has cells of " + numberText(other.cellSize) +
                   "; height maps that are used together have cells of one size");
}

}  // namespace exemplar
