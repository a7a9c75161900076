// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/layers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "core/cells.h"
#include "core/random_streams.h"
#include "maps/distance_transform.h"
#include "maps/fill_smoothly.h"
#include "maps/halved.h"

namespace exemplar {
namespace {

/// One layer of the example at every resolution, finest first.
using ShapePyramid = std::vector<Shape>;

std::int64_t cellsOf(double share, std::size_t count) {
  return static_cast<std::int64_t>(std::llround(share * static_cast<double>(count)));
}

/// The `wanted` cells of the largest values, as a shape; ties by a second value, then by lot.
Shape largest(const Array3D<float>& values, const Array3D<float>& second, std::int64_t wanted,
              const Random& random) {
  std::vector<std::size_t> order(values.count());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
  const float *first = values.data(), *then = second.data();
  const auto before = [&](std::size_t a, std::size_t b) {
    if (first[a] != first[b]) return first[a] > first[b];
    if (then[a] != then[b]) return then[a] > then[b];
    const std::uint64_t ra = random.bits(a), rb = random.bits(b);
    return ra != rb ? ra < rb : a < b;
  };
  wanted = std::clamp<std::int64_t>(wanted, 0, static_cast<std::int64_t>(order.size()));
  std::ranges::nth_element(order, order.begin() + wanted, before);
  Shape shape(values.size());
  for (std::int64_t n = 0; n < wanted; ++n) shape.data()[order[static_cast<std::size_t>(n)]] = 1;
  return shape;
}

/// The mean of 3 x 3 (in space 3 x 3 x 3) cells, on the torus.
Array3D<float> blurred(const Array3D<float>& values) {
  const Vec3i& size = values.size();
  const int depth = size.z == 1 ? 0 : 1;
  Array3D<float> mean(size);
  parallelForEachCell(size, [&](const Vec3i& p) {
    float sum = 0;
    for (int dz = -depth; dz <= depth; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) sum += values[wrappedPlace(p + Vec3i{dx, dy, dz}, size)];
    mean[p] = sum / static_cast<float>(9 * (2 * depth + 1));
  });
  return mean;
}

/// A shape at half the resolution, and so on, with its share of the cells at each.
ShapePyramid pyramidOf(const Shape& shape, int levels, const Random& random) {
  ShapePyramid pyramid{shape};
  const double share = areaOf(shape);
  Array3D<float> coverage(shape.size());
  for (std::size_t p = 0; p < shape.count(); ++p) coverage.data()[p] = shape.data()[p];
  for (int l = 1; l < levels; ++l) {
    coverage = halved(coverage, false);
    pyramid.push_back(largest(coverage, blurred(coverage), cellsOf(share, coverage.count()),
                              random.fork(static_cast<std::uint64_t>(l))));
  }
  return pyramid;
}
/// Every layer from the second on, each inside the one below at every resolution.
std::vector<ShapePyramid> pyramidsOf(const LayerVolume& layers, int count, int levels,
                                     const Random& random) {
  std::vector<ShapePyramid> all;
  for (int i = 2; i <= count; ++i)
    all.push_back(
        pyramidOf(layerShape(layers, i), levels, random.fork(static_cast<std::uint64_t>(i))));
  for (std::size_t i = 1; i < all.size(); ++i)
    for (std::size_t l = 0; l < all[i].size(); ++l)
      for (std::size_t p = 0; p < all[i][l].count(); ++p)
        all[i][l].data()[p] &= all[i - 1][l].data()[p];
  return all;
}

/// A hole at every resolution: cells of which any part is in it.
ShapePyramid holePyramid(const Shape& hole, int levels) {
  ShapePyramid pyramid{hole};
  Array3D<float> part(hole.size());
  for (std::size_t p = 0; p < hole.count(); ++p) part.data()[p] = hole.data()[p] ? 1.0f : 0.0f;
  for (int l = 1; l < levels; ++l) {
    part = halved(part, false);
    Shape any(part.size());
    for (std::size_t p = 0; p < any.count(); ++p) any.data()[p] = part.data()[p] > 0;
    pyramid.push_back(std::move(any));
  }
  return pyramid;
}

Shape enlarged(const Shape& shape, const Vec3i& size) {
  Shape large(size);
  std::size_t at = 0;
  forEachCell(size, [&](const Vec3i& p) {
    large.data()[at++] = shape[shape.clamped({p.x / 2, p.y / 2, size.z == 1 ? 0 : p.z / 2})];
  });
  return large;
}

/// White noise, blurred, of which the largest are inside.
Shape randomShape(const Vec3i& size, double share, const Random& random) {
  Array3D<float> noise(size);
  for (std::size_t p = 0; p < noise.count(); ++p)
    noise.data()[p] = static_cast<float>(random.uniform(p));
  return largest(blurred(noise), noise, cellsOf(share, noise.count()), random);
}

/// The same in a hole, where noise leans toward what lies around it; elsewhere what is given.
Shape randomShapeIn(const Shape& hole, const Shape& given, std::int64_t wanted,
                    const Random& random) {
  std::vector<Array3D<float>> around(1, Array3D<float>(given.size()));
  Array3D<float> noise(given.size());
  for (std::size_t p = 0; p < noise.count(); ++p) {
    around[0].data()[p] = given.data()[p];
    noise.data()[p] = static_cast<float>(random.uniform(p));
  }
  fillSmoothly(around, hole);
  const Array3D<float> smooth = blurred(noise);
  Array3D<float> wish = blurred(around[0]);
  for (std::size_t p = 0; p < wish.count(); ++p)
    wish.data()[p] = hole.data()[p] ? wish.data()[p] + smooth.data()[p] : given.data()[p] ? 9 : -9;
  return largest(wish, noise, wanted, random);
}

/// Whether part of the upper shape touches what is outside the lower one.
bool touches(const Shape& upper, const Shape& lower, bool wraps) {
  std::size_t contacts = 0;
  const std::vector<Vec3i> boundary = boundaryOf(lower, wraps);
  for (const Vec3i& p : boundary) contacts += upper[p];
  return static_cast<double>(contacts) > 0.001 * static_cast<double>(boundary.size());
}

/// How far from a shape's outside the layer above goes, in cells, where it is a crust: nothing of
/// it lies deeper, and a part of the shape does. What lies beyond the example is neither.
std::optional<float> crustDepth(const Shape& upper, const Shape& lower, bool wraps) {
  const Vec3i& size = lower.size();
  const Array3D<float> depths = distanceTo(outsideOf(lower), wraps);
  const auto known = [&](const Vec3i& p) {  // how far away the nearest cell is that is not known
    const int flat = std::min({p.x + 1, p.y + 1, size.x - p.x, size.y - p.y});
    const int least = size.z == 1 ? flat : std::min({flat, p.z + 1, size.z - p.z});
    return wraps ? std::numeric_limits<float>::infinity() : static_cast<float>(least);
  };
  std::vector<float> ofUpper, ofLower;
  std::size_t at = 0;
  forEachCell(size, [&](const Vec3i& p) {
    const std::size_t cell = at++;
    if (!lower.data()[cell]) return;
    const float depth = depths.data()[cell], most = known(p);
    if (upper.data()[cell] && depth <= most) ofUpper.push_back(depth);
    ofLower.push_back(std::min(depth, most));
  });
  if (ofUpper.empty()) return std::nullopt;
  const auto last = ofUpper.begin() +
                    static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(ofUpper.size() - 1));
  std::ranges::nth_element(ofUpper, last);
  const auto deeper = std::ranges::count_if(ofLower, [&](float depth) { return depth > *last; });
  if (static_cast<double>(deeper) < 0.05 * static_cast<double>(ofLower.size())) return std::nullopt;
  return *last;
}

/// Where the layer above an optimized one may be, and where it begins (section 3.3).
struct Room {
  Shape mask, start;
};

/// Votes of the layer below change what the coarser resolution made where they agree by so much.
/// Those that are split break up its shapes and make their boundary a fifth too long.
constexpr float kAgreed = 0.75f;

/// `share` of the cells is the layer above's. Of what is not open the mask holds all.
Room roomAbove(const OptimizedShape& below, const ShapeExample& example, const Shape& above,
               const Shape* coarser, std::int64_t target, const Shape* open,
               const ShapeOptions& options, const Random& random) {
  const Shape& shape = below.shape;
  const Vec3i& size = shape.size();
  const PatchVotes votes =
      votesOf(above, example.patches, below.placed, size, options.exampleWraps);
  const float median = votes.medianWeight(below.placed.boundary);
  const bool apart = !touches(above, example.shape, options.exampleWraps);
  const std::vector<Vec3i> edge = boundaryOf(shape, true);
  const std::optional<float> crust = crustDepth(above, example.shape, options.exampleWraps);
  const Array3D<float> depths = crust ? distanceTo(outsideOf(shape), true) : Array3D<float>();
  Room room;
  // The strictest mask that has room for the layer.
  struct Strictness {
    float share;
    bool keepsOff, isCrust;
  };
  for (const auto& [share, keepsOff, isCrust] : {Strictness{0.15f, apart, crust.has_value()},
                                                 {0.0f, apart, crust.has_value()},
                                                 {0.0f, false, crust.has_value()},
                                                 {0.0f, false, false}}) {
    room.mask = shape;
    if (isCrust)
      for (std::size_t p = 0; p < shape.count(); ++p)
        room.mask.data()[p] &= depths.data()[p] <= *crust;
    for (std::size_t p = 0; p < shape.count(); ++p)
      if (votes.weight(p) >= 0.2f * median && votes.share(p) < share) room.mask.data()[p] = 0;
    if (keepsOff)
      for (const Vec3i& p : edge) room.mask[p] = 0;
    if (open)
      for (std::size_t p = 0; p < shape.count(); ++p)
        if (!open->data()[p]) room.mask.data()[p] = shape.data()[p];
    if (insideOf(room.mask) >= target) break;
  }
  if (!coarser) {
    Array3D<float> wish(size), covered(size);
    for (std::size_t p = 0; p < wish.count(); ++p) {
      covered.data()[p] = votes.weight(p);
      wish.data()[p] = !room.mask.data()[p] ? -1 : votes.weight(p) > 0 ? votes.share(p) : 0.4f;
    }
    room.start = largest(wish, covered, target, random);
  } else {
    room.start = enlarged(*coarser, size);
    for (std::size_t p = 0; p < shape.count(); ++p)
      if (votes.weight(p) >= 0.4f * median && std::abs(votes.share(p) - 0.5f) >= kAgreed - 0.5f)
        room.start.data()[p] = votes.share(p) > 0.5f;
  }
  for (std::size_t p = 0; p < shape.count(); ++p) room.start.data()[p] &= room.mask.data()[p];
  setArea(room.start, target, votes, {.mask = &room.mask, .open = open}, random.fork(1));
  return room;
}

int levelsFor(const Vec3i& example, const Vec3i& size, int wanted) {
  int side = std::min({example.x, example.y, size.x, size.y});
  if (example.z > 1) side = std::min({side, example.z, size.z});
  int levels = 1;
  for (; levels < wanted && side / 2 >= 8; side /= 2) ++levels;
  return levels;
}

/// The cells of a shape that are not open, set to what is given there.
void restore(Shape& shape, const Shape* open, const Shape& given) {
  if (!open) return;
  for (std::size_t p = 0; p < shape.count(); ++p)
    if (!open->data()[p]) shape.data()[p] = given.data()[p];
}

/// Makes the layers of one map, one after another.
class Layering {
 public:
  Layering(const LayerVolume& example, const Vec3i& size, const LayerOptions& options)
      : size_(size),
        options_(options),
        layers_(layerCount(example)),
        levels_(levelsFor(example.size(), size, options.shape.levels)),
        random_(options.seed, stream::kLayers),
        wanted_(pyramidsOf(example, layers_, levels_, random_)),
        below_(static_cast<std::size_t>(levels_)),
        belowExample_(static_cast<std::size_t>(levels_)) {
    if (options.hole) hole_ = holePyramid(*options.hole, levels_);
    if (options.paint) {
      levels_ = std::min(levels_, options.paintLevels);
      painted_ = pyramidsOf(*options.paint, layers_, levels_, random_.fork(50));
    }
    // A level has many times the cells of the next and takes most of the time.
    const double share = size.z > 1 ? 0.125 : 0.25;
    until_.assign(static_cast<std::size_t>(levels_) + 1, 1);
    for (std::size_t l = 1; l < until_.size(); ++l) until_[l] = until_[l - 1] * share;
  }

