// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/layer_map.h"

#include <algorithm>
#include <cstdlib>

namespace exemplar {

int layerCount(const LayerMap& map) { return *std::ranges::max_element(map.values()); }

Shape layerShape(const LayerMap& map, int layer) {
  Shape shape(map.width(), map.height());
  for (std::size_t p = 0; p < map.count(); ++p) shape[p] = map[p] >= layer;
  return shape;
}

double skippingShare(const LayerMap& map) {
  std::int64_t steps = 0, skipping = 0;
  const auto step = [&](int a, int b) {
    steps += a != b;
    skipping += std::abs(a - b) > 1;
  };
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (x > 0) step(map(x, y), map(x - 1, y));
      if (y > 0) step(map(x, y), map(x, y - 1));
    }
  }
  return steps > 0 ? static_cast<double>(skipping) / static_cast<double>(steps) : 0;
}

double orientation(const LayerMap& map) {
  double alongX = 1, alongY = 1;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      alongX += x > 0 && map(x, y) != map(x - 1, y);
      alongY += y > 0 && map(x, y) != map(x, y - 1);
    }
  }
  return std::max(alongX, alongY) / std::min(alongX, alongY);
}

}  // namespace exemplar
