// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/layers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "core/random_streams.h"
#include "maps/distance_transform.h"
#include "maps/halved.h"

namespace exemplar {
namespace {

/// One layer of the example at every resolution, finest first.
using ShapePyramid = std::vector<Shape>;

std::int64_t pixelsOf(double share, std::size_t count) {
  return static_cast<std::int64_t>(std::llround(share * static_cast<double>(count)));
}

/// The `wanted` pixels of the largest values, as a shape; ties by a second value, then by lot.
Shape largest(const Grid<float>& values, const Grid<float>& second, std::int64_t wanted,
              const Random& random) {
  std::vector<std::size_t> order(values.count());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
  const auto before = [&](std::size_t a, std::size_t b) {
    if (values[a] != values[b]) return values[a] > values[b];
    if (second[a] != second[b]) return second[a] > second[b];
    const std::uint64_t ra = random.bits(a), rb = random.bits(b);
    return ra != rb ? ra < rb : a < b;
  };
  wanted = std::clamp<std::int64_t>(wanted, 0, static_cast<std::int64_t>(order.size()));
  std::ranges::nth_element(order, order.begin() + wanted, before);
  Shape shape(values.width(), values.height());
  for (std::int64_t n = 0; n < wanted; ++n) shape[order[static_cast<std::size_t>(n)]] = 1;
  return shape;
}

/// The mean of 3 x 3 pixels, on the torus.
Grid<float> blurred(const Grid<float>& values) {
  Grid<float> mean(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      float sum = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) sum += values[values.wrapped(x + dx, y + dy)];
      mean(x, y) = sum / 9;
    }
  }
  return mean;
}

/// A shape at half the resolution, and so on, with its share of the pixels at each.
ShapePyramid pyramidOf(const Shape& shape, int levels, const Random& random) {
  ShapePyramid pyramid{shape};
  const double share = areaOf(shape);
  Grid<float> coverage(shape.width(), shape.height());
  for (std::size_t p = 0; p < shape.count(); ++p) coverage[p] = shape[p];
  for (int l = 1; l < levels; ++l) {
    coverage = halved(coverage, false);
    pyramid.push_back(largest(coverage, blurred(coverage), pixelsOf(share, coverage.count()),
                              random.fork(static_cast<std::uint64_t>(l))));
  }
  return pyramid;
}

/// Takes from each layer what is not in the one below, at every resolution.
void nest(std::vector<ShapePyramid>& layers) {
  for (std::size_t i = 1; i < layers.size(); ++i)
    for (std::size_t l = 0; l < layers[i].size(); ++l)
      for (std::size_t p = 0; p < layers[i][l].count(); ++p) layers[i][l][p] &= layers[i - 1][l][p];
}

Shape enlarged(const Shape& shape, int width, int height) {
  Shape large(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      large(x, y) = shape(std::min(x / 2, shape.width() - 1), std::min(y / 2, shape.height() - 1));
  return large;
}

/// White noise, blurred, of which the largest are inside.
Shape randomShape(int width, int height, double share, const Random& random) {
  Grid<float> noise(width, height);
  for (std::size_t p = 0; p < noise.count(); ++p) noise[p] = static_cast<float>(random.uniform(p));
  return largest(blurred(noise), noise, pixelsOf(share, noise.count()), random);
}

/// Whether part of the upper shape touches what is outside the lower one.
bool touches(const Shape& upper, const Shape& lower, bool wraps) {
  std::size_t contacts = 0;
  const std::vector<Pixel> boundary = boundaryOf(lower, wraps);
  for (const Pixel& p : boundary) contacts += upper(p.x, p.y);
  return static_cast<double>(contacts) > 0.001 * static_cast<double>(boundary.size());
}

/// Where the layer above an optimized one may be, and where it begins (section 3.3).
struct Room {
  Shape mask, start;
};

Room roomAbove(const OptimizedShape& below, const ShapeExample& example, const Shape& above,
               const Shape* coarser, std::int64_t target, const ShapeOptions& options,
               const Random& random) {
  const Shape& shape = below.shape;
  const int width = shape.width(), height = shape.height();
  const PatchVotes votes =
      votesOf(above, example.patches, below.placed, width, height, options.exampleWraps);
  const float median = votes.medianWeight(below.placed.boundary);
  const bool apart = !touches(above, example.shape, options.exampleWraps);
  const std::vector<Pixel> edge = boundaryOf(shape, true);
  Room room;
  // The strictest mask that has room for the layer.
  for (const auto& [share, keepsOff] : {std::pair{0.15f, apart}, {0.0f, apart}, {0.0f, false}}) {
    room.mask = shape;
    std::int64_t left = 0;
    for (std::size_t p = 0; p < shape.count(); ++p)
      if (votes.weight(p) >= 0.2f * median && votes.share(p) < share) room.mask[p] = 0;
    if (keepsOff)
      for (const Pixel& p : edge) room.mask(p.x, p.y) = 0;
    for (const std::uint8_t v : room.mask.values()) left += v;
    if (left >= target) break;
  }
  if (!coarser) {
    Grid<float> wish(width, height), covered(width, height);
    for (std::size_t p = 0; p < wish.count(); ++p) {
      covered[p] = votes.weight(p);
      wish[p] = !room.mask[p] ? -1 : votes.weight(p) > 0 ? votes.share(p) : 0.4f;
    }
    room.start = largest(wish, covered, target, random);
  } else {
    room.start = enlarged(*coarser, width, height);
    for (std::size_t p = 0; p < shape.count(); ++p)
      if (votes.weight(p) >= 0.4f * median) room.start[p] = votes.share(p) > 0.5f;
  }
  for (std::size_t p = 0; p < shape.count(); ++p) room.start[p] &= room.mask[p];
  setArea(room.start, target, votes, &room.mask, random.fork(1));
  return room;
}

int levelsFor(const LayerMap& example, int width, int height, int wanted) {
  int levels = 1;
  int side = std::min({example.width(), example.height(), width, height});
  for (; levels < wanted && side / 2 >= 8; side /= 2) ++levels;
  return levels;
}

}  // namespace