  SynthesizedLayers run(const Progress& progress) {
    SynthesizedLayers result{LayerVolume(size_, 1), {}};
    for (int i = 2; i <= layers_; ++i) {
      const Progress ofLayer = progress.part(static_cast<double>(i - 2) / (layers_ - 1),
                                             static_cast<double>(i - 1) / (layers_ - 1));
      const Shape made = layer(i, ofLayer, result.areaErrors);
      for (std::size_t p = 0; p < made.count(); ++p)
        if (made.data()[p]) result.map.data()[p] = static_cast<std::uint8_t>(i);
    }
    result.dealtExactly = dealtExactly_;
    return result;
  }

 private:
  Vec3i sizeAt(int level) const {
    Vec3i size;
    for (int axis = 0; axis < 3; ++axis) size[axis] = std::max(1, size_[axis] >> level);
    return size;
  }
  const Shape* holeAt(std::size_t level) const { return hole_.empty() ? nullptr : &hole_[level]; }

  /// How much longer a layer's boundary is in the example than what the resolution of painted
  /// layers shows of it.
  double roughness(std::size_t n, std::size_t level) const {
    const ShapePyramid& pyramid = wanted_[n];
    Shape coarse = pyramid[std::min(static_cast<std::size_t>(levels_), pyramid.size() - 1)];
    while (coarse.size().x * 3 / 2 < pyramid[level].size().x) {
      Vec3i size;
      for (int axis = 0; axis < 3; ++axis)
        size[axis] = std::min(2 * coarse.size()[axis], pyramid[level].size()[axis]);
      coarse = enlarged(coarse, size);
    }
    const bool wraps = options_.shape.exampleWraps;
    const auto shareOf = [&](const Shape& shape) {
      return static_cast<double>(boundaryCount(shape, wraps)) / static_cast<double>(shape.count());
    };
    const double shown = shareOf(coarse);
    return shown > 0 ? std::max(1.0, shareOf(pyramid[level]) / shown) : 1;
  }

