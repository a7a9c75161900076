// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/shape_optimization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/cells.h"
#include "core/parallel.h"
#include "core/simd.h"
#include "maps/distance_transform.h"

namespace exemplar {
namespace {

/// Certainty below which a cell stays as it is, in medians of the weights on the boundary.
constexpr std::array<float, 10> kThresholds{0.01f, 0.03f, 0.06f, 0.10f, 0.14f,
                                            0.18f, 0.23f, 0.3f,  0.4f,  0.5f};

bool isOpen(const ShapeLimits& limits, std::size_t p) {
  return !limits.open || limits.open->data()[p];
}
bool mayBeInside(const ShapeLimits& limits, std::size_t p) {
  return !limits.mask || limits.mask->data()[p];
}

/// Cells of one value beside cells of the other: the ring along which a shape grows (1) or shrinks
/// (0).
std::vector<std::size_t> ringOf(const Shape& shape, bool grows, const ShapeLimits& limits) {
  std::vector<std::size_t> ring;
  forEachEdgeCell(shape, !grows, true, [&](const Vec3i&, std::size_t cell) {
    if (isOpen(limits, cell) && (!grows || mayBeInside(limits, cell))) ring.push_back(cell);
  });
  return ring;
}

/// Where there is no ring: the cell that votes want most to change; none where none may.
std::vector<std::size_t> seedOf(const Shape& shape, bool grows, const PatchVotes& votes,
                                const ShapeLimits& limits, const Random& random) {
  std::vector<std::size_t> seed;
  std::pair<float, std::uint64_t> most{-1, 0};
  for (std::size_t p = 0; p < shape.count(); ++p) {
    if ((shape.data()[p] != 0) == grows || !isOpen(limits, p)) continue;
    if (grows && !mayBeInside(limits, p)) continue;
    const std::pair wish{grows ? votes.share(p) : 1 - votes.share(p), random.bits(p)};
    if (wish <= most) continue;
    most = wish;
    seed = {p};
  }
  return seed;
}

/// Of one row: the cells that are certain enough, as votes want them; the others as they are.
EXEMPLAR_MULTIVERSION
void decideRow(const float* inside, const float* outside, float threshold, int length,
               std::uint8_t* shape) {
  for (int x = 0; x < length; ++x) {
    const float weight = inside[x] + outside[x];
    const bool sure = (weight >= threshold) & (weight > 0);
    shape[x] = static_cast<std::uint8_t>(sure ? inside[x] > outside[x] : shape[x] != 0);
  }
}

/// The cells that are certain enough, as votes want them; the others as they are. Limits are not
/// heeded.
Shape majority(const Shape& shape, const PatchVotes& votes, float threshold) {
  Shape changed = shape;
  const int length = shape.size().x;
  for (std::size_t p = 0; p < shape.count(); p += static_cast<std::size_t>(length))
    decideRow(votes.inside.data() + p, votes.outside.data() + p, threshold, length,
              changed.data() + p);
  return changed;
}

EXEMPLAR_MULTIVERSION
void addRows(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c, int length,
             std::uint8_t* sums) {
  for (int x = 0; x < length; ++x) sums[x] = static_cast<std::uint8_t>(a[x] + b[x] + c[x]);
}

/// The sums of three neighbors along an axis, on the torus.
Array3D<std::uint8_t> summedAlong(const Array3D<std::uint8_t>& values, int axis) {
  const Vec3i& size = values.size();
  Array3D<std::uint8_t> sums(size);
  const Vec3i step{0, axis == 1, axis == 2};
  forEachCell(Vec3i{1, size.y, size.z}, [&](const Vec3i& p) {
    const std::uint8_t* row = &values[p];
    std::uint8_t* to = &sums[p];
    const int n = size.x;
    if (axis > 0) {
      addRows(&values[wrappedPlace(p - step, size)], row, &values[wrappedPlace(p + step, size)], n,
              to);
      return;
    }
    const auto at = [&](int x) { return row[wrappedCoordinate(x, n)]; };
    to[0] = static_cast<std::uint8_t>(at(-1) + at(0) + at(1));
    to[n - 1] = static_cast<std::uint8_t>(at(n - 2) + at(n - 1) + at(n));
    if (n > 2) addRows(row, row + 1, row + 2, n - 2, to + 1);
  });
  return sums;
}

void restoreClosed(const Shape& was, const ShapeLimits& limits, Shape& shape) {
  if (limits.mask)
    for (std::size_t p = 0; p < shape.count(); ++p)
      if (!limits.mask->data()[p]) shape.data()[p] = 0;
  if (limits.open)
    for (std::size_t p = 0; p < shape.count(); ++p)
      if (!limits.open->data()[p]) shape.data()[p] = was.data()[p];
}

/// The majority of the 3 x 3 (in space 3 x 3 x 3) cells: a shorter boundary. `wide`, flat shapes
/// only: of the 5 x 5, nearer ones counting more, which goes on where that of 3 x 3 changes
/// nothing.
void smooth(Shape& shape, bool wide) {
  const bool flat = shape.size().z == 1;
  Array3D<std::uint8_t> sums = summedAlong(summedAlong(shape, 0), 1);
  if (!flat) sums = summedAlong(sums, 2);
  if (wide) sums = summedAlong(summedAlong(sums, 0), 1);
  const int most = wide ? 41 : flat ? 5 : 14;
  for (std::size_t p = 0; p < shape.count(); ++p) shape.data()[p] = sums.data()[p] >= most;
}

/// Removes what is smaller than anything in the example, and the smallest of more components than
/// the example has, unless nothing would be left. Of a shape that was painted so many stay as there
/// are.
void removeSpecks(Shape& shape, const ShapeExample& example, bool isPainted) {
  Shape without = shape;
  const auto limits = [&](const ShapeExample::Components& components) {
    ComponentLimits stay{.least = components.smallest};
    if (!isPainted) stay.most = components.mostIn(shape.count());
    return stay;
  };
  removeSmall(without, limits(example.inside), limits(example.outside), true);
  const std::int64_t left = insideOf(without);
  if (left > 0 && left < static_cast<std::int64_t>(shape.count())) shape = std::move(without);
}

/// The radius of a ball of about so many cells.
float radiusOf(std::uint32_t cells, bool flat) {
  const double ofUnit = flat ? 3.1416 : 4.1888;
  return static_cast<float>(std::pow(std::max(1u, cells) / ofUnit, flat ? 1 / 2.0 : 1 / 3.0) + 0.5);
}

/// Sets the cells of a ball, on the torus, as far as they may change.
void placeBall(Shape& shape, const Vec3i& center, float radius, bool inside,
               const ShapeLimits& limits) {
  const int reach = static_cast<int>(radius), depth = shape.size().z == 1 ? 0 : reach;
  const CellBox box{{-reach, -reach, -depth}, {reach + 1, reach + 1, depth + 1}};
  forEachCell(box, [&](const Vec3i& step) {
    const auto squared = static_cast<float>(step.x * step.x + step.y * step.y + step.z * step.z);
    const std::size_t p = shape.index(wrappedPlace(center + step, shape.size()));
    if (squared > radius * radius || !isOpen(limits, p)) return;
    if (!inside || mayBeInside(limits, p)) shape.data()[p] = inside;
  });
}

/// The cell that is farthest from the other side, of those that may change sides to `inside`, if it
/// lies deeper than `deepest`.
std::optional<Vec3i> tooDeep(const Array3D<float>& depths, float deepest, bool inside,
                             const ShapeLimits& limits) {
  std::optional<Vec3i> farthest;
  std::size_t at = 0;
  forEachCell(depths.size(), [&](const Vec3i& p) {
    const std::size_t cell = at++;
    const float depth = depths.data()[cell];
    if (depth <= deepest || !std::isfinite(depth) || !isOpen(limits, cell)) return;
    if (inside && !mayBeInside(limits, cell)) return;
    deepest = depth;
    farthest = p;
  });
  return farthest;
}

/// Where a shape, or what is around it, is deeper than it ever is in the example: begins a
/// component of the other side there, as large as the example's smallest, if that fits and there
/// may be more of them. Patches say nothing of what lies farther from a boundary than they reach.
/// Only what a patch sees whole, on resolutions where that is so: what is larger would stay the
/// ball that it began as. Flat shapes only: in space, where few levels have room for a patch, balls
/// fuse.
void breakUpDepths(Shape& shape, const ShapeExample& example, const ShapeLimits& limits,
                   int patch) {
  if (shape.size().z > 1) return;
  constexpr float kRounding = 1;             // of where cells' centers lie, in the example and here
  for (const bool inside : {true, false}) {  // the side that is begun
    const ShapeExample::Components& begun = inside ? example.inside : example.outside;
    const float deepest = (inside ? example.outside : example.inside).deepest + kRounding;
    const float radius = radiusOf(begun.smallest, shape.size().z == 1);
    if (!std::isfinite(deepest) || radius >= deepest || 2 * radius > static_cast<float>(patch))
      continue;
    const std::size_t most = begun.mostIn(shape.count());
    for (std::size_t count = componentSizes(shape, inside, true).size(); count < most; ++count) {
      const Array3D<float> depths = distanceTo(inside ? shape : outsideOf(shape), true);
      const std::optional<Vec3i> center = tooDeep(depths, deepest, inside, limits);
      if (!center) break;
      placeBall(shape, *center, radius, inside, limits);
    }
  }
}

/// One way to change a shape as votes want it.
struct Adjustment {
  float threshold = 0;
  int smoothings = 0;
  bool wide = false;  ///< of the smoothings
};

std::vector<Adjustment> adjustmentsFor(const ShapeOptions& options, float median, bool flat) {
  std::vector<Adjustment> all;
  if (options.certainty == CertaintyKind::Area) {
    // The paper's interval, evenly in logarithms.
    for (int n = 0; n <= 20; ++n)
      all.push_back({static_cast<float>(std::pow(10.0, -7 + n * 0.25))});
    return all;
  }
  for (std::size_t n = 0; n < kThresholds.size(); n += flat ? 1 : 3)
    for (const int smoothings : {0, 1}) all.push_back({kThresholds[n] * median, smoothings});
  // Where patches disagree the boundary is too long even so.
  for (std::size_t n = 0; n < kThresholds.size(); n += flat ? 3 : 6)
    for (const int smoothings : flat ? std::array{1, 3} : std::array{2, 3})
      all.push_back({kThresholds[n] * median, smoothings, flat});
  return all;
}

/// What votes make of a shape: of several adjustments the one that gives the example's share of
/// boundary (or, as in the paper, of area) most nearly.
Shape adjusted(const Shape& shape, const PatchVotes& votes, float median,
               const ShapeExample& example, const ShapeLimits& limits, const ShapeOptions& options,
               const Random& random, const Progress& progress) {
  const std::int64_t target = wantedCells(shape, example.area, limits);
  const std::int64_t open =
      limits.open ? insideOf(*limits.open) : static_cast<std::int64_t>(shape.count());
  const double boundary = limits.boundary.value_or(example.boundary * static_cast<double>(open));
  const bool byArea = options.certainty == CertaintyKind::Area;
  const std::vector<Adjustment> all = adjustmentsFor(options, median, shape.size().z == 1);
  std::vector<Shape> candidates(all.size());
  std::vector<double> errors(all.size());
  parallelFor(0, all.size(), 1, [&](std::size_t first, std::size_t last) {
    progress.check();
    for (std::size_t c = first; c < last; ++c) {
      Shape changed = majority(shape, votes, all[c].threshold);
      restoreClosed(shape, limits, changed);
      if (byArea) {
        errors[c] = std::abs(static_cast<double>(insideOf(changed) - target));
      } else {
        for (int n = 0; n < all[c].smoothings; ++n) {
          smooth(changed, all[c].wide);
          restoreClosed(shape, limits, changed);
        }
        removeSpecks(changed, example, limits.target.has_value());
        restoreClosed(shape, limits, changed);
        setArea(changed, target, votes, limits, random);
        errors[c] =
            std::abs(static_cast<double>(boundaryCount(changed, true, limits.open)) - boundary);
      }
      candidates[c] = std::move(changed);
    }
  });
  return std::move(
      candidates[static_cast<std::size_t>(std::ranges::min_element(errors) - errors.begin())]);
}

/// Boundary cells whose patches reach cells that may change.
void keepNearOpen(std::vector<Vec3i>& boundary, const Shape& open, int side) {
  const Vec3i& size = open.size();
  const int half = side / 2, depth = patchDepth(size, side) / 2;
  std::erase_if(boundary, [&](const Vec3i& c) {
    for (int dz = -depth; dz <= depth; ++dz)
      for (int dy = -half; dy <= half; ++dy)
        for (int dx = -half; dx <= half; ++dx)
          if (open[wrappedPlace(c + Vec3i{dx, dy, dz}, size)]) return false;
    return true;
  });
}

}  // namespace

std::vector<Vec3i> servingCenters(std::vector<Vec3i> all, const Vec3i& size, const Shape* unknown,
                                  const ShapeOptions& options, const Random& random) {
  const int half = options.patch / 2, depth = patchDepth(size, options.patch) / 2;
  const Vec3i reach{half, half, depth};
  const Shape extent(size);
  if (unknown) {
    std::erase_if(all, [&](const Vec3i& p) {
      const CellBox box = CellBox{p - reach, p + reach + Vec3i{1, 1, 1}} & CellBox::of(size);
      bool touches = false;
      forEachCell(box, [&](const Vec3i& q) { touches |= (*unknown)[q] != 0; });
      return touches;
    });
  }
  if (!options.exampleWraps) {
    std::vector<Vec3i> whole = all;
    std::erase_if(whole, [&](const Vec3i& p) {
      return !extent.contains(p - reach) || !extent.contains(p + reach);
    });
    if (4 * whole.size() >= all.size()) all = std::move(whole);
  }
  if (all.size() > kMostExamplePatches) {
    for (std::size_t n = 0; n < kMostExamplePatches; ++n)
      std::swap(all[n], all[n + random.below(static_cast<std::uint32_t>(all.size() - n), n)]);
    all.resize(kMostExamplePatches);
  }
  return all;
}

std::size_t ShapeExample::Components::mostIn(std::size_t cells) const {
  return static_cast<std::size_t>(std::ceil(perCell * static_cast<double>(cells)));
}

ShapeExample shapeExample(const Shape& shape, const Shape* below, const Shape* unknown,
                          const ShapeOptions& options, const Random& random) {
  ShapeExample example;
  example.shape = shape;
  Shape known(shape.size(), 1);
  if (unknown)
    for (std::size_t p = 0; p < known.count(); ++p) known.data()[p] = !unknown->data()[p];
  const auto cells = static_cast<double>(std::max<std::int64_t>(1, insideOf(known)));
  example.area = static_cast<double>(insideOf(shape, &known)) / cells;
  example.boundary =
      static_cast<double>(boundaryCount(shape, options.exampleWraps, &known)) / cells;
  const auto components = [&](bool inside) {
    const std::vector<std::uint32_t> sizes = componentSizes(shape, inside, options.exampleWraps);
    const Array3D<float> depths =
        distanceTo(inside ? outsideOf(shape) : shape, options.exampleWraps);
    return ShapeExample::Components{
        sizes.empty() ? 0 : *std::ranges::min_element(sizes),
        static_cast<double>(sizes.size()) / static_cast<double>(shape.count()),
        *std::ranges::max_element(depths.values())};
  };
  example.inside = components(true);
  example.outside = components(false);
  const std::vector<Vec3i> centers = servingCenters(boundaryOf(shape, options.exampleWraps),
                                                    shape.size(), unknown, options, random);
  ShapePlanes planes(shape);
  if (below) planes.shapes.push_back(below);
  example.patches =
      BoundaryPatches(planes, centers, options.patch, options.turns, options.exampleWraps);
  return example;
}

std::vector<Vec3i> matchedCenters(std::vector<Vec3i> boundary, const Vec3i& size) {
  constexpr std::size_t kAllOf = 8000;
  if (size.z == 1 || boundary.size() <= kAllOf) return boundary;
  std::vector<Vec3i> some;
  for (const Vec3i& p : boundary)
    if ((p.x + 2 * p.y + 3 * p.z) % 4 == 0) some.push_back(p);
  return some.empty() ? boundary : some;
}

float PatchVotes::medianWeight(std::span<const Vec3i> cells) const {
  if (cells.empty()) return 0;
  std::vector<float> weights;
  for (const Vec3i& p : cells) weights.push_back(weight(inside.index(p)));
  const auto middle = weights.begin() + static_cast<std::ptrdiff_t>(weights.size() / 2);
  std::ranges::nth_element(weights, middle);
  return *middle;
}

PatchVotes votesOf(const Shape& shape, const BoundaryPatches& patches, const PlacedPatches& placed,
                   const Vec3i& size, bool exampleWraps) {
  PatchVotes votes{Array3D<float>(size), Array3D<float>(size)};
  float* sides[] = {votes.outside.data(), votes.inside.data()};
  const std::uint8_t* inside = shape.data();
  forEachPasted(patches, placed, size, shape.size(), exampleWraps,
                [&](std::size_t cell, std::size_t from, float weight) {
                  sides[inside[from] != 0][cell] += weight;
                });
  return votes;
}

std::int64_t wantedCells(const Shape& shape, double share, const ShapeLimits& limits) {
  if (limits.target) return *limits.target;
  std::int64_t open = 0, closedInside = 0;
  for (std::size_t p = 0; p < shape.count(); ++p) {
    open += isOpen(limits, p);
    closedInside += !isOpen(limits, p) && shape.data()[p];
  }
  return closedInside + static_cast<std::int64_t>(std::llround(share * static_cast<double>(open)));
}

bool setArea(Shape& shape, std::int64_t target, const PatchVotes& votes, const ShapeLimits& limits,
             const Random& random) {
  for (std::int64_t missing = target - insideOf(shape); missing != 0;) {
    const bool grows = missing > 0;
    std::vector<std::size_t> ring = ringOf(shape, grows, limits);
    if (ring.empty()) ring = seedOf(shape, grows, votes, limits, random);
    if (ring.empty()) return false;
    const auto count = static_cast<std::size_t>(std::abs(missing));
    if (ring.size() > count) {
      std::vector<std::pair<std::pair<float, std::uint64_t>, std::size_t>> ranked;
      for (const std::size_t p : ring)
        ranked.push_back({{grows ? -votes.share(p) : votes.share(p), random.bits(p)}, p});
      std::ranges::nth_element(ranked, ranked.begin() + static_cast<std::ptrdiff_t>(count));
      ring.clear();
      for (std::size_t n = 0; n < count; ++n) ring.push_back(ranked[n].second);
    }
    for (const std::size_t p : ring) shape.data()[p] = grows;
    missing -=
        grows ? static_cast<std::int64_t>(ring.size()) : -static_cast<std::int64_t>(ring.size());
  }
  return true;
}

OptimizedShape optimizeShape(Shape start, const ShapeExample& example, const ShapeLimits& limits,
                             const ShapeOptions& options, const Random& random,
                             const Progress& progress) {
  OptimizedShape result;
  result.shape = std::move(start);
  Shape& shape = result.shape;
  const Vec3i size = shape.size();
  if (example.patches.count() == 0) return result;
  for (int n = 0; n < options.iterations; ++n) {
    const Progress part = progress.part(static_cast<double>(n) / options.iterations,
                                        static_cast<double>(n + 1) / options.iterations);
    part.report("matching boundaries", 0);
    const Random draws = random.fork(static_cast<std::uint64_t>(n));
    if (!limits.target && options.certainty == CertaintyKind::Boundary)
      breakUpDepths(shape, example, limits, options.patch);
    PlacedPatches placed;
    placed.boundary = matchedCenters(boundaryOf(shape, true), size);
    if (limits.open) keepNearOpen(placed.boundary, *limits.open, options.patch);
    if (placed.boundary.empty()) break;
    ShapePlanes planes(shape);
    if (limits.below) planes.shapes.push_back(limits.below);
    const BoundaryPatches patches(planes, placed.boundary, options.patch, 1, true);
    Assignment dealt = assignPatches(
        patches, example.patches, fairUses(patches.count(), example.patches.count(), draws.fork(0)),
        options.assignment, draws.fork(1), part);
    placed.matches = std::move(dealt.matches);
    result.dealtExactly &= dealt.kind == AssignmentKind::Exact;
    const PatchVotes votes =
        votesOf(example.shape, example.patches, placed, size, options.exampleWraps);
    const float median = votes.medianWeight(placed.boundary);
    Shape best = adjusted(shape, votes, median, example, limits, options, draws.fork(2), part);
    std::size_t changes = 0;
    for (std::size_t p = 0; p < shape.count(); ++p) changes += best.data()[p] != shape.data()[p];
    shape = std::move(best);
    result.placed = std::move(placed);
    ++result.iterations;
    const auto boundary = static_cast<double>(boundaryCount(shape, true, limits.open));
    if (static_cast<double>(changes) < options.settled * boundary) break;
  }
  progress.report("matching boundaries", 1);
  return result;
}

}  // namespace exemplar
