// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/layers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

#include "core/cells.h"
#include "core/error.h"
#include "core/parallel.h"
#include "maps/boundary_patches.h"
#include "measure/distribution.h"

namespace exemplar {
namespace {

constexpr std::size_t kLookedUp = 2000, kLookedAmong = 20000;
constexpr std::size_t kWindows = 150;

/// Sides of the patches and windows that are compared: flat, and in space.
int patchSide(const Vec3i& size) { return size.z == 1 ? 15 : 9; }
Vec3i windowOf(const Vec3i& size) { return size.z == 1 ? Vec3i{32, 32, 1} : Vec3i{16, 16, 16}; }

/// Every so many-th of them, at most `most`.
std::vector<Vec3i> thinned(const std::vector<Vec3i>& all, std::size_t most) {
  std::vector<Vec3i> some;
  const std::size_t count = std::min(all.size(), most);
  for (std::size_t n = 0; n < count; ++n) some.push_back(all[n * all.size() / count]);
  return some;
}

/// The boundary cells whose patches lie inside, while a quarter does.
std::vector<Vec3i> patchCenters(const Shape& shape, bool wraps) {
  std::vector<Vec3i> all = boundaryOf(shape, wraps), whole;
  if (wraps) return all;
  const int side = patchSide(shape.size()), half = side / 2;
  const Vec3i reach{half, half, patchDepth(shape.size(), side) / 2};
  for (const Vec3i& p : all)
    if (shape.contains(p - reach) && shape.contains(p + reach)) whole.push_back(p);
  return 4 * whole.size() >= all.size() ? whole : all;
}

/// Patches of one shape and the nearest of another to each.
struct NearestOfOther {
  std::vector<Vec3i> centers, among;
  std::vector<BoundaryMatch> nearest;  // one for each of the first
  int cells = 0;                       // of a patch

  double meanDistance() const {
    double sum = 0;
    for (const BoundaryMatch& match : nearest) sum += match.distance;
    return sum / static_cast<double>(nearest.size()) / cells;
  }
};
/// Nothing where one of the two has no boundary.
std::optional<NearestOfOther> nearestOfOther(const Shape& from, bool fromWraps, const Shape& to,
                                             bool toWraps, const Progress& progress) {
  NearestOfOther result{thinned(patchCenters(from, fromWraps), kLookedUp),
                        thinned(patchCenters(to, toWraps), kLookedAmong),
                        {}};
  if (result.centers.empty() || result.among.empty()) return std::nullopt;
  const int side = patchSide(from.size());
  const BoundaryPatches patches(from, result.centers, side, 1, fromWraps);
  const BoundaryPatches others(to, result.among, side, 4, toWraps);
  const NearestPatches nearest(others);
  result.cells = patches.cells();
  result.nearest.resize(patches.count());
  parallelFor(0, patches.count(), 64, [&](std::size_t first, std::size_t last) {
    progress.check();
    std::vector<BoundaryMatch> found;
    for (std::size_t p = first; p < last; ++p) {
      nearest.find(patches, p, 1, {}, found);
      result.nearest[p] = found.front();
    }
  });
  return result;
}

double usageOf(const NearestOfOther& found) {
  std::vector<double> uses(found.among.size());
  const auto count = static_cast<double>(found.nearest.size());
  for (const BoundaryMatch& match : found.nearest) uses[match.patch] += 1 / count;
  double entropy = 0;
  for (const double share : uses)
    if (share > 0) entropy -= share * std::log(share);
  return std::exp(entropy) / std::min(count, static_cast<double>(uses.size()));
}

/// From a place of the result to one of the example: a symmetry, and what is added afterward.
struct Motion {
  int symmetry = 0;
  Vec3i offset;

  Vec3i of(const Vec3i& p) const { return turnedAboutZ(p, symmetry) + offset; }
  bool operator<(const Motion& other) const {
    return std::tie(symmetry, offset.x, offset.y) <
           std::tie(other.symmetry, other.offset.x, other.offset.y);
  }
};
/// Whether the patch around a place and the example's under a motion differ in 3 % of their pixels
/// at most.
bool isCopied(const Shape& result, const Vec3i& p, const Shape& example, bool exampleWraps,
              const Motion& motion) {
  const int half = patchSide(result.size()) / 2;
  int differing = 0;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx) {
      const Vec3i here = p + Vec3i{dx, dy, 0};
      Vec3i there = motion.of(here);
      if (exampleWraps) there = wrappedPlace(there, example.size());
      if (!example.contains(there)) return false;
      differing += (result[wrappedPlace(here, result.size())] != 0) != (example[there] != 0);
    }
  }
  return 100 * differing <= 3 * (2 * half + 1) * (2 * half + 1);
}

/// From each looked-up patch along the boundary as far as the motion to its nearest one holds.
std::int64_t longestRun(const Shape& result, const Shape& example, bool exampleWraps,
                        const NearestOfOther& found, const Progress& progress) {
  Shape boundary(result.size());
  for (const Vec3i& p : boundaryOf(result, true)) boundary[p] = 1;
  std::map<Motion, std::set<std::size_t>> seen;
  std::int64_t longest = 0;
  for (std::size_t n = 0; n < found.centers.size(); ++n) {
    progress.check();
    const Vec3i& start = found.centers[n];
    // A turned patch of the example is compared: the example's place of a step is the turned step.
    Motion motion{found.nearest[n].turn, {}};
    motion.offset = found.among[found.nearest[n].patch] - motion.of(start);
    std::set<std::size_t>& known = seen[motion];
    std::vector<Vec3i> waiting;
    const auto visit = [&](const Vec3i& p) {
      const std::size_t at = boundary.index(wrappedPlace(p, boundary.size()));
      if (!boundary.data()[at] || !known.insert(at).second) return;
      if (isCopied(result, p, example, exampleWraps, motion)) waiting.push_back(p);
    };
    visit(start);
    std::int64_t run = 0;
    for (; !waiting.empty(); ++run) {
      const Vec3i p = waiting.back();
      waiting.pop_back();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) visit(p + Vec3i{dx, dy, 0});
    }
    longest = std::max(longest, run);
  }
  return longest;
}