  /// Where a layer begins on a level; `mask` becomes where it may be.
  Shape startOf(int i, std::size_t level, const Shape& coarser, const ShapeExample& likeness,
                ShapeLimits& limits, Shape& mask, const Random& random) {
    const std::size_t n = static_cast<std::size_t>(i - 2);
    const Vec3i size = sizeAt(static_cast<int>(level));
    const Shape& given = wanted_[n][level];
    if (!painted_.empty()) {
      Shape start = coarser.empty() ? painted_[n][level] : enlarged(coarser, size);
      if (i > 2) {
        mask = below_[level].shape;
        limits.mask = &mask;
        if (!touches(given, wanted_[n - 1][level], options_.shape.exampleWraps))
          for (const Vec3i& p : boundaryOf(mask, true)) mask[p] = 0;
        for (std::size_t p = 0; p < start.count(); ++p) start.data()[p] &= mask.data()[p];
      }
      limits.target = insideOf(painted_[n][level]);
      limits.boundary =
          static_cast<double>(boundaryCount(painted_[n][level], true)) * roughness(n, level);
      return start;
    }
    if (i == 2) {
      if (!coarser.empty()) {
        Shape start = enlarged(coarser, size);
        restore(start, limits.open, given);
        return start;
      }
      if (!limits.open) return randomShape(size, likeness.area, random);
      return randomShapeIn(*limits.open, given, wantedCells(given, likeness.area, limits), random);
    }
    const std::int64_t target =
        limits.open ? wantedCells(given, likeness.area, limits)
                    : cellsOf(likeness.area, static_cast<std::size_t>(volume(size)));
    Room room =
        roomAbove(below_[level], belowExample_[level], given, coarser.empty() ? nullptr : &coarser,
                  target, limits.open, options_.shape, random);
    mask = std::move(room.mask);
    limits.mask = &mask;
    restore(room.start, limits.open, given);
    return std::move(room.start);
  }

