// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/terrain.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "maps/drainage.h"
#include "measure/distribution.h"
#include "measure/spectrum.h"
#include "measure/terrain_copies.h"
#include "measure/turned_copies.h"

namespace exemplar {
namespace {

constexpr std::size_t kSamples = 1'000'000;
constexpr int kSmallestHalf = 32;
constexpr int kLeastSpectrum = 32, kMostSpectrum = 512;
constexpr double kSquareKilometer = 1e6;
constexpr double kFlat = 0.02;  ///< of the mean slope
constexpr std::size_t kRowsAtOnce = 32;
constexpr std::size_t kShapes = 400, kShapesAmong = 1000;

void check(const Grid<float>& heights, const TerrainOptions& options) {
  if (!(options.cellSize > 0 && std::isfinite(options.cellSize)))
    throw InputError("`cell-size` is " + std::to_string(options.cellSize) + "; it must be > 0");
  if (options.streamCells < 2) throw InputError("streams need 2 cells or more");
  if (heights.empty()) throw InputError("there are no heights to measure");
}

/// The largest power of two that fits into all sides, as far as spectra are taken; 0 where none
/// does.
int spectrumSideOf(std::initializer_list<int> sides) {
  const int least = std::min(std::min(sides), kMostSpectrum);
  if (least < kLeastSpectrum) return 0;
  return static_cast<int>(std::bit_floor(static_cast<unsigned>(least)));
}

/// Steps between neighbors: all, or those across seams.
struct Steps {
  double largest = 0, sum = 0;
  std::int64_t count = 0;

  void add(float a, float b) {
    const double step = std::abs(double{a} - b);
    if (std::isnan(step)) return;
    largest = std::max(largest, step);
    sum += step;
    ++count;
  }
  Steps& operator+=(const Steps& other) {
    largest = std::max(largest, other.largest);
    sum += other.sum;
    count += other.count;
    return *this;
  }
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

Steps stepsOf(const Grid<float>& heights, const Grid<std::uint8_t>* seams) {
  return parallelSum<Steps>(0, static_cast<std::size_t>(heights.height()), kRowsAtOnce,
                            [&](std::size_t first, std::size_t last) {
                              Steps steps;
                              for (auto y = static_cast<int>(first); y < static_cast<int>(last);
                                   ++y) {
                                for (int x = 0; x < heights.width(); ++x) {
                                  const int at = seams ? (*seams)(x, y) : kSeamRight | kSeamBelow;
                                  if (at & kSeamRight && x + 1 < heights.width())
                                    steps.add(heights(x, y), heights(x + 1, y));
                                  if (at & kSeamBelow && y + 1 < heights.height())
                                    steps.add(heights(x, y), heights(x, y + 1));
                                }
                              }
                              return steps;
                            });
}

/// The slope in a cell, by central differences, heights for each cell; NaN at the border.
double slopeAt(const Grid<float>& heights, int x, int y) {
  return std::hypot(double{heights(x + 1, y)} - heights(x - 1, y),
                    double{heights(x, y + 1)} - heights(x, y - 1)) /
         2;
}

/// A sum, and of how many.
struct Mean {
  double sum = 0;
  std::int64_t count = 0;

