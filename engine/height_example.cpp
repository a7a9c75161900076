// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as height maps.

#include <cmath>
#include <cstdio>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/text.h"
#include "engine/example_forms.h"
#include "engine/words.h"
#include "maps/height_map_file.h"
#include "maps/height_tiles.h"

namespace exemplar {
namespace {

std::string describe(const HeightMap& map) {
  return "height map of " + withThousands(map.width()) + " x " + withThousands(map.height()) +
         " points, cells of " + numberText(map.cellSize);
}

/// To three digits.
std::string roughly(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// That two maps lie side by side and are no tiles of one.
std::string misfit(const Example& tile, const Example& beside, const TilePlace& place) {
  const std::string apart = "; each is used as an example of its own";
  if (place.fit == TileFit::OffGrid) {
    return tile.name() + ": lies " + roughly(place.east) + " cells east and " +
           roughly(place.north) + " north of " + beside.name() +
           ", not whole numbers of cells, so that the two do not line up" + apart +
           "; resample one to the other's cells to join them";
  }
  return tile.name() + ": its heights differ by " + roughly(place.across) + " from those of " +
         beside.name() + " along the edge that they share, where neighbors differ by " +
         roughly(place.usual) + apart + "; look whether both have one unit and one zero";
}

}  // namespace

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
  example.description = describe(map);
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

void joinTiles(std::vector<Example>& examples) {
  DisjointSets groups(examples.size());
  for (std::size_t b = 1; b < examples.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const TilePlace place = placeOf(examples[b].heights(), examples[a].heights());
      if (place.fit == TileFit::Fits)
        groups.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
      if (place.fit == TileFit::OffGrid || place.fit == TileFit::Disagrees)
        examples[b].warnings.push_back(misfit(examples[b], examples[a], place));
    }
  }
  const std::vector<std::uint32_t> group = groups.numbered();
  std::vector<Example> joined;
  for (std::size_t n = 0; n < examples.size(); ++n) {
    std::vector<HeightMap> tiles;
    Example& first = examples[n];
    Warnings warnings;
    for (std::size_t m = 0; m < examples.size(); ++m) {
      if (group[m] != group[n]) continue;
      if (m < n) break;  // it is a part of an earlier one
      tiles.push_back(examples[m].heights());
      warnings.insert(warnings.end(), examples[m].warnings.begin(), examples[m].warnings.end());
    }
    if (tiles.empty()) continue;
    if (tiles.size() > 1) {
      HeightMap map = joinedTiles(tiles);
      first.description =
          std::to_string(tiles.size()) + " tiles side by side, joined: " + describe(map);
      first.data = std::move(map);
      first.warnings = std::move(warnings);
    }
    joined.push_back(std::move(first));
  }
  examples = std::move(joined);
}

}  // namespace exemplar