  Shape layer(int i, const Progress& progress, std::vector<double>& areaErrors) {
    const std::size_t n = static_cast<std::size_t>(i - 2);
    const Random draws = random_.fork(static_cast<std::uint64_t>(100 + i));
    const bool joint = options_.shape.joint && i > 2;
    Shape coarser;
    std::int64_t target = 0;
    for (int l = levels_ - 1; l >= 0; --l) {
      const auto level = static_cast<std::size_t>(l);
      const Random own = draws.fork(level);
      ShapeExample likeness =
          shapeExample(wanted_[n][level], joint ? &wanted_[n - 1][level] : nullptr, holeAt(level),
                       options_.shape, own.fork(1));
      ShapeLimits limits{.open = holeAt(level)};
      if (joint) limits.below = &below_[level].shape;
      Shape mask;
      Shape start = startOf(i, level, coarser, likeness, limits, mask, own.fork(2));
      target = wantedCells(start, likeness.area, limits);
      OptimizedShape made =
          optimizeShape(std::move(start), likeness, limits, options_.shape, own.fork(3),
                        progress.part(until_[level + 1], until_[level]));
      dealtExactly_ &= made.dealtExactly;
      coarser = made.shape;
      below_[level] = std::move(made);
      belowExample_[level] = std::move(likeness);
    }
    areaErrors.push_back(static_cast<double>(insideOf(coarser) - target) /
                         static_cast<double>(coarser.count()));
    return coarser;
  }

