// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/shape_optimization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/parallel.h"

namespace exemplar {
namespace {

/// Certainty below which a pixel stays as it is, in medians of the weights on the boundary.
constexpr std::array<float, 10> kThresholds{0.01f, 0.03f, 0.06f, 0.10f, 0.14f,
                                            0.18f, 0.23f, 0.3f,  0.4f,  0.5f};

std::int64_t insideOf(const Shape& shape) {
  std::int64_t inside = 0;
  for (const std::uint8_t v : shape.values()) inside += v;
  return inside;
}

/// Pixels of one value beside pixels of the other: the ring along which a shape grows (1) or
/// shrinks (0).
std::vector<std::size_t> ringOf(const Shape& shape, bool grows, const Shape* mask) {
  constexpr Pixel kSteps[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  std::vector<std::size_t> ring;
  for (int y = 0; y < shape.height(); ++y) {
    for (int x = 0; x < shape.width(); ++x) {
      const std::size_t p = shape.index(x, y);
      if ((shape[p] != 0) == grows || (grows && mask && !(*mask)[p])) continue;
      for (const Pixel& step : kSteps) {
        if ((shape[shape.wrapped(x + step.x, y + step.y)] != 0) == grows) {
          ring.push_back(p);
          break;
        }
      }
    }
  }
  return ring;
}

std::vector<float> falloff(int side) {
  std::vector<float> weights;
  const double sigma = side / 2.0;
  for (int dy = -side / 2; dy <= side / 2; ++dy)
    for (int dx = -side / 2; dx <= side / 2; ++dx)
      weights.push_back(static_cast<float>(std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma))));
  return weights;
}

/// The pixels that are certain enough, as votes want them; the others as they are.
Shape majority(const Shape& shape, const PatchVotes& votes, float threshold, const Shape* mask) {
  Shape changed = shape;
  for (std::size_t p = 0; p < shape.count(); ++p) {
    if (votes.weight(p) >= threshold && votes.weight(p) > 0)
      changed[p] = votes.inside[p] > votes.outside[p];
    if (mask && !(*mask)[p]) changed[p] = 0;
  }
  return changed;
}

/// The majority of 3 x 3 pixels: a shorter boundary.
Shape smoothed(const Shape& shape, const Shape* mask) {
  Shape smooth(shape.width(), shape.height());
  for (int y = 0; y < shape.height(); ++y) {
    for (int x = 0; x < shape.width(); ++x) {
      const std::size_t p = shape.index(x, y);
      if (mask && !(*mask)[p]) continue;
      int inside = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) inside += shape[shape.wrapped(x + dx, y + dy)];
      smooth[p] = inside >= 5;
    }
  }
  return smooth;
}

double boundaryShare(const Shape& shape) {
  return static_cast<double>(boundaryOf(shape, true).size()) / static_cast<double>(shape.count());
}

/// What votes make of a shape: with the threshold of certainty, smoothed or not, that gives the
/// example's share of boundary most nearly.
Shape adjusted(const Shape& shape, const PatchVotes& votes, float median,
               const ShapeExample& example, const Shape* mask, const Random& random,
               const Progress& progress) {
  const auto target =
      static_cast<std::int64_t>(std::llround(example.area * static_cast<double>(shape.count())));
  std::array<Shape, 2 * kThresholds.size()> candidates;
  std::array<double, candidates.size()> errors{};
  parallelFor(0, candidates.size(), 1, [&](std::size_t first, std::size_t last) {
    progress.check();
    for (std::size_t c = first; c < last; ++c) {
      Shape changed = majority(shape, votes, kThresholds[c / 2] * median, mask);
      if (c % 2 == 1) changed = smoothed(changed, mask);
      removeSmall(changed, example.smallestInside, example.smallestOutside, true);
      if (mask)
        for (std::size_t p = 0; p < changed.count(); ++p) changed[p] &= (*mask)[p];
      setArea(changed, target, votes, mask, random);
      errors[c] = std::abs(boundaryShare(changed) - example.boundary);
      candidates[c] = std::move(changed);
    }
  });
  return std::move(
      candidates[static_cast<std::size_t>(std::ranges::min_element(errors) - errors.begin())]);
}

}  // namespace

