// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "maps/drainage.h"
#include "maps/height_map.h"
#include "preview/render.h"

namespace exemplar {
namespace {

using Color = std::array<double, 3>;

constexpr double kUsualSlope = 0.6;
constexpr int kGap = 8;
constexpr double kAmbient = 0.25, kExposure = 0.82;
constexpr Color kWater{0.16, 0.36, 0.62};
/// From low to high: valley green, dry grass, rock, snow; linear between them, in sRGB.
constexpr std::array<Color, 5> kTints{{{0.56, 0.66, 0.49},
                                       {0.76, 0.75, 0.58},
                                       {0.77, 0.67, 0.54},
                                       {0.74, 0.69, 0.66},
                                       {0.96, 0.96, 0.97}}};
constexpr Color kPlain{0.86, 0.86, 0.85};

Color tintOf(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kTints.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kTints.size() - 2);
  const double t = at - static_cast<double>(below);
  Color color;
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = kTints[below][c] * (1 - t) + kTints[below + 1][c] * t;
  return color;
}

/// A map's heights at pixels: averages over the cells of a pixel, or a smooth surface (Catmull and
/// Rom's) through the cells' points.
class Resampled {
 public:
  Resampled(const Grid<float>& heights, double pixelsPerCell)
      : scale_(pixelsPerCell),
        pixels_(std::max(1, static_cast<int>(std::lround(heights.width() * pixelsPerCell))),
                std::max(1, static_cast<int>(std::lround(heights.height() * pixelsPerCell)))) {
    parallelFor(0, static_cast<std::size_t>(pixels_.height()), 16,
                [&](std::size_t first, std::size_t last) {
                  for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
                    for (int x = 0; x < pixels_.width(); ++x)
                      pixels_(x, y) = static_cast<float>(scale_ < 1 ? mean(heights, x, y)
                                                                    : smooth(heights, x, y));
                  }
                });
  }
  const Grid<float>& pixels() const { return pixels_; }

 private:
  double mean(const Grid<float>& heights, int x, int y) const {
    const auto range = [&](int pixel, int cells) {
      const int first = std::min(static_cast<int>(pixel / scale_), cells - 1);
      const int last = std::min(static_cast<int>(std::ceil((pixel + 1) / scale_)), cells);
      return std::pair(first, std::max(first + 1, last));
    };
    const auto [x0, x1] = range(x, heights.width());
    const auto [y0, y1] = range(y, heights.height());
    double sum = 0;
    for (int j = y0; j < y1; ++j)
      for (int i = x0; i < x1; ++i) sum += heights(i, j);
    return sum / ((x1 - x0) * (y1 - y0));
  }
  double smooth(const Grid<float>& heights, int x, int y) const {
    const auto weights = [](double t, std::array<double, 4>& w) {
      w = {((2 - t) * t - 1) * t / 2, (t * t * (3 * t - 5) + 2) / 2, ((4 - 3 * t) * t + 1) * t / 2,
           (t - 1) * t * t / 2};
    };
    const double u = (x + 0.5) / scale_ - 0.5, v = (y + 0.5) / scale_ - 0.5;
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    std::array<double, 4> wx, wy;
    weights(u - i, wx);
    weights(v - j, wy);
    double sum = 0;
    for (int b = 0; b < 4; ++b) {
      const int row = std::clamp(j - 1 + b, 0, heights.height() - 1);
      for (int a = 0; a < 4; ++a) {
        const int column = std::clamp(i - 1 + a, 0, heights.width() - 1);
        sum += wx[static_cast<std::size_t>(a)] * wy[static_cast<std::size_t>(b)] *
               heights(column, row);
      }
    }
    return sum;
  }

  double scale_;
  Grid<float> pixels_;
};

/// The rise for each pixel along x and y; NaN beside holes.
struct Slope {
  double x = 0, y = 0;
};
Slope slopeAt(const Grid<float>& h, int x, int y) {
  const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, h.width() - 1);
  const int y0 = std::max(y - 1, 0), y1 = std::min(y + 1, h.height() - 1);
  return {x1 > x0 ? (double{h(x1, y)} - h(x0, y)) / (x1 - x0) : 0,
          y1 > y0 ? (double{h(x, y1)} - h(x, y0)) / (y1 - y0) : 0};
}