std::vector<double> sortedSizes(const Shape& shape, bool wraps) {
  std::vector<double> sizes;
  for (const std::uint32_t size : componentSizes(shape, true, wraps)) sizes.push_back(size);
  std::ranges::sort(sizes);
  return sizes;
}

/// Whether the windows at two places agree but for `most` cells.
bool agree(const LayerVolume& map, const Vec3i& window, const Vec3i& a, const Vec3i& b, int most) {
  int differing = 0;
  for (int z = 0; z < window.z; ++z) {
    for (int y = 0; y < window.y; ++y) {
      const std::uint8_t* rowA = map.data() + map.index(a + Vec3i{0, y, z});
      const std::uint8_t* rowB = map.data() + map.index(b + Vec3i{0, y, z});
      for (int x = 0; x < window.x; ++x) differing += rowA[x] != rowB[x];
      if (differing > most) return false;
    }
  }
  return true;
}

/// Windows of two layers or more, spread over the map.
std::vector<Vec3i> mixedWindows(const LayerVolume& map, const Vec3i& window, const Vec3i& places) {
  const auto count = static_cast<std::size_t>(volume(places));
  std::vector<Vec3i> windows;
  for (std::size_t n = 0; n < 2 * kWindows && windows.size() < kWindows; ++n) {
    // A step that is prime to most sizes spreads them evenly.
    const std::size_t place = n * 7919 * 104729 % count;
    const auto nx = static_cast<std::size_t>(places.x), ny = static_cast<std::size_t>(places.y);
    const Vec3i at{static_cast<int>(place % nx), static_cast<int>(place / nx % ny),
                   static_cast<int>(place / (nx * ny))};
    bool mixed = false;
    forEachCell(CellBox{at, at + window}, [&](const Vec3i& p) { mixed |= map[p] != map[at]; });
    if (mixed) windows.push_back(at);
  }
  return windows;
}

std::optional<double> repeatedShare(const LayerVolume& map, const Progress& progress) {
  const Vec3i window = windowOf(map.size());
  const Vec3i places = map.size() - window + Vec3i{1, 1, 1};
  if (places.x < window.x || places.y < 1 || places.z < 1) return std::nullopt;
  const std::vector<Vec3i> windows = mixedWindows(map, window, places);
  if (windows.empty()) return std::nullopt;
  const auto most = static_cast<int>(volume(window) * 3 / 100);
  // Most places differ in a few of eight cells on the diagonal already.
  const Vec3i probe{window.x / 8, window.y / 8, window.z / 8};
  std::vector<std::uint8_t> again(windows.size());
  parallelFor(0, windows.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t w = first; w < last; ++w) {
      progress.check();
      const Vec3i& a = windows[w];
      forEachCell(places, [&](const Vec3i& b) {
        if (again[w]) return;
        if (std::abs(b.x - a.x) < window.x && std::abs(b.y - a.y) < window.y &&
            std::abs(b.z - a.z) < window.z)
          return;
        int probes = 0;
        for (int k = 0; k < 8; ++k) probes += map[a + probe * k] != map[b + probe * k];
        if (probes <= 3) again[w] = agree(map, window, a, b, most);
      });
    }
  });
  return static_cast<double>(std::ranges::count(again, 1)) / static_cast<double>(again.size());
}

}  // namespace

LayersLikeness measureLayers(const LayerVolume& example, bool exampleWraps,
                             const LayerVolume& result, const Progress& progress) {
  const int layers = layerCount(example);
  if ((example.size().z == 1) != (result.size().z == 1))
    throw InputError("the layers of a picture and of a volume cannot be compared");
  if (layerCount(result) > layers)
    throw InputError("the result has a layer " + std::to_string(layerCount(result)) +
                     ", the example has " + std::to_string(layers));
  LayersLikeness likeness;
  for (int i = 2; i <= layers; ++i) {
    progress.report("measuring layers", static_cast<double>(i - 2) / (layers - 1));
    const Shape e = layerShape(example, i), s = layerShape(result, i);
    LayerLikeness layer{.layer = i, .areaError = areaOf(s) - areaOf(e)};
    const auto share = [](const Shape& shape, bool wraps) {
      return static_cast<double>(boundaryCount(shape, wraps)) / static_cast<double>(shape.count());
    };
    if (const double wanted = share(e, exampleWraps); wanted > 0)
      layer.boundaryRatio = share(s, true) / wanted;
    if (const auto found = nearestOfOther(s, true, e, exampleWraps, progress)) {
      layer.toExample = found->meanDistance();
      layer.usage = usageOf(*found);
      if (s.size().z == 1) layer.longestRun = longestRun(s, e, exampleWraps, *found, progress);
    }
    if (const auto found = nearestOfOther(e, exampleWraps, s, true, progress))
      layer.toResult = found->meanDistance();
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
