// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/height_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace exemplar {

std::optional<HeightRange> rangeOf(const Grid<float>& heights) {
  HeightRange range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                    0};
  for (const float h : heights.values()) {
    range.holes += std::isnan(h);
    range.low = h < range.low ? h : range.low;
    range.high = h > range.high ? h : range.high;
  }
  if (range.holes == heights.count()) return std::nullopt;
  return range;
}

std::size_t fillHoles(Grid<float>& heights) {
  const auto width = static_cast<std::size_t>(heights.width());
  const auto forNeighbors = [&](std::size_t p, const auto& body) {
    const int column = static_cast<int>(p % width), row = static_cast<int>(p / width);
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, heights.height() - 1); ++r)
      for (int c = std::max(column - 1, 0); c <= std::min(column + 1, heights.width() - 1); ++c)
        body(heights.index(c, r));
  };
  std::vector<std::size_t> ring;  // the cells without data next to ones with
  std::size_t holes = 0;
  for (std::size_t p = 0; p < heights.count(); ++p) {
    if (!std::isnan(heights[p])) continue;
    ++holes;
    bool borders = false;
    forNeighbors(p, [&](std::size_t q) { borders = borders || !std::isnan(heights[q]); });
    if (borders) ring.push_back(p);
  }
  while (!ring.empty()) {
    std::vector<float> filled;
    for (const std::size_t p : ring) {
      double sum = 0;
      int count = 0;
      forNeighbors(p, [&](std::size_t q) {
        if (std::isnan(heights[q])) return;
        sum += heights[q];
        ++count;
      });
      filled.push_back(static_cast<float>(sum / count));
    }
    for (std::size_t i = 0; i < ring.size(); ++i) heights[ring[i]] = filled[i];
    std::vector<std::size_t> next;
    for (const std::size_t p : ring) {
      forNeighbors(p, [&](std::size_t q) {
        if (std::isnan(heights[q])) next.push_back(q);
      });
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    ring = std::move(next);
  }
  return holes;
}

}  // namespace exemplar
