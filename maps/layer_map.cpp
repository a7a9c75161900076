// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/layer_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>

#include "core/error.h"
#include "maps/map.h"

namespace exemplar {
namespace {

int grayOf(int layer, int layers) { return layers < 2 ? 0 : 255 * (layer - 1) / (layers - 1); }

}  // namespace

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

LayerMap readLayerMap(const std::filesystem::path& path, int layers) {
  const MapLayer picture = readMapLayer(path, "layers");
  Grid<int> grays(picture.planes[0].width(), picture.planes[0].height());
  std::set<int> different;
  for (std::size_t p = 0; p < grays.count(); ++p) {
    for (const Grid<float>& plane : picture.planes) {
      if (plane[p] != picture.planes[0][p])
        throw InputError(path.string() + ": a layer map is gray, and this picture has colors");
    }
    different.insert(grays[p] = static_cast<int>(std::lround(255 * picture.planes[0][p])));
  }
  std::vector<int> known(different.begin(), different.end());
  if (layers > 0) {
    known.clear();
    for (int i = 1; i <= layers; ++i) known.push_back(grayOf(i, layers));
  }
  if (known.size() > static_cast<std::size_t>(kMostLayers)) {
    throw InputError(path.string() + ": " + std::to_string(known.size()) +
                     " different grays; a layer map has at most " + std::to_string(kMostLayers));
  }
  LayerMap map(grays.width(), grays.height());
  for (std::size_t p = 0; p < grays.count(); ++p) {
    const auto found = std::ranges::find(known, grays[p]);
    if (found == known.end()) {
      std::string list;
      for (const int gray : known) list += (list.empty() ? "" : ", ") + std::to_string(gray);
      throw InputError(path.string() + ": no layer has the gray " + std::to_string(grays[p]) +
                       "; they are " + list);
    }
    map[p] = static_cast<std::uint8_t>(found - known.begin() + 1);
  }
  return map;
}

void writeLayerMap(const std::filesystem::path& path, const LayerMap& map, int layers) {
  MapLayer picture{"layers", {Grid<float>(map.width(), map.height())}, 8};
  for (std::size_t p = 0; p < map.count(); ++p)
    picture.planes[0][p] = static_cast<float>(grayOf(map[p], layers)) / 255;
  writeMapLayer(path, picture);
}

}  // namespace exemplar
