// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/standing_water.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "maps/drainage.h"
#include "maps/halved.h"

namespace exemplar {
namespace {

constexpr std::size_t kLeastWater = 32;
/// The share of the samples beside water that may be lower: an outlet.
constexpr double kOutlets = 0.05;
/// The share of a lake's samples that its level does not reach: shores then rise from it.
constexpr double kLevel = 0.25;

constexpr std::array<Pixel, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// The samples connected with one, of those for which `same(sample)`; marks them in `seen`.
template <class Same>
std::vector<std::size_t> connected(int width, int height, std::size_t from,
                                   std::vector<std::uint8_t>& seen, const Same& same) {
  std::vector<std::size_t> found{from};
  seen[from] = 1;
  for (std::size_t n = 0; n < found.size(); ++n) {
    const int x = static_cast<int>(found[n] % static_cast<std::size_t>(width));
    const int y = static_cast<int>(found[n] / static_cast<std::size_t>(width));
    for (const Pixel step : kSides) {
      const int u = x + step.x, v = y + step.y;
      if (u < 0 || v < 0 || u >= width || v >= height) continue;
      const std::size_t next = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      if (seen[next] || !same(next)) continue;
      seen[next] = 1;
      found.push_back(next);
    }
  }
  return found;
}

/// What each sample comes from, by most of nine: shores without single samples.
Grid<std::uint8_t> wetSamples(const Grid<HeightOrigin>& origins,
                              std::span<const Grid<std::uint8_t>> water,
                              const Grid<std::uint8_t>& held) {
  const int width = origins.width(), height = origins.height();
  Grid<std::uint8_t> kinds(width, height), wet(width, height);
  const auto isFree = [&](std::size_t s) { return held.empty() || !held[s]; };
  for (std::size_t s = 0; s < kinds.count(); ++s)
    kinds[s] = isFree(s) ? water[origins[s].example](origins[s].x, origins[s].y) : kLand;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int lake = 0, sea = 0, all = 0;
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
          lake += kinds(u, v) == kLake;
          sea += kinds(u, v) == kSea;
          ++all;
        }
      }
      if (2 * (lake + sea) > all && isFree(wet.index(x, y))) wet(x, y) = sea > lake ? kSea : kLake;
    }
  }
  return wet;
}

/// The sea: what comes from it or lies as low, where that comes to the border. Nothing else lies
/// under its level.
void settleSea(Grid<float>& heights, const Grid<std::uint8_t>& wet, float level,
               const Grid<std::uint8_t>& held, std::size_t least, bool inland,
               WaterBodies& settled) {
  const int width = heights.width(), height = heights.height();
  const auto isLow = [&](std::size_t s) {
    return wet[s] == kSea || (heights[s] <= level && (held.empty() || !held[s]));
  };
  const auto isBorder = [&](std::size_t s) {
    const int x = static_cast<int>(s) % width, y = static_cast<int>(s) / width;
    return x == 0 || y == 0 || x + 1 == width || y + 1 == height;
  };
  std::vector<std::uint8_t> seen(heights.count());
  for (std::size_t s = 0; s < heights.count(); ++s) {
    if (seen[s] || !isLow(s)) continue;
    const std::vector<std::size_t> body = connected(width, height, s, seen, isLow);
    const bool isSea = body.size() >= least && (inland || std::ranges::any_of(body, isBorder));
    for (const std::size_t n : body) {
      if (isSea) settled.bodies[n] = kSeaBody;
      heights[n] = isSea ? level : std::max(heights[n], level);
    }
  }
}

/// Adds the connected hollows of a map that says which share of each sample lies in one: how many
/// samples of the finest resolution those of each size cover.
void addHollows(const Grid<float>& covered, double samples, Hollows& hollows) {
  // As if they were filled up to 1.
  Grid<float> level(covered.width(), covered.height());
  for (std::size_t s = 0; s < covered.count(); ++s) level[s] = covered[s] >= 0.5f ? 1 : 0;
  for (const Depression& hollow : depressions(Grid<float>(level.width(), level.height()), level)) {
    const std::size_t size = static_cast<std::size_t>(std::bit_width(hollow.cells)) - 1;
    if (size >= hollows.bySize.size()) hollows.bySize.resize(size + 1);
    hollows.bySize[size] += samples * static_cast<double>(hollow.cells);
  }
}

}  // namespace