SynthesizedLayers synthesizeLayers(const LayerMap& example, int width, int height,
                                   const LayerOptions& options, const Progress& progress) {
  const int layers = layerCount(example);
  const int levels = levelsFor(example, width, height, options.shape.levels);
  const Random random(options.seed, stream::kLayers);
  std::vector<ShapePyramid> wanted;
  for (int i = 2; i <= layers; ++i)
    wanted.push_back(
        pyramidOf(layerShape(example, i), levels, random.fork(static_cast<std::uint64_t>(i))));
  nest(wanted);

  SynthesizedLayers result{LayerMap(width, height, 1), {}};
  std::vector<OptimizedShape> below(static_cast<std::size_t>(levels));
  std::vector<ShapeExample> belowExample(static_cast<std::size_t>(levels));
  // A level has four times the pixels of the next and takes most of the time.
  std::vector<double> until(static_cast<std::size_t>(levels) + 1, 1);
  for (int l = 1; l <= levels; ++l)
    until[static_cast<std::size_t>(l)] = until[static_cast<std::size_t>(l) - 1] / 4;
  for (int i = 2; i <= layers; ++i) {
    const Progress ofLayer = progress.part(static_cast<double>(i - 2) / (layers - 1),
                                           static_cast<double>(i - 1) / (layers - 1));
    const Random draws = random.fork(static_cast<std::uint64_t>(100 + i));
    Shape coarser;
    for (int l = levels - 1; l >= 0; --l) {
      const auto level = static_cast<std::size_t>(l);
      const Random own = draws.fork(level);
      const Shape& shape = wanted[static_cast<std::size_t>(i - 2)][level];
      ShapeExample likeness = shapeExample(shape, options.shape, own.fork(1));
      const int w = std::max(1, width >> l), h = std::max(1, height >> l);
      const std::size_t count = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
      const std::int64_t target = pixelsOf(likeness.area, count);
      Shape start;
      std::optional<Room> room;
      if (i == 2) {
        start = coarser.empty() ? randomShape(w, h, likeness.area, own.fork(2))
                                : enlarged(coarser, w, h);
      } else {
        room = roomAbove(below[level], belowExample[level], shape,
                         coarser.empty() ? nullptr : &coarser, target, options.shape, own.fork(2));
        start = std::move(room->start);
      }
      OptimizedShape made =
          optimizeShape(std::move(start), likeness, room ? &room->mask : nullptr, options.shape,
                        own.fork(3), ofLayer.part(until[level + 1], until[level]));
      coarser = made.shape;
      below[level] = std::move(made);
      belowExample[level] = std::move(likeness);
    }
    for (std::size_t p = 0; p < result.map.count(); ++p)
      if (coarser[p]) result.map[p] = static_cast<std::uint8_t>(i);
    result.areaErrors.push_back(areaOf(coarser) -
                                areaOf(wanted[static_cast<std::size_t>(i - 2)][0]));
  }
  return result;
}

ControlMaps controlMaps(const LayerMap& example, bool exampleWraps, const LayerMap& result,
                        const Progress& progress) {
  const int layers = layerCount(example);
  ControlMaps maps{Grid<float>(example.width(), example.height()),
                   Grid<float>(result.width(), result.height())};
  for (int i = 1; i <= layers; ++i) {
    progress.report("smoothing layers", static_cast<double>(i - 1) / layers);
    float most = 0;  // of the example's only distance, in the bottom and top layers
    for (const bool ofExample : {true, false}) {
      const LayerMap& map = ofExample ? example : result;
      Grid<float>& control = ofExample ? maps.example : maps.result;
      const bool wraps = !ofExample || exampleWraps;
      Shape lower(map.width(), map.height()), higher = layerShape(map, i + 1);
      for (std::size_t p = 0; p < map.count(); ++p) lower[p] = map[p] < i;
      const Grid<float> down = distanceTo(lower, wraps), up = distanceTo(higher, wraps);
      const bool bottom = i == 1, top = i == layers;
      if (ofExample && (bottom || top)) {
        for (std::size_t p = 0; p < map.count(); ++p) {
          const float distance = bottom ? up[p] : down[p];
          if (map[p] == i && std::isfinite(distance)) most = std::max(most, distance);
        }
      }
      for (std::size_t p = 0; p < map.count(); ++p) {
        if (map[p] != i) continue;
        float within = 0.5f;
        if (bottom) {
          within = 1 - (most > 0 ? std::min(1.0f, up[p] / most) : 0);
        } else if (top) {
          within = most > 0 ? std::min(1.0f, down[p] / most) : 0;
        } else if (std::isfinite(down[p]) && std::isfinite(up[p])) {
          within = down[p] / (down[p] + up[p]);
        }
        control[p] = static_cast<float>(i) + within;
      }
    }
  }
  return maps;
}

}  // namespace exemplar