double meanSlope(const ReliefMap& map) {
  double sum = 0;
  std::int64_t count = 0;
  for (int y = 0; y < map.heights->height(); ++y) {
    for (int x = 0; x < map.heights->width(); ++x) {
      const Slope slope = slopeAt(*map.heights, x, y);
      const double square = slope.x * slope.x + slope.y * slope.y;
      if (std::isnan(square)) continue;
      sum += square;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) / map.cellSize : 0;
}

/// Blends a disk of water over a picture.
void dab(Image8& image, double x, double y, double radius) {
  const int x0 = static_cast<int>(std::floor(x - radius - 1)),
            y0 = static_cast<int>(std::floor(y - radius - 1));
  const int side = static_cast<int>(std::ceil(2 * radius)) + 3;
  for (int j = std::max(y0, 0); j < std::min(y0 + side, image.height); ++j) {
    for (int i = std::max(x0, 0); i < std::min(x0 + side, image.width); ++i) {
      const double cover =
          std::clamp(radius + 0.5 - std::hypot(i + 0.5 - x, j + 0.5 - y), 0.0, 1.0);
      std::uint8_t* pixel = image.at(i, j);
      // What a disk covers already stays: overlapping ones are one line.
      for (std::size_t c = 0; c < 3; ++c) {
        const double blended = pixel[c] * (1 - cover) + 255 * kWater[c] * cover;
        pixel[c] = static_cast<std::uint8_t>(std::lround(blended));
      }
    }
  }
}

/// The streams of a map, from cell to cell.
struct Streams {
  std::vector<FlowLine> lines;
  Grid<std::uint8_t> orders;
};

void drawStreams(Image8& image, const Streams& streams, double scale) {
  const auto width = static_cast<std::uint32_t>(streams.orders.width());
  for (const FlowLine& line : streams.lines) {
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
      const auto middle = [&](std::uint32_t cell) {
        return std::pair((cell % width + 0.5) * scale, (cell / width + 0.5) * scale);
      };
      const auto [ax, ay] = middle(line[n]);
      const auto [bx, by] = middle(line[n + 1]);
      const double radius = 0.4 + 0.3 * streams.orders[line[n]];
      const int steps = std::max(1, static_cast<int>(std::ceil(2 * std::hypot(bx - ax, by - ay))));
      for (int k = 0; k < steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        dab(image, ax + (bx - ax) * t, ay + (by - ay) * t, radius);
      }
    }
  }
}

/// Pictures above each other.
Image8 stacked(std::span<const Image8> rows) {
  Image8 all{0, -kGap, 3, {}};
  for (const Image8& row : rows) {
    all.width = std::max(all.width, row.width);
    all.height += row.height + kGap;
  }
  all.pixels.resize(static_cast<std::size_t>(all.width) * all.height * 3);
  for (std::size_t p = 0; p < all.pixels.size(); ++p) all.pixels[p] = kBackground[p % 3];
  int top = 0;
  for (const Image8& row : rows) {
    for (int y = 0; y < row.height; ++y)
      std::copy_n(row.at(0, y), static_cast<std::size_t>(row.width) * 3, all.at(0, top + y));
    top += row.height + kGap;
  }
  return all;
}

void check(std::span<const ReliefMap> maps, const ReliefOptions& o) {
  if (maps.empty()) throw InputError("there is no map to show");
  for (const ReliefMap& map : maps) {
    if (!map.heights || map.heights->empty())
      throw InputError("a map without cells has no picture");
    if (!(map.cellSize > 0)) throw InputError("`cell-size` must be > 0");
  }
  if (o.azimuths.empty() || o.azimuths.size() > 8)
    throw InputError("relief is lit from 1 to 8 directions");
  if (!(o.elevation >= 0.05 && o.elevation <= 1.5))
    throw InputError("the light's elevation must be 0.05..1.5 radians");
  if (!(o.exaggeration >= 0 && o.exaggeration <= 1e6))
    throw InputError("`exaggeration` must be 0..1,000,000");
  if (o.longest < 16 || o.longest > 16384)
    throw InputError("the picture's longest side must be 16..16384 pixels");
}

}  // namespace

