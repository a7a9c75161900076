// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/layer_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>
#include <string>

#include "core/cells.h"
#include "core/error.h"
#include "maps/map.h"

namespace exemplar {
namespace {

int grayOf(int layer, int layers) { return layers < 2 ? 0 : 255 * (layer - 1) / (layers - 1); }

/// Calls `step(axis, value, before)` for each cell and the one before it along each axis.
template <class Step>
void forEachStep(const LayerVolume& layers, Step&& step) {
  const Vec3i& size = layers.size();
  const std::uint8_t* values = layers.data();
  const std::size_t strides[] = {1, static_cast<std::size_t>(size.x),
                                 static_cast<std::size_t>(size.x) * size.y};
  std::size_t at = 0;
  forEachCell(size, [&](const Vec3i& p) {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] > 0) step(axis, int{values[at]}, int{values[at - strides[axis]]});
    ++at;
  });
}

}  // namespace

int layerCount(const LayerVolume& layers) { return *std::ranges::max_element(layers.values()); }
int layerCount(const LayerMap& map) { return *std::ranges::max_element(map.values()); }

Shape layerShape(const LayerVolume& layers, int layer) {
  Shape shape(layers.size());
  for (std::size_t p = 0; p < layers.count(); ++p) shape.data()[p] = layers.data()[p] >= layer;
  return shape;
}

double skippingShare(const LayerVolume& layers) {
  std::int64_t steps = 0, skipping = 0;
  forEachStep(layers, [&](int, int a, int b) {
    steps += a != b;
    skipping += std::abs(a - b) > 1;
  });
  return steps > 0 ? static_cast<double>(skipping) / static_cast<double>(steps) : 0;
}

double orientation(const LayerVolume& layers) {
  double along[] = {1, 1, 1};
  forEachStep(layers, [&](int axis, int a, int b) { along[axis] += a != b; });
  return std::max(along[0], along[1]) / std::min(along[0], along[1]);
}

std::vector<double> layerShares(const LayerVolume& layers, int count) {
  std::vector<double> shares(static_cast<std::size_t>(count));
  for (const std::uint8_t k : layers.values())
    shares[k - 1u] += 1.0 / static_cast<double>(layers.count());
  return shares;
}

std::vector<int> orderOfLayers(const LayerVolume& labels, int count, int bottom) {
  Grid<double> steps(count + 1, count + 1);
  forEachStep(labels, [&](int, int a, int b) { ++steps(a, b); });
  std::vector<int> order(static_cast<std::size_t>(count)), best;
  std::iota(order.begin(), order.end(), 1);
  double most = -1;
  do {
    if (bottom > 0 && order.front() != bottom) continue;
    double kept = 0;
    for (std::size_t n = 1; n < order.size(); ++n)
      kept += steps(order[n], order[n - 1]) + steps(order[n - 1], order[n]);
    if (kept > most) {
      most = kept;
      best = order;
    }
  } while (std::ranges::next_permutation(order).found);
  const std::vector<double> shares = layerShares(labels, count);
  const auto shareOf = [&](int label) { return shares[static_cast<std::size_t>(label - 1)]; };
  if (bottom == 0 && shareOf(best.back()) > shareOf(best.front())) std::ranges::reverse(best);
  return best;
}

void renumber(LayerVolume& labels, const std::vector<int>& order) {
  std::array<std::uint8_t, kMostLayers + 1> number{};
  for (std::size_t n = 0; n < order.size(); ++n)
    number[static_cast<std::size_t>(order[n])] = static_cast<std::uint8_t>(n + 1);
  for (std::uint8_t& k : labels.values()) k = number[k];
}

LayerMap readLayerMap(const std::filesystem::path& path, int layers) {
  const MapLayer picture = readOpaqueMapLayer(path, "layers");
  if (picture.bits == 16) {
    // 8 bits are 257 steps of 16.
    for (const float gray : picture.planes[0].values()) {
      if (std::lround(65535 * gray) % 257 != 0)
        throw InputError(path.string() +
                         ": has grays of 16 bits that 8 bits cannot hold, and a layer map has "
                         "8; save it as a picture of 8 bits");
    }
  }
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