  Mean& operator+=(const Mean& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
  double value() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

/// The mean of a function of the slopes of a map.
template <class Function>
Mean meanOverSlopes(const Grid<float>& heights, const Function& function) {
  const int rows = std::max(heights.height() - 1, 1);
  return parallelSum<Mean>(
      1, static_cast<std::size_t>(rows), kRowsAtOnce, [&](std::size_t first, std::size_t last) {
        Mean mean;
        for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
          for (int x = 1; x + 1 < heights.width(); ++x) {
            const double slope = slopeAt(heights, x, y);
            if (std::isnan(slope)) continue;
            mean.sum += function(slope);
            ++mean.count;
          }
        }
        return mean;
      });
}

std::optional<double> flatShareOf(const Grid<float>& heights) {
  const Mean slope = meanOverSlopes(heights, [](double s) { return s; });
  if (slope.count == 0) return std::nullopt;
  const double least = kFlat * slope.value();
  return meanOverSlopes(heights, [&](double s) { return s <= least ? 1.0 : 0.0; }).value();
}

void measureWater(const Grid<float>& heights, const TerrainOptions& options,
                  TerrainFigures& figures, const Progress& progress) {
  const double cell = options.cellSize;
  {
    const Drainage drainage = drain(heights, progress.part(0, 0.5));
    const auto cells = static_cast<double>(drainage.order.size());
    if (cells == 0) return;
    std::size_t flooded = 0;
    double depth = 0;
    const std::vector<Depression> closed = depressions(heights, drainage.levels);
    for (const Depression& depression : closed) {
      flooded += depression.cells;
      depth += depression.depth;
    }
    const auto count = static_cast<double>(closed.size());
    figures.floodedShare = static_cast<double>(flooded) / cells;
    figures.depressions = count / cells * 1e6;
    if (options.meters) figures.depressionsKm2 = count / (cells * cell * cell / kSquareKilometer);
    if (!closed.empty()) figures.depressionDepth = depth / count;
    const Grid<std::uint32_t> sum = flowAccumulation(drainage);
    const StreamNetwork network = streamNetwork(drainage, sum, options.streamCells);
    figures.drainageDensity = network.length() / cells / cell;
    figures.bifurcation = network.bifurcationRatio();
    figures.highestOrder = static_cast<double>(network.streams.size());
    double length = 0, squares = 0;
    const std::vector<FlowLine> lines = flowLines(drainage, sum, options.streamCells, &heights);
    for (const FlowLine& line : lines) {
      const double own = lengthOf(line, heights.width());
      length += own;
      squares += own * own;
    }
    if (!lines.empty()) {
      figures.valleyLength = length / static_cast<double>(lines.size()) * cell;
      figures.valleyReach = squares / length * cell;
    }
  }
  const Drainage ridges = drain(negated(heights), progress.part(0.5, 1));
  const std::vector<FlowLine> lines =
      flowLines(ridges, flowAccumulation(ridges), options.streamCells);
  double length = 0;
  for (const FlowLine& line : lines) length += lengthOf(line, heights.width());
  if (!lines.empty()) figures.ridgeLength = length / static_cast<double>(lines.size()) * cell;
}

/// Samples of a quantity over a map, ascending.
using Samples = std::vector<double>;

struct Distributions {
  Samples heights, slopes, curvature;
};

/// An even choice of the cells that have all four neighbors.
Distributions distributionsOf(const Grid<float>& heights, const TerrainOptions& options) {
  Distributions found;
  const double cell = options.cellSize;
  const std::size_t step = (heights.count() + kSamples - 1) / kSamples;
  // A lattice that is coarser along both axes, so that no direction is preferred.
  const int stride = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(step))));
  for (int y = 1; y + 1 < heights.height(); y += stride) {
    for (int x = 1; x + 1 < heights.width(); x += stride) {
      const double h = heights(x, y), e = heights(x + 1, y), w = heights(x - 1, y),
                   n = heights(x, y - 1), s = heights(x, y + 1);
      const double curvature = (e + w + n + s - 4 * h) / (cell * cell);
      if (std::isnan(curvature)) continue;
      found.heights.push_back(h);
      found.slopes.push_back(std::hypot(e - w, s - n) / (2 * cell));
      found.curvature.push_back(curvature);
    }
  }
  for (Samples* samples : {&found.heights, &found.slopes, &found.curvature})
    std::ranges::sort(*samples);
  return found;
}

double deviationOf(const Samples& samples) {
  double sum = 0, squares = 0;
  for (const double v : samples) sum += v;
  const double mean = sum / static_cast<double>(samples.size());
  for (const double v : samples) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(samples.size()));
}

/// In standard deviations of the example's samples. Where these are all equal, nothing but the same
/// is at a distance that has a number.
std::optional<double> distanceOf(const Samples& a, const Samples& b, double deviation) {
  if (a.empty() || b.empty()) return std::nullopt;
  const double distance = earthMoversDistance(a, b);
  if (distance == 0) return 0;
  return deviation > 0 ? std::optional(distance / deviation) : std::nullopt;
}

/// A part of a map.
Grid<float> window(const Grid<float>& heights, int x0, int y0, int width, int height) {
  Grid<float> part(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) part(x, y) = heights(x0 + x, y0 + y);
  return part;
}

struct Halves {
  Grid<float> first, second;
};
/// The halves of a map across its longer side; none where they are too small.
std::optional<Halves> halvesOf(const Grid<float>& heights) {
  const int width = heights.width(), height = heights.height();
  if (std::max(width, height) < 2 * kSmallestHalf || std::min(width, height) < kSmallestHalf)
    return std::nullopt;
  if (width >= height) {
    const int half = width / 2;
    return Halves{window(heights, 0, 0, half, height),
                  window(heights, width - half, 0, half, height)};
  }
  const int half = height / 2;
  return Halves{window(heights, 0, 0, width, half), window(heights, 0, height - half, width, half)};
}