Image8 renderRelief(std::span<const ReliefMap> maps, const ReliefOptions& options,
                    const Progress& progress) {
  check(maps, options);
  double longest = 0, smallest = std::numeric_limits<double>::infinity();
  double low = smallest, high = -low;
  for (const ReliefMap& map : maps) {
    longest =
        std::max(longest, std::max(map.heights->width(), map.heights->height()) * map.cellSize);
    smallest = std::min(smallest, map.cellSize);
    const std::optional<HeightRange> range = rangeOf(*map.heights);
    if (!range) continue;
    low = std::min(low, double{range->low});
    high = std::max(high, double{range->high});
  }
  // Pixels for each unit of length; whole pixels for a cell where there are several.
  double perUnit = options.longest / longest;
  if (perUnit * smallest > 1) perUnit = std::floor(perUnit * smallest) / smallest;
  double exaggeration = options.exaggeration;
  if (exaggeration == 0) {
    const double slope = meanSlope(maps.front());
    exaggeration = slope > 0 ? kUsualSlope / slope : 1;
  }
  double bytes = 0;
  for (const ReliefMap& map : maps) {
    const double scale = perUnit * map.cellSize;
    bytes += (4 + 6.0 * static_cast<double>(options.azimuths.size())) * scale * scale *
             static_cast<double>(map.heights->count());
    if (options.streamCells > 0) bytes += 20.0 * static_cast<double>(map.heights->count());
  }
  requireMemory(bytes, "a picture of relief", "make it smaller");

  std::vector<std::vector<Image8>> rows(options.azimuths.size());
  const auto share = [&](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(maps.size());
  };
  for (std::size_t n = 0; n < maps.size(); ++n) {
    const Progress part = progress.part(share(n), share(n + 1));
    part.report("drawing relief", 0);
    const ReliefMap& map = maps[n];
    const double scale = perUnit * map.cellSize;
    Streams streams;
    if (options.streamCells > 0) {
      const Drainage drainage = drain(*map.heights, part.part(0, 0.7));
      const Grid<std::uint32_t> sum = flowAccumulation(drainage);
      streams = {flowLines(drainage, sum, options.streamCells),
                 streamNetwork(drainage, sum, options.streamCells).orders};
    }
    const Resampled resampled(*map.heights, scale);
    const Grid<float>& heights = resampled.pixels();
    for (std::size_t light = 0; light < options.azimuths.size(); ++light) {
      part.report("drawing relief", 0.7 + 0.3 * static_cast<double>(light) /
                                              static_cast<double>(options.azimuths.size()));
      const double azimuth = options.azimuths[light];
      const double lightX = std::sin(azimuth) * std::cos(options.elevation),
                   lightY = -std::cos(azimuth) * std::cos(options.elevation),
                   lightZ = std::sin(options.elevation);
      Image8 image{heights.width(), heights.height(), 3, {}};
      image.pixels.resize(heights.count() * 3);
      parallelFor(0, static_cast<std::size_t>(image.height), 16,
                  [&](std::size_t first, std::size_t last) {
                    for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
                      for (int x = 0; x < image.width; ++x) {
                        std::uint8_t* pixel = image.at(x, y);
                        Slope slope = slopeAt(heights, x, y);
                        slope.x *= exaggeration * perUnit;
                        slope.y *= exaggeration * perUnit;
                        const double h = heights(x, y);
                        if (std::isnan(h)) {
                          std::ranges::copy(kBackground, pixel);
                          continue;
                        }
                        if (std::isnan(slope.x)) slope.x = 0;
                        if (std::isnan(slope.y)) slope.y = 0;
                        const double lit = (lightZ - slope.x * lightX - slope.y * lightY) /
                                           std::sqrt(1 + slope.x * slope.x + slope.y * slope.y);
                        const double shade =
                            kExposure * (kAmbient + (1 - kAmbient) * std::max(0.0, lit) / lightZ);
                        const Color color =
                            options.tint && high > low ? tintOf((h - low) / (high - low)) : kPlain;
                        for (std::size_t c = 0; c < 3; ++c) {
                          pixel[c] = static_cast<std::uint8_t>(
                              std::lround(255 * std::clamp(color[c] * shade, 0.0, 1.0)));
                        }
                      }
                    }
                  });
      drawStreams(image, streams, scale);
      rows[light].push_back(std::move(image));
    }
  }
  std::vector<Image8> joined;
  for (const std::vector<Image8>& row : rows) joined.push_back(sideBySide(row, {.gap = kGap}));
  progress.report("drawing relief", 1);
  return joined.size() == 1 ? std::move(joined.front()) : stacked(joined);
}

}  // namespace exemplar
