// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/label_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "mesh/color.h"

namespace exemplar {

void validate(const LabelGrid& grid, const std::string& name) {
  const auto fail = [&](const std::string& what) { throw InputError(name + ": " + what); };
  if (grid.cells.empty()) fail("the grid has no cells");
  if (grid.labelCount() > kMostLabels) {
    fail("the grid has " + std::to_string(grid.labelCount()) + " labels; there can be " +
         std::to_string(kMostLabels));
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!(grid.cellSize[axis] > 0) || !std::isfinite(grid.cellSize[axis])) {
      fail("the size of a cell must be positive");
    }
  }
  if (!isFinite(grid.origin)) fail("the grid's place is NaN or infinite");
  for (const LabelLook& look : grid.labels) {
    for (const float c : look.color) {
      if (!(c >= 0 && c <= 1)) fail("a label's color is not 0 to 1");
    }
  }
  for (std::size_t n = 0; n < grid.cells.count(); ++n) {
    const Label label = grid.cells.values()[n];
    if (label < grid.labels.size()) continue;
    const Vec3i at = grid.cells.ijk(n);
    fail("cell (" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " +
         std::to_string(at.z) + ") has label " + std::to_string(label) + " of " +
         std::to_string(grid.labels.size()));
  }
}

LabelLook emptyLook() {
  LabelLook look;
  look.name = "empty";
  look.color = {1, 1, 1, 0};
  return look;
}

std::array<float, 4> distinctColor(int label) {
  // Hues a golden angle apart never come close to one another soon; lightness takes turns.
  const double hue = std::fmod(0.11 + 0.6180339887498949 * label, 1.0);
  const double lightness = 0.42 + 0.13 * (label % 3), saturation = 0.38 + 0.12 * (label / 3 % 3);
  const double chroma = saturation * (1 - std::abs(2 * lightness - 1));
  std::array<float, 4> color{0, 0, 0, 1};
  for (int c = 0; c < 3; ++c) {
    const double k = std::fmod(12 * (hue + (3 - c) / 3.0), 12.0);
    const double srgb = lightness - chroma * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}));
    color[c] = static_cast<float>(srgbToLinear(std::clamp(srgb, 0.0, 1.0)));
  }
  return color;
}

}  // namespace exemplar
