// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/error.h"
#include "core/parallel.h"
#include "measure/distribution.h"

namespace exemplar {
namespace {

constexpr int kPatch = 15;
constexpr std::size_t kLookedUp = 2000, kLookedAmong = 20000;
constexpr int kWindow = 32;
constexpr std::size_t kWindows = 150;

/// Every so many-th of them, at most `most`.
std::vector<Pixel> thinned(const std::vector<Pixel>& all, std::size_t most) {
  std::vector<Pixel> some;
  const std::size_t count = std::min(all.size(), most);
  for (std::size_t n = 0; n < count; ++n) some.push_back(all[n * all.size() / count]);
  return some;
}

/// The boundary pixels whose patches lie inside, while a quarter does.
std::vector<Pixel> patchCenters(const Shape& shape, bool wraps) {
  std::vector<Pixel> all = boundaryOf(shape, wraps), whole;
  if (wraps) return all;
  constexpr int kHalf = kPatch / 2;
  for (const Pixel& p : all)
    if (shape.contains(p.x - kHalf, p.y - kHalf) && shape.contains(p.x + kHalf, p.y + kHalf))
      whole.push_back(p);
  return 4 * whole.size() >= all.size() ? whole : all;
}

/// The mean distance of patches of one shape to their nearest of another, as a share of a patch.
std::optional<double> meanDistance(const Shape& from, bool fromWraps, const Shape& to, bool toWraps,
                                   const Progress& progress) {
  const std::vector<Pixel> some = thinned(patchCenters(from, fromWraps), kLookedUp);
  const std::vector<Pixel> among = thinned(patchCenters(to, toWraps), kLookedAmong);
  if (some.empty() || among.empty()) return std::nullopt;
  const BoundaryPatches patches(from, some, kPatch, 1, fromWraps);
  const BoundaryPatches others(to, among, kPatch, 4, toWraps);
  const NearestPatches nearest(others);
  return parallelSum<double>(0, patches.count(), 64,
                             [&](std::size_t first, std::size_t last) {
                               progress.check();
                               double sum = 0;
                               std::vector<PatchMatch2D> found;
                               for (std::size_t p = first; p < last; ++p) {
                                 nearest.find(patches, p, 1, {}, found);
                                 sum += found.front().distance;
                               }
                               return sum;
                             }) /
         static_cast<double>(patches.count()) / (kPatch * kPatch);
}

std::vector<double> sortedSizes(const Shape& shape, bool wraps) {
  std::vector<double> sizes;
  for (const std::uint32_t size : componentSizes(shape, true, wraps)) sizes.push_back(size);
  std::ranges::sort(sizes);
  return sizes;
}

/// Whether the windows at two places agree but for `most` pixels.
bool agree(const LayerMap& map, const Pixel& a, const Pixel& b, int most) {
  int differing = 0;
  for (int y = 0; y < kWindow; ++y) {
    for (int x = 0; x < kWindow; ++x) differing += map(a.x + x, a.y + y) != map(b.x + x, b.y + y);
    if (differing > most) return false;
  }
  return true;
}

std::optional<double> repeatedShare(const LayerMap& map, const Progress& progress) {
  const int columns = map.width() - kWindow + 1, rows = map.height() - kWindow + 1;
  if (columns < kWindow || rows < 1) return std::nullopt;
  // Places on a grid, as many as are wanted.
  const std::size_t places = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::vector<Pixel> windows;
  for (std::size_t n = 0; n < 2 * kWindows && windows.size() < kWindows; ++n) {
    // A step that is prime to most sizes spreads them evenly.
    const std::size_t place = n * 7919 * 104729 % places;
    const Pixel at{static_cast<int>(place % static_cast<std::size_t>(columns)),
                   static_cast<int>(place / static_cast<std::size_t>(columns))};
    bool mixed = false;
    for (int y = 0; y < kWindow && !mixed; ++y)
      for (int x = 0; x < kWindow; ++x) mixed |= map(at.x + x, at.y + y) != map(at.x, at.y);
    if (mixed) windows.push_back(at);
  }
  if (windows.empty()) return std::nullopt;
  constexpr int kMost = kWindow * kWindow * 3 / 100;
  std::vector<std::uint8_t> again(windows.size());
  parallelFor(0, windows.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t w = first; w < last; ++w) {
      progress.check();
      const Pixel& a = windows[w];
      for (int y = 0; y < rows && !again[w]; ++y) {
        for (int x = 0; x < columns && !again[w]; ++x) {
          if (std::abs(x - a.x) < kWindow && std::abs(y - a.y) < kWindow) continue;
          // Most places differ in a few pixels already.
          int probes = 0;
          for (int k = 0; k < 8; ++k)
            probes += map(a.x + 4 * k, a.y + 4 * k) != map(x + 4 * k, y + 4 * k);
          if (probes <= 3) again[w] = agree(map, a, {x, y}, kMost);
        }
      }
    }
  });
  return static_cast<double>(std::ranges::count(again, 1)) / static_cast<double>(again.size());
}

}  // namespace

LayersLikeness measureLayers(const LayerMap& example, bool exampleWraps, const LayerMap& result,
                             const Progress& progress) {
  const int layers = layerCount(example);
  if (layerCount(result) > layers)
    throw InputError("the result has a layer " + std::to_string(layerCount(result)) +
                     ", the example has " + std::to_string(layers));
  LayersLikeness likeness;
  for (int i = 2; i <= layers; ++i) {
    progress.report("measuring layers", static_cast<double>(i - 2) / (layers - 1));
    const Shape e = layerShape(example, i), s = layerShape(result, i);
    LayerLikeness layer{.layer = i, .areaError = areaOf(s) - areaOf(e)};
    const auto share = [](const Shape& shape, bool wraps) {
      return static_cast<double>(boundaryOf(shape, wraps).size()) /
             static_cast<double>(shape.count());
    };
    if (const double wanted = share(e, exampleWraps); wanted > 0)
      layer.boundaryRatio = share(s, true) / wanted;
    layer.toExample = meanDistance(s, true, e, exampleWraps, progress);
    layer.toResult = meanDistance(e, exampleWraps, s, true, progress);
    const std::vector<double> a = sortedSizes(e, exampleWraps), b = sortedSizes(s, true);
    if (!a.empty() && !b.empty()) layer.componentSizes = kolmogorovSmirnov(a, b);
    likeness.layers.push_back(layer);
  }
  likeness.skipping = skippingShare(result);
  likeness.exampleSkipping = skippingShare(example);
  likeness.repeated = repeatedShare(result, progress);
  likeness.exampleRepeated = repeatedShare(example, progress);
  return likeness;
}

}  // namespace exemplar
