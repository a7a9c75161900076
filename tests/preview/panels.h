// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

#include "preview/render.h"

namespace exemplar {

/// A panel of a row of pictures: where it is, and the rectangle of what it shows there.
struct Panel {
  Crop at, shown;

  /// The share of the panel that its content's rectangle takes up.
  double filled() const {
    return static_cast<double>(shown.width) * shown.height / (at.width * at.height);
  }
};

/// The least rectangle of `within` that holds all pixels that are not `ground`, to `most` steps.
inline Crop rectangleOfInk(const Image8& image, const Crop& within, const std::uint8_t* ground,
                           int most) {
  int left = std::numeric_limits<int>::max(), top = left, right = -1, bottom = -1;
  for (int y = within.top; y < within.top + within.height; ++y) {
    for (int x = within.left; x < within.left + within.width; ++x) {
      const std::uint8_t* pixel = image.at(x, y);
      int away = 0;
      for (int c = 0; c < 3; ++c) away = std::max(away, std::abs(pixel[c] - ground[c]));
      if (away <= most) continue;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  return right < 0 ? Crop{} : Crop{left, top, right - left + 1, bottom - top + 1};
}

/// The panels of a row that `renderSideBySide` has drawn, from left to right: between and above
/// them is `kPage`. What a panel shows is what differs from `kBackground` by more than 25 steps,
/// which the ground's shade and soft shadows do not.
inline std::vector<Panel> panelsOf(const Image8& row) {
  std::vector<Panel> panels;
  for (int x = 0, left = 0; x <= row.width; ++x) {
    const Crop column{x, 0, 1, row.height};
    if (x < row.width && rectangleOfInk(row, column, kPage.data(), 4).width > 0) continue;
    if (x > left) {
      Panel panel;
      panel.at = rectangleOfInk(row, {left, 0, x - left, row.height}, kPage.data(), 4);
      panel.shown = rectangleOfInk(row, panel.at, kBackground.data(), 25);
      panels.push_back(panel);
    }
    left = x + 1;
  }
  return panels;
}

}  // namespace exemplar