/// The share of a map's shapes that another one has, both on a coarser resolution.
std::optional<double> copiedShare(const Grid<float>& of, const Grid<float>& in, int halvings,
                                  const Progress& progress) {
  return TerrainShapes(layoutOf(of, halvings), kShapes)
      .foundIn(TerrainShapes(layoutOf(in, halvings), kShapesAmong), progress);
}

}  // namespace

TerrainFigures terrainFigures(const Grid<float>& heights, const TerrainOptions& options,
                              int spectrumSide, const Progress& progress) {
  check(heights, options);
  TerrainFigures figures;
  figures.width = heights.width();
  figures.height = heights.height();
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const float h : heights.values()) {
    if (std::isnan(h)) continue;
    low = std::min(low, h);
    high = std::max(high, h);
  }
  if (!(high >= low)) return figures;
  figures.relief = double{high} - low;
  measureWater(heights, options, figures, progress.part(0, 0.8));
  if (spectrumSide == 0) spectrumSide = spectrumSideOf({heights.width(), heights.height()});
  if (spectrumSide > 0)
    figures.spectrumSlope = spectrumSlope(heights, spectrumSide, progress.part(0.8, 0.9));
  figures.largestStep = stepsOf(heights, nullptr).largest;
  figures.flatShare = flatShareOf(heights);
  figures.repeatedPeaks = repeatedPeaks(heights, progress.part(0.9, 0.95));
  figures.repeatedShapes = TerrainShapes(heights, kShapes).repeated(progress.part(0.95, 1));
  return figures;
}

TerrainLikeness measureTerrain(const Grid<float>& example, const Grid<float>& result,
                               const TerrainOptions& options, const Grid<std::uint8_t>* seams,
                               const Progress& progress) {
  check(example, options);
  check(result, options);
  if (seams && !seams->sameSize(result))
    throw InputError("the seams have another size than the result");
  progress.report("measuring terrain", 0);
  const std::optional<Halves> halves = halvesOf(example);
  // All spectra are of windows of one size.
  const int side =
      halves ? spectrumSideOf(
                   {halves->first.width(), halves->first.height(), result.width(), result.height()})
             : spectrumSideOf({example.width(), example.height(), result.width(), result.height()});
  TerrainLikeness likeness;
  likeness.example = terrainFigures(example, options, side, progress.part(0, 0.2));
  likeness.result = terrainFigures(result, options, side, progress.part(0.2, 0.6));
  const Distributions wanted = distributionsOf(example, options);
  const Distributions got = distributionsOf(result, options);
  const double heights = deviationOf(wanted.heights), slopes = deviationOf(wanted.slopes),
               curvature = deviationOf(wanted.curvature);
  likeness.heights.result = distanceOf(wanted.heights, got.heights, heights);
  likeness.slopes.result = distanceOf(wanted.slopes, got.slopes, slopes);
  likeness.curvature.result = distanceOf(wanted.curvature, got.curvature, curvature);
  if (halves) {
    likeness.firstHalf = terrainFigures(halves->first, options, side, progress.part(0.6, 0.65));
    likeness.secondHalf = terrainFigures(halves->second, options, side, progress.part(0.65, 0.7));
    const Distributions a = distributionsOf(halves->first, options);
    const Distributions b = distributionsOf(halves->second, options);
    likeness.heights.floor = distanceOf(a.heights, b.heights, heights);
    likeness.slopes.floor = distanceOf(a.slopes, b.slopes, slopes);
    likeness.curvature.floor = distanceOf(a.curvature, b.curvature, curvature);
  }
  progress.report("looking for copies", 0.7);
  likeness.verbatimShare = verbatimShare(example, result, progress.part(0.7, 0.9));
  const int layout = layoutHalvings(example);
  likeness.copiedShapes.result = copiedShare(result, example, 0, progress.part(0.9, 0.95));
  likeness.copiedLayout.result = copiedShare(result, example, layout, progress.part(0.95, 0.96));
  if (halves) {
    likeness.copiedShapes.floor =
        copiedShare(halves->second, halves->first, 0, progress.part(0.96, 0.99));
    likeness.copiedLayout.floor =
        copiedShare(halves->second, halves->first, layout, progress.part(0.99, 1));
  }
  const Steps ofExample = stepsOf(example, nullptr), ofResult = stepsOf(result, nullptr);
  if (ofExample.largest > 0) {
    likeness.stepRatio = ofResult.largest / ofExample.largest;
    if (seams) {
      const Steps across = stepsOf(result, seams);
      likeness.seamStepRatio = across.largest / ofExample.largest;
      likeness.seamMeanStepRatio = across.mean() / ofExample.mean();
    }
  }
  progress.report("measuring terrain", 1);
  return likeness;
}

}  // namespace exemplar
