// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/described.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

#include "engine/words.h"
#include "synth/geometry/stationary.h"

namespace exemplar {
namespace {

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, share > 0 && share < 0.0995 ? "%.1f" : "%.0f", 100 * share);
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// Why parts may, or may not, move along an axis.
std::string reason(const ExampleNature& nature, int axis, bool stationary) {
  std::vector<std::string> shares;
  for (const double share : nature.quarters[static_cast<std::size_t>(axis)])
    shares.push_back(percent(share));
  const std::string quarters = "its quarters are " + joined(shares, "and") + " % solid";
  const auto side = [&](int end) { return nature.sides[static_cast<std::size_t>(2 * axis + end)]; };
  std::string ends;
  if (side(0) == BoxSide::Air && side(1) == BoxSide::Air) {
    ends = "it ends in air at both sides";
  } else if (side(0) == BoxSide::Cut && side(1) == BoxSide::Cut) {
    ends = "the box cuts it at both sides";
  } else if (side(0) == BoxSide::Solid && side(1) == BoxSide::Air) {
    ends = "there is solid at one side and air at the other";
  } else {
    ends = "its two sides differ";
  }
  return (stationary ? "parts may move: " : "parts keep their place: ") + quarters + ", and " +
         ends;
}

Occupancy solidOf(const Example& example) {
  if (example.form() == Form::Field) return Occupancy(example.field());
  const LabelGrid& grid = example.labels();
  Array3D<std::uint8_t> cells(grid.size());
  for (std::size_t c = 0; c < cells.count(); ++c)
    cells.data()[c] = isEmpty(grid.labels[grid.cells.data()[c]]) ? 0 : 1;
  return Occupancy(cells);
}

}  // namespace

DescribedExample describe(const Example& example) {
  DescribedExample described;
  described.nature = natureOf(solidOf(example));
  if (example.form() != Form::Field) {
    described.cell = example.labels().cellSize.x;
    return described;
  }
  described.cell = example.field().voxelSize;
  described.stationary = findStationaryAxes(example.field());
  for (int axis = 0; axis < 3; ++axis)
    described.why[static_cast<std::size_t>(axis)] =
        reason(described.nature, axis, described.stationary[axis]);
  return described;
}

std::vector<std::pair<std::string, std::string>> readable(const DescribedExample& described,
                                                          Form form) {
  const ExampleNature& nature = described.nature;
  const Vec3d size = cast<double>(nature.size) * described.cell;
  std::vector<std::pair<std::string, std::string>> lines;
  const char* const unit = form == Form::Field ? "samples" : "cells";
  std::string box = readableSize(nature.size, unit) + " of " + number(described.cell) + ": " +
                    number(size.x) + " x " + number(size.y) + " x " + number(size.z);
  lines.emplace_back(unit, box);
  std::string solid = percent(nature.solidShare) + " % of the box";
  if (!nature.solid.empty()) {
    std::vector<std::string> spans;
    for (int axis = 0; axis < 3; ++axis)
      spans.push_back(std::string(1, "xyz"[axis]) + " " + std::to_string(nature.solid.begin[axis]) +
                      " to " + std::to_string(nature.solid.end[axis] - 1));
    solid += ", within " + joined(spans, "and");
  }
  if (nature.freeStanding()) solid += "; it stands free";
  lines.emplace_back("solid", solid);
  const char* names[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
  const std::pair<BoxSide, const char*> kinds[] = {
      {BoxSide::Air, "air at "}, {BoxSide::Cut, "cut at "}, {BoxSide::Solid, "solid at "}};
  std::string sides;
  for (const auto& [kind, word] : kinds) {
    std::vector<std::string> here;
    for (std::size_t side = 0; side < 6; ++side) {
      if (nature.sides[side] != kind) continue;
      std::string name = names[side];
      if (kind == BoxSide::Cut) name += " (" + percent(nature.atSides[side]) + " % solid)";
      here.push_back(std::move(name));
    }
    if (here.empty()) continue;
    sides += (sides.empty() ? "" : "; ") + (word + joined(here, "and"));
  }
  lines.emplace_back("sides", sides);
  if (form != Form::Field) return lines;
  lines.emplace_back("stationary",
                     readableAxes(described.stationary) + ", found; `stationary` names others");
  for (std::size_t axis = 0; axis < 3; ++axis)
    lines.emplace_back(std::string("along ") + "xyz"[axis], described.why[axis]);
  return lines;
}

}  // namespace exemplar
