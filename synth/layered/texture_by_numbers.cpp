// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/texture_by_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/random_streams.h"
#include "maps/fill_smoothly.h"
#include "maps/halved.h"
#include "synth/layered/scan_texture.h"
#include "synth/layered/texture_level.h"

namespace exemplar {
namespace {

/// Values at a resolution: the guide, then the texture's planes.
TextureFeatures featuresOf(const Planes& guides, const Planes& planes, float guideWeight,
                           float planeWeight) {
  const Vec3i& size = guides.front().size();
  TextureFeatures features{
      size, static_cast<int>(guides.size() + planes.size()), static_cast<int>(guides.size()), {}};
  features.data.reserve(guides.front().count() * static_cast<std::size_t>(features.values));
  for (std::size_t p = 0; p < guides.front().count(); ++p) {
    for (const Array3D<float>& guide : guides)
      features.data.push_back(guideWeight * guide.data()[p]);
    for (const Array3D<float>& plane : planes)
      features.data.push_back(planeWeight * plane.data()[p]);
  }
  return features;
}

float spreadOf(const Array3D<float>& values) {
  double sum = 0, squares = 0;
  for (const float v : values.values()) {
    sum += v;
    squares += static_cast<double>(v) * v;
  }
  const double n = static_cast<double>(values.count());
  return static_cast<float>(std::sqrt(std::max(squares / n - sum / n * (sum / n), 1e-12)));
}

Planes halvedAll(const Planes& planes) {
  Planes half;
  for (const Array3D<float>& plane : planes) half.push_back(halved(plane, true));
  return half;
}

TextureTask halvedTask(const TextureTask& task) {
  TextureTask half{
      halvedAll(task.example), halvedAll(task.exampleGuide), halvedAll(task.guide), {}};
  if (task.hole.empty()) return half;
  Array3D<float> part(task.hole.size());
  for (std::size_t p = 0; p < part.count(); ++p) part.data()[p] = task.hole.data()[p] ? 1.0f : 0.0f;
  part = halved(part, true);
  half.hole = Shape(part.size());
  for (std::size_t p = 0; p < part.count(); ++p) half.hole.data()[p] = part.data()[p] > 0;
  return half;
}

/// Whether a patch of the example lies clear of the hole.
bool leavesPatch(const Shape& hole, int patch) {
  const Vec3i& size = hole.size();
  const int half = patch / 2, depth = patchDepth(size, patch) / 2;
  const Vec3i reach{half, half, depth}, one{1, 1, 1};
  bool leaves = false;
  forEachCell(CellBox{reach, size - reach}, [&](const Vec3i& p) {
    if (leaves) return;
    bool clear = true;
    forEachCell(CellBox{p - reach, p + reach + one}, [&](const Vec3i& q) { clear &= !hole[q]; });
    leaves = clear;
  });
  return leaves;
}

int leastSide(const Vec3i& size) {
  const int flat = std::min(size.x, size.y);
  return size.z == 1 ? flat : std::min(flat, size.z);
}

/// For each cell the example's cell in the patch over it that counts most there, which fits best or
/// lies nearly in the middle, among those that `accepts(cell, place)`; where none is, {-1, -1, -1}.
template <class Accepts>
TextureOrigins sharpest(const MatchedTexture& matched, const TextureTask& task,
                        const TextureOptions& options, const Accepts& accepts) {
  const Vec3i &size = matched.origins.size(), &exampleSize = task.exampleSize();
  const int half = options.patch / 2, depth = patchDepth(size, options.patch) / 2;
  std::vector<float> sorted(matched.costs.values().begin(), matched.costs.values().end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  const float spread = std::max(*middle, 1e-6f);
  TextureOrigins from = matched.origins;
  parallelForEachCell(size, [&](const Vec3i& p) {
    const std::size_t cell = from.index(p);
    if (!task.hole.empty() && !task.hole.data()[cell]) {
      from.data()[cell] = p;
      return;
    }
    float least = std::numeric_limits<float>::infinity();
    Vec3i best{-1, -1, -1};
    for (int dz = -depth; dz <= depth; ++dz) {
      for (int dy = -half; dy <= half; ++dy) {
        for (int dx = -half; dx <= half; ++dx) {
          const Vec3i step{dx, dy, dz};
          Vec3i q = p + step;
          if (options.wraps) {
            q = wrappedPlace(q, size);
          } else if (!matched.origins.contains(q)) {
            continue;
          }
          const float price =
              matched.costs[q] / spread + 0.5f * static_cast<float>(dx * dx + dy * dy + dz * dz);
          if (price >= least) continue;
          const Vec3i place = wrappedPlace(matched.origins[q] - step, exampleSize);
          if (!accepts(cell, place)) continue;
          least = price;
          best = place;
        }
      }
    }
    from.data()[cell] = best;
  });
  return from;
}

/// The example's cells of each layer, by their guide's value.
class CellsByGuide {
 public:
  CellsByGuide(const LayerVolume& layers, const Array3D<float>& guide) : guide_(guide) {
    cells_.resize(static_cast<std::size_t>(layerCount(layers)) + 1);
    for (std::size_t p = 0; p < layers.count(); ++p)
      cells_[layers.data()[p]].push_back(static_cast<std::uint32_t>(p));
    for (std::vector<std::uint32_t>& cells : cells_)
      std::ranges::sort(cells, {}, [&](std::uint32_t p) { return std::pair{guide.data()[p], p}; });
  }
  /// A cell of the layer whose guide is nearest to the value.
  Vec3i nearest(int layer, float value) const {
    const std::vector<std::uint32_t>& cells = cells_[static_cast<std::size_t>(layer)];
    const auto valueOf = [&](std::uint32_t p) { return guide_.data()[p]; };
    auto at = std::ranges::lower_bound(cells, value, {}, valueOf);
    if (at == cells.end() ||
        (at != cells.begin() && value - valueOf(at[-1]) < valueOf(*at) - value))
      --at;
    return guide_.ijk(*at);
  }

 private:
  const Array3D<float>& guide_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace

TextureOrigins sharpestOrigins(const MatchedTexture& matched, const TextureTask& task,
                               const TextureOptions& options) {
  return sharpest(matched, task, options, [](std::size_t, const Vec3i&) { return true; });
}

TextureOrigins layerOrigins(const MatchedTexture& matched, const TextureTask& task,
                            const LayerVolume& exampleLayers, const LayerVolume& layers,
                            const TextureOptions& options) {
  TextureOrigins from = sharpest(matched, task, options, [&](std::size_t cell, const Vec3i& place) {
    return exampleLayers[place] == layers.data()[cell];
  });
  const CellsByGuide others(exampleLayers, task.exampleGuide.front());
  for (std::size_t p = 0; p < from.count(); ++p) {
    if (from.data()[p].x < 0)
      from.data()[p] = others.nearest(layers.data()[p], task.guide.front().data()[p]);
  }
  return from;
}

void requireTexturePatch(const Vec3i& exampleSize, const TextureOptions& options) {
  const int least = leastSide(exampleSize);
  if (least > options.patch) return;
  throw InputError("the example is " + std::to_string(least) + " cells wide, and patches of " +
                   std::to_string(options.patch) + " cells (`texture-patch`) need " +
                   std::to_string(options.patch + 1));
}

MatchedTexture matchTexture(const TextureTask& task, const TextureOptions& options,
                            const Progress& progress) {
  requireTexturePatch(task.exampleSize(), options);
  const int least = leastSide(task.exampleSize());
  int levels = 1;
  for (int side = std::min(least, leastSide(task.size()));
       levels < options.levels && side / 2 >= 4 * options.patch; side /= 2)
    ++levels;
  // A step from one layer to the next weighs as much as a change of the texture by its spread.
  float spread = 0;
  for (const Array3D<float>& plane : task.example)
    spread += spreadOf(plane) / static_cast<float>(task.example.size());
  const float planeWeight = 1 / std::max(spread, 1e-6f);
  const auto guideWeight = static_cast<float>(options.guide);

  std::vector<TextureTask> pyramid{task};
  for (int l = 1; l < levels; ++l) {
    TextureTask coarser = halvedTask(pyramid.back());
    if (!coarser.hole.empty() && !leavesPatch(coarser.hole, options.patch)) break;
    pyramid.push_back(std::move(coarser));
  }
  levels = static_cast<int>(pyramid.size());
  const Random random(options.seed, stream::kTextureStart);
  const double share = task.size().z > 1 ? 0.125 : 0.25;
  MatchedTexture matched;
  std::optional<ScannedLevel> scanned;
  for (int l = levels - 1; l >= 0; --l) {
    const TextureTask& at = pyramid[static_cast<std::size_t>(l)];
    const TextureFeatures from = featuresOf(at.exampleGuide, at.example, guideWeight, planeWeight);
    // In a hole it begins with what is around it; else with nothing.
    Planes begin = at.example;
    if (at.hole.empty())
      for (Array3D<float>& plane : begin) plane = Array3D<float>(at.size());
    TextureFeatures to = featuresOf(at.guide, begin, guideWeight, planeWeight);
    const Shape* hole = at.hole.empty() ? nullptr : &at.hole;
    const Random own = random.fork(static_cast<std::uint64_t>(l));
    const Progress part =
        progress.part(l + 1 == levels ? 0 : std::pow(share, l + 1), std::pow(share, l));
    if (options.method == TextureMethod::Classic) {
      scanned = scanTexture(from, std::move(to), scanned ? &*scanned : nullptr, hole, l, options,
                            own, part);
      continue;
    }
    TextureLevel level(from, std::move(to), hole, options, own);
    if (matched.origins.empty()) {
      level.startAtRandom();
    } else {
      level.startFrom(matched.origins);
    }
    level.run(options.rounds, part);
    matched = {level.origins(), level.costs()};
  }
  if (scanned) {
    matched.costs = Array3D<float>(task.size());
    matched.origins = std::move(scanned->origins);
  }
  return matched;
}

Planes planesOf(const MapLayer& picture) {
  Planes planes;
  for (const Grid<float>& plane : picture.planes) planes.push_back(boxOf(plane));
  return planes;
}

GuidedTexture synthesizeTexture(const Map& example, Planes exampleGuide, Planes guide,
                                const Shape& hole, const TextureOptions& options,
                                const Progress& progress) {
  TextureTask task{planesOf(example.layers.front()), std::move(exampleGuide), std::move(guide),
                   hole};
  if (!hole.empty()) fillSmoothly(task.example, hole);
  GuidedTexture made{{}, sharpestOrigins(matchTexture(task, options, progress), task, options)};
  const Vec3i& size = made.origins.size();
  for (const MapLayer& layer : example.layers) {
    MapLayer picture{layer.name, {}, layer.bits};
    for (const Grid<float>& plane : layer.planes) {
      Grid<float> values(size.x, size.y);
      for (std::size_t p = 0; p < values.count(); ++p) {
        const Vec3i& from = made.origins.data()[p];
        values[p] = plane(from.x, from.y);
      }
      picture.planes.push_back(std::move(values));
    }
    made.map.layers.push_back(std::move(picture));
  }
  return made;
}

}  // namespace exemplar