  Vec3i size_;
  const LayerOptions& options_;
  int layers_, levels_;
  Random random_;
  std::vector<ShapePyramid> wanted_, painted_;
  ShapePyramid hole_;
  std::vector<OptimizedShape> below_;
  bool dealtExactly_ = true;
  std::vector<ShapeExample> belowExample_;
  std::vector<double> until_;
};

}  // namespace

SynthesizedLayers synthesizeLayers(const LayerVolume& example, const Vec3i& size,
                                   const LayerOptions& options, const Progress& progress) {
  return Layering(example, size, options).run(progress);
}

void ControlMaps::soften(float share) {
  for (Array3D<float>* map : {&example, &result}) {
    for (float& value : map->values()) {
      // The top of the last layer is its own.
      const float middle = std::min(std::floor(value), top) + 0.5f;
      value = middle + share * (value - middle);
    }
  }
}

ControlMaps controlMaps(const LayerVolume& example, bool exampleWraps, const LayerVolume& result,
                        bool resultWraps, const Progress& progress) {
  const int layers = layerCount(example);
  ControlMaps maps{Array3D<float>(example.size()), Array3D<float>(result.size()),
                   static_cast<float>(layers)};
  for (int i = 1; i <= layers; ++i) {
    progress.report("smoothing layers", static_cast<double>(i - 1) / layers);
    float mostDown = 0, mostUp = 0;  // of the example's distances in this layer
    for (const bool ofExample : {true, false}) {
      const LayerVolume& map = ofExample ? example : result;
      float* control = (ofExample ? maps.example : maps.result).data();
      const bool wraps = ofExample ? exampleWraps : resultWraps;
      Shape lower(map.size());
      for (std::size_t p = 0; p < map.count(); ++p) lower.data()[p] = map.data()[p] < i;
      const Array3D<float> toLower = distanceTo(lower, wraps);
      const Array3D<float> toHigher = distanceTo(layerShape(map, i + 1), wraps);
      const float *down = toLower.data(), *up = toHigher.data();
      const bool bottom = i == 1, top = i == layers;
      if (ofExample) {
        for (std::size_t p = 0; p < map.count(); ++p) {
          if (map.data()[p] != i) continue;
          if (std::isfinite(down[p])) mostDown = std::max(mostDown, down[p]);
          if (std::isfinite(up[p])) mostUp = std::max(mostUp, up[p]);
        }
      }
      for (std::size_t p = 0; p < map.count(); ++p) {
        if (map.data()[p] != i) continue;
        const float toDown = std::min(down[p], mostDown), toUp = std::min(up[p], mostUp);
        float within = 0.5f;
        if (bottom) {
          if (mostUp > 0) within = 1 - toUp / mostUp;
        } else if (top) {
          if (mostDown > 0) within = toDown / mostDown;
        } else if (toDown + toUp > 0) {
          within = toDown / (toDown + toUp);
        }
        control[p] = static_cast<float>(i) + within;
      }
    }
  }
  return maps;
}

LayerVolume withStrips(const LayerVolume& painted, const LayerVolume& example) {
  LayerVolume layers = painted;
  for (int i = layerCount(example); i > 2; --i) {
    // How far the example's contour of this layer is from that of the one below, in the middle.
    Shape outside(example.size());
    for (std::size_t p = 0; p < example.count(); ++p) outside.data()[p] = example.data()[p] < i - 1;
    const Array3D<float> toOutside = distanceTo(outside, false);
    std::vector<float> widths;
    for (const Vec3i& p : boundaryOf(layerShape(example, i), false)) widths.push_back(toOutside[p]);
    if (widths.empty()) continue;
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::ranges::nth_element(widths, middle);
    const float width = std::isfinite(*middle) ? std::max(1.0f, *middle) : 1.0f;
    // Only around contours that skip a layer.
    Shape skipping(layers.size());
    std::size_t at = 0;
    forEachCell(layers.size(), [&](const Vec3i& p) {
      const std::size_t cell = at++;
      if (layers.data()[cell] < i) return;
      forEachBeside(layers.size(), true, p, cell, [&](std::size_t other) {
        if (layers.data()[other] < i - 1) skipping.data()[cell] = 1;
      });
    });
    const Array3D<float> toSkipping = distanceTo(skipping, true);
    for (std::size_t p = 0; p < layers.count(); ++p)
      if (layers.data()[p] < i - 1 && toSkipping.data()[p] <= width)
        layers.data()[p] = static_cast<std::uint8_t>(i - 1);
  }
  return layers;
}

}  // namespace exemplar