ShapeExample shapeExample(const Shape& shape, const ShapeOptions& options, const Random& random) {
  ShapeExample example;
  example.shape = shape;
  example.area = areaOf(shape);
  std::vector<Pixel> all = boundaryOf(shape, options.exampleWraps);
  example.boundary = static_cast<double>(all.size()) / static_cast<double>(shape.count());
  const auto smallest = [&](bool inside) {
    const std::vector<std::uint32_t> sizes = componentSizes(shape, inside, options.exampleWraps);
    return sizes.empty() ? 0 : *std::ranges::min_element(sizes);
  };
  example.smallestInside = smallest(true);
  example.smallestOutside = smallest(false);
  if (!options.exampleWraps) {
    const int half = options.patch / 2;
    std::vector<Pixel> whole = all;
    std::erase_if(whole, [&](const Pixel& p) {
      return !shape.contains(p.x - half, p.y - half) || !shape.contains(p.x + half, p.y + half);
    });
    if (4 * whole.size() >= all.size()) all = std::move(whole);
  }
  if (all.size() > kMostExamplePatches) {
    for (std::size_t n = 0; n < kMostExamplePatches; ++n)
      std::swap(all[n], all[n + random.below(static_cast<std::uint32_t>(all.size() - n), n)]);
    all.resize(kMostExamplePatches);
  }
  example.patches = BoundaryPatches(shape, all, options.patch, options.turns, options.exampleWraps);
  return example;
}

float PatchVotes::medianWeight(std::span<const Pixel> pixels) const {
  if (pixels.empty()) return 0;
  std::vector<float> weights;
  for (const Pixel& p : pixels) weights.push_back(weight(inside.index(p.x, p.y)));
  const auto middle = weights.begin() + static_cast<std::ptrdiff_t>(weights.size() / 2);
  std::ranges::nth_element(weights, middle);
  return *middle;
}

PatchVotes votesOf(const Shape& shape, const BoundaryPatches& patches, const PlacedPatches& placed,
                   int width, int height, bool exampleWraps) {
  PatchVotes votes{Grid<float>(width, height), Grid<float>(width, height)};
  const int half = patches.side() / 2;
  const std::vector<float> weights = falloff(patches.side());
  for (std::size_t s = 0; s < placed.boundary.size(); ++s) {
    const Pixel& at = placed.boundary[s];
    const PatchMatch2D& match = placed.matches[s];
    const Pixel& from = patches.center(match.patch);
    const float certainty = 1.0f / (1.0f + static_cast<float>(match.distance));
    const int symmetry = patches.symmetry(match.turn);
    std::size_t n = 0;
    for (int dy = -half; dy <= half; ++dy) {
      for (int dx = -half; dx <= half; ++dx, ++n) {
        const Pixel step = turnedStep({dx, dy}, symmetry);
        const int x = from.x + step.x, y = from.y + step.y;
        if (!exampleWraps && !shape.contains(x, y)) continue;
        Grid<float>& side = shape[shape.wrapped(x, y)] ? votes.inside : votes.outside;
        side[side.wrapped(at.x + dx, at.y + dy)] += certainty * weights[n];
      }
    }
  }
  return votes;
}

bool setArea(Shape& shape, std::int64_t target, const PatchVotes& votes, const Shape* mask,
             const Random& random) {
  for (std::int64_t missing = target - insideOf(shape); missing != 0;) {
    const bool grows = missing > 0;
    std::vector<std::size_t> ring = ringOf(shape, grows, mask);
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
    for (const std::size_t p : ring) shape[p] = grows;
    missing -=
        grows ? static_cast<std::int64_t>(ring.size()) : -static_cast<std::int64_t>(ring.size());
  }
  return true;
}

OptimizedShape optimizeShape(Shape start, const ShapeExample& example, const Shape* mask,
                             const ShapeOptions& options, const Random& random,
                             const Progress& progress) {
  OptimizedShape result;
  result.shape = std::move(start);
  Shape& shape = result.shape;
  const int width = shape.width(), height = shape.height();
  if (example.patches.count() == 0) return result;
  for (int n = 0; n < options.iterations; ++n) {
    const Progress part = progress.part(static_cast<double>(n) / options.iterations,
                                        static_cast<double>(n + 1) / options.iterations);
    part.report("matching boundaries", 0);
    const Random draws = random.fork(static_cast<std::uint64_t>(n));
    PlacedPatches placed;
    placed.boundary = boundaryOf(shape, true);
    if (placed.boundary.empty()) break;
    const BoundaryPatches patches(shape, placed.boundary, options.patch, 1, true);
    placed.matches = assignPatches(
        patches, example.patches, fairUses(patches.count(), example.patches.count(), draws.fork(0)),
        options.assignment, draws.fork(1), part);
    const PatchVotes votes =
        votesOf(example.shape, example.patches, placed, width, height, options.exampleWraps);
    const float median = votes.medianWeight(placed.boundary);
    Shape best = adjusted(shape, votes, median, example, mask, draws.fork(2), part);
    std::size_t changes = 0;
    for (std::size_t p = 0; p < shape.count(); ++p) changes += best[p] != shape[p];
    shape = std::move(best);
    result.placed = std::move(placed);
    ++result.iterations;
    if (static_cast<double>(changes) < options.settled * static_cast<double>(shape.count())) break;
  }
  progress.report("matching boundaries", 1);
  return result;
}

}  // namespace exemplar
