// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/collapse.h"

#include <cmath>
#include <cstdio>

namespace exemplar {
namespace {

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
  return text;
}

}  // namespace

Collapse detectCollapse(const CollapseSigns& signs, const CollapseOptions& options) {
  const auto gone = [&](double result, double example) {
    return example > 0 && result < options.vanished * example;
  };
  if (gone(signs.resultOccupancy, signs.exampleOccupancy)) return Collapse::AllEmpty;
  if (gone(1 - signs.resultOccupancy, 1 - signs.exampleOccupancy)) return Collapse::AllSolid;
  if (gone(signs.resultSurface, signs.exampleSurface))
    return signs.resultOccupancy < signs.exampleOccupancy ? Collapse::AllEmpty : Collapse::AllSolid;
  if (signs.usedShare) {
    const bool covered = signs.coverage && *signs.coverage >= 0.5;
    if (*signs.usedShare < options.repeated && !covered) return Collapse::Repeated;
  } else if (signs.likeness && signs.coverage && *signs.likeness >= 0.75 &&
             *signs.coverage < 0.25) {
    return Collapse::Repeated;
  }
  return Collapse::None;
}

std::string collapseName(Collapse collapse) {
  switch (collapse) {
    case Collapse::AllEmpty:
      return "all_empty";
    case Collapse::AllSolid:
      return "all_solid";
    case Collapse::Repeated:
      return "repeated";
    case Collapse::None:
      break;
  }
  return "none";
}

std::string collapseSentence(Collapse collapse, const CollapseSigns& signs) {
  const std::string amounts = percent(signs.resultOccupancy) + " of it is solid, " +
                              percent(signs.exampleOccupancy) + " of the example";
  switch (collapse) {
    case Collapse::AllEmpty:
      return "the result is nearly empty: " + amounts;
    case Collapse::AllSolid:
      return "the result is nearly solid: " + amounts;
    case Collapse::Repeated:
      if (signs.usedShare)
        return "the result repeats one part of the example: it uses " + percent(*signs.usedShare) +
               " of its surface";
      return "the result repeats one part of the example: it shows " +
             percent(signs.coverage.value_or(0)) + " of it";
    case Collapse::None:
      break;
  }
  return "";
}

}  // namespace exemplar
