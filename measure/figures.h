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

namespace exemplar {

/// One figure by name: what a table prints and JSON holds. `monostate` (null) is a figure that was
/// not measured or has no meaning for this input.
struct Figure {
  std::string group;  ///< "likeness", "wholeness", "novelty", "frontier", "seams", "mesh",
                      ///< "collapse", "doubts", "content", "layers": an object in JSON
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

/// The figures as lines of text for a terminal, a heading for each group; "-" for what is null.
std::string figuresTable(const std::vector<Figure>& figures);

}  // namespace exemplar
