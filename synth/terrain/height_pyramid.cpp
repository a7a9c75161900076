// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/height_pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "maps/halved.h"
#include "synth/terrain/standing_water.h"

namespace exemplar {
namespace {

/// Steps that most of an example's steps do not exceed are no banks.
constexpr double kGentle = 0.8;

double bankOf(std::span<const HeightSource> sources) {
  std::vector<float> steps;
  for (const HeightSource& source : sources) {
    const Grid<float>& h = source.heights;
    // Some rows of large maps suffice.
    const int every = 1 + h.height() / 512;
    for (int y = 0; y < h.height(); y += every) {
      for (int x = 0; x + 1 < h.width(); ++x) {
        const float step = std::abs(h(x + 1, y) - h(x, y));
        if (!std::isnan(step)) steps.push_back(step);
      }
    }
  }
  if (steps.empty()) return 1;
  const auto at = static_cast<std::ptrdiff_t>(kGentle * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), steps.begin() + at, steps.end());
  return std::max(steps[static_cast<std::size_t>(at)], 1e-6f);
}

/// The means of what lies under each of `to` equal parts of `from` samples, as weights of a few
/// samples: the first, and one weight for each.
struct Share {
  int first;
  std::vector<float> weights;
};
std::vector<Share> sharesOf(int from, int to) {
  std::vector<Share> shares(static_cast<std::size_t>(to));
  const double scale = static_cast<double>(from) / to;
  for (int n = 0; n < to; ++n) {
    Share& share = shares[static_cast<std::size_t>(n)];
    if (scale <= 1) {
      const double at = std::clamp((n + 0.5) * scale - 0.5, 0.0, from - 1.0);
      share.first = std::min(static_cast<int>(at), std::max(0, from - 2));
      const auto second = static_cast<float>(at - share.first);
      share.weights = {1 - second};
      if (from > 1) share.weights.push_back(second);
    } else {
      const double begin = n * scale, end = (n + 1) * scale;
      share.first = static_cast<int>(begin);
      for (int s = share.first; s < std::min<double>(end, from); ++s) {
        share.weights.push_back(static_cast<float>(
            (std::min<double>(s + 1, end) - std::max<double>(s, begin)) / scale));
      }
    }
  }
  return shares;
}

/// The mean of what is known at a sample and around it; NaN where nothing is.
float besideHole(const Grid<float>& half, int x, int y) {
  if (!std::isnan(half(x, y))) return half(x, y);
  float sum = 0, count = 0;
  for (int v = std::max(0, y - 1); v <= std::min(half.height() - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(half.width() - 1, x + 1); ++u) {
      if (std::isnan(half(u, v))) continue;
      sum += half(u, v);
      count += 1;
    }
  }
  return count > 0 ? sum / count : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Grid<float> detailOf(const Grid<float>& fine, const Grid<float>& half) {
  Grid<float> detail(fine.width(), fine.height());
  parallelFor(0, static_cast<std::size_t>(fine.height()), 16, [&](std::size_t y0, std::size_t y1) {
    for (std::size_t r = y0; r < y1; ++r) {
      const int y = static_cast<int>(r);
      for (int x = 0; x < fine.width(); ++x) {
        float coarse = between(half, x, y, false, false);
        if (std::isnan(coarse) && !std::isnan(fine(x, y)))
          coarse = besideHole(half, std::min(x / 2, half.width() - 1),
                              std::min(y / 2, half.height() - 1));
        // Nothing coarse is known here.
        if (std::isnan(coarse)) coarse = fine(x, y);
        detail(x, y) = fine(x, y) - coarse;
      }
    }
  });
  return detail;
}

std::vector<HeightLevel> heightPyramid(std::span<const Grid<float>> examples, int levels) {
  std::vector<HeightLevel> pyramid(static_cast<std::size_t>(levels));
  for (const Grid<float>& example : examples) {
    Grid<float> heights = example;
    for (HeightLevel& level : pyramid) {
      Grid<float> half;
      if (&level != &pyramid.back()) {
        half = halved(heights, false);
        level.details.push_back(detailOf(heights, half));
      }
      level.sources.push_back(heightSource(std::move(heights)));
      heights = std::move(half);
    }
  }
  for (HeightLevel& level : pyramid) level.bank = bankOf(level.sources);
  std::vector<Grid<std::uint8_t>> water;
  for (const Grid<float>& example : examples) water.push_back(flatWater(example));
  const auto hasWater = [](const Grid<std::uint8_t>& map) {
    return std::ranges::any_of(map.values(), [](std::uint8_t kind) { return kind != kLand; });
  };
  if (std::ranges::none_of(water, hasWater)) return pyramid;
  for (HeightLevel& level : pyramid) {
    level.water = water;
    for (Grid<std::uint8_t>& map : water) map = halvedWater(map);
  }
  return pyramid;
}

float between(const Grid<float>& half, int x, int y, bool wrapsX, bool wrapsY) {
  const auto at = [](int c, int n, bool wraps) {
    return c < 0 ? (wraps ? n - 1 : 0) : c >= n ? (wraps ? 0 : n - 1) : c;
  };
  const int cx = std::min(x / 2, half.width() - 1), cy = std::min(y / 2, half.height() - 1);
  const int ox = at(cx + (x % 2 == 0 ? -1 : 1), half.width(), wrapsX);
  const int oy = at(cy + (y % 2 == 0 ? -1 : 1), half.height(), wrapsY);
  return (9 * half(cx, cy) + 3 * half(ox, cy) + 3 * half(cx, oy) + half(ox, oy)) / 16;
}

Grid<float> coarser(const Grid<float>& heights) { return halved(heights, true); }

Grid<float> coarser(const Grid<float>& heights, const Grid<float>& weights) {
  Grid<float> half((heights.width() + 1) / 2, (heights.height() + 1) / 2);
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      float sum = 0, total = 0;
      for (int v = 2 * y; v < std::min(2 * y + 2, heights.height()); ++v) {
        for (int u = 2 * x; u < std::min(2 * x + 2, heights.width()); ++u) {
          if (!(weights(u, v) > 0)) continue;
          sum += weights(u, v) * heights(u, v);
          total += weights(u, v);
        }
      }
      half(x, y) = total > 0 ? sum / total : 0;
    }
  }
  return half;
}

Grid<float> stretched(const Grid<float>& heights, int width, int height) {
  const std::vector<Share> across = sharesOf(heights.width(), width);
  const std::vector<Share> down = sharesOf(heights.height(), height);
  Grid<float> result(width, height);
  parallelFor(0, static_cast<std::size_t>(height), 16, [&](std::size_t y0, std::size_t y1) {
    std::vector<float> row(static_cast<std::size_t>(heights.width()));
    for (std::size_t y = y0; y < y1; ++y) {
      std::ranges::fill(row, 0.0f);
      for (std::size_t n = 0; n < down[y].weights.size(); ++n) {
        const int v = down[y].first + static_cast<int>(n);
        for (int u = 0; u < heights.width(); ++u)
          row[static_cast<std::size_t>(u)] += down[y].weights[n] * heights(u, v);
      }
      for (int x = 0; x < width; ++x) {
        const Share& share = across[static_cast<std::size_t>(x)];
        float sum = 0;
        for (std::size_t n = 0; n < share.weights.size(); ++n)
          sum += share.weights[n] * row[static_cast<std::size_t>(share.first) + n];
        result(x, static_cast<int>(y)) = sum;
      }
    }
  });
  return result;
}

}  // namespace exemplar