Grid<std::uint8_t> flatWater(const Grid<float>& heights) {
  const int width = heights.width(), height = heights.height();
  Grid<std::uint8_t> water(width, height);
  float lowest = std::numeric_limits<float>::infinity();
  for (const float h : heights.values()) lowest = h < lowest ? h : lowest;
  bool sea = false;
  std::vector<std::uint8_t> seen(heights.count());
  for (std::size_t s = 0; s < heights.count(); ++s) {
    // Most samples differ from the next one.
    const bool flat = s % static_cast<std::size_t>(width) + 1 < static_cast<std::size_t>(width) &&
                      heights[s] == heights[s + 1];
    if (seen[s] || !flat) continue;
    const std::vector<std::size_t> body =
        connected(width, height, s, seen, [&](std::size_t n) { return heights[n] == heights[s]; });
    if (body.size() < kLeastWater) continue;
    std::size_t beside = 0, lower = 0;
    bool border = false;
    for (const std::size_t n : body) {
      const int x = static_cast<int>(n % static_cast<std::size_t>(width));
      const int y = static_cast<int>(n / static_cast<std::size_t>(width));
      for (const Pixel step : kSides) {
        if (!heights.contains(x + step.x, y + step.y)) {
          border = true;
          continue;
        }
        const float h = heights(x + step.x, y + step.y);
        if (h == heights[s] || std::isnan(h)) continue;
        ++beside;
        lower += h < heights[s];
      }
    }
    // A map that is nothing but one height is no water.
    if (beside == 0 || static_cast<double>(lower) > kOutlets * static_cast<double>(beside))
      continue;
    const std::uint8_t kind = border && heights[s] == lowest ? kSea : kLake;
    for (const std::size_t n : body) water[n] = kind;
    sea |= kind == kSea;
  }
  // What is as low as the sea belongs to it, with or without a strait.
  for (std::size_t s = 0; sea && s < water.count(); ++s)
    if (water[s] == kLake && heights[s] == lowest) water[s] = kSea;
  return water;
}

Grid<std::uint8_t> halvedWater(const Grid<std::uint8_t>& water) {
  Grid<std::uint8_t> half(std::max(1, water.width() / 2), std::max(1, water.height() / 2));
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      int count = 0;
      std::uint8_t kind = kLand;
      for (int v = 0; v < 2; ++v) {
        for (int u = 0; u < 2; ++u) {
          const std::uint8_t w = water(std::min(2 * x + u, water.width() - 1),
                                       std::min(2 * y + v, water.height() - 1));
          count += w != kLand;
          kind = std::max(kind, w);
        }
      }
      half(x, y) = count >= 2 ? kind : kLand;
    }
  }
  return half;
}

WaterBodies settleWater(Grid<float>& heights, const Grid<HeightOrigin>& origins,
                        std::span<const Grid<std::uint8_t>> water,
                        const std::optional<float>& seaLevel, const Grid<std::uint8_t>& held,
                        std::size_t least, bool inland) {
  const int width = heights.width(), height = heights.height();
  const Grid<std::uint8_t> wet = wetSamples(origins, water, held);
  WaterBodies settled{Grid<std::uint32_t>(width, height), kFirstLake, heights};
  if (seaLevel) settleSea(heights, wet, *seaLevel, held, least, inland, settled);
  std::vector<std::uint8_t> seen(heights.count());
  for (std::size_t s = 0; s < heights.count(); ++s) {
    const auto isLake = [&](std::size_t n) { return wet[n] != kLand && settled.bodies[n] == 0; };
    if (seen[s] || !isLake(s)) continue;
    const std::vector<std::size_t> body = connected(width, height, s, seen, isLake);
    if (body.size() < least) continue;
    std::vector<float> levels;
    for (const std::size_t n : body) levels.push_back(heights[n]);
    const auto at = static_cast<std::ptrdiff_t>(kLevel * static_cast<double>(levels.size() - 1));
    std::nth_element(levels.begin(), levels.begin() + at, levels.end());
    const float level = levels[static_cast<std::size_t>(at)];
    for (const std::size_t n : body) {
      heights[n] = level;
      settled.bodies[n] = settled.count;
    }
    ++settled.count;
  }
  return settled;
}

std::vector<Hollows> hollowsOf(std::span<const Grid<float>> maps, int levels,
                               const Progress& progress) {
  std::vector<Hollows> hollows(static_cast<std::size_t>(levels));
  double all = 0;
  for (const Grid<float>& heights : maps) {
    const Drainage drainage = drain(heights, progress);
    all += static_cast<double>(drainage.order.size());
    Grid<float> covered(heights.width(), heights.height());
    for (std::size_t s = 0; s < covered.count(); ++s)
      covered[s] = drainage.levels[s] > heights[s] ? 1 : 0;
    double samples = 1;  // of the maps, in one of the resolution
    for (Hollows& level : hollows) {
      addHollows(covered, samples, level);
      if (std::min(covered.width(), covered.height()) < 2) break;
      covered = halved(covered, false);
      samples *= 4;
    }
  }
  for (Hollows& level : hollows) {
    for (double& share : level.bySize) level.share += share /= all;
  }
  return hollows;
}

}  // namespace exemplar
