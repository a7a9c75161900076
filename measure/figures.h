// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "measure/content.h"
#include "measure/layers.h"
#include "measure/measure.h"
#include "measure/terrain.h"

namespace exemplar {

/// One figure by name: what a table prints and JSON holds. `monostate` (null) is a figure that was
/// not measured or has no meaning for this input.
struct Figure {
  std::string group;  ///< "likeness", "wholeness", "novelty", "frontier", "seams", "mesh",
                      ///< "collapse", "doubts", "content", "layers", "terrain": an object in JSON
  std::string key;    ///< lower case, unique within its group: "lp_dense"
  std::variant<std::monostate, bool, std::int64_t, double, std::string> value;
  std::string meaning;  ///< a few words for a table: what it is, and what is good
};

/// All figures in the order in which they are read, groups together.
std::vector<Figure> figures(const Measures& measures);
/// Those of labels.
std::vector<Figure> figures(const Content& content);
/// Those of layer maps.
std::vector<Figure> figures(const LayersLikeness& layers);
/// Those of terrain: of the result by their keys, of the example with `_example`, of its halves
/// with
/// `_half1` and `_half2` behind them; a distance's floor with `_floor`.
std::vector<Figure> figures(const TerrainLikeness& terrain);

/// The figures as lines of text for a terminal, a heading for each group; "-" for what is null.
std::string figuresTable(const std::vector<Figure>& figures);
/// The figures of terrain with the example, its halves, and the result side by side.
std::string figuresTable(const TerrainLikeness& terrain);

}  // namespace exemplar
