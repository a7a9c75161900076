// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/guide_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "maps/distance_transform.h"
#include "synth/terrain/gradient_domain.h"

namespace exemplar {
namespace {

constexpr int kLongest = 192;
constexpr double kRidge = 0.97, kValleyBegin = 0.3, kValleyEnd = 0.05;
/// How far the membrane reaches, as a share of the guide's longest side.
constexpr double kReach = 0.25;
/// How far lines count, as a share of it: in full up to half as far.
constexpr double kCounts = 0.04;

/// Heights that shares of the examples' samples do not reach.
class Heights {
 public:
  explicit Heights(std::span<const Grid<float>> examples) {
    for (const Grid<float>& example : examples)
      for (const float h : example.values())
        if (!std::isnan(h)) sorted_.push_back(h);
    if (sorted_.empty()) sorted_.push_back(0);
    std::ranges::sort(sorted_);
  }
  double at(double share) const {
    return sorted_[static_cast<std::size_t>(share * static_cast<double>(sorted_.size() - 1))];
  }

 private:
  std::vector<float> sorted_;
};

/// The heights of a line's points: given, linear along the line between given ones, or usual.
std::vector<double> heightsAlong(const TerrainLine& line, const Heights& heights) {
  const std::size_t count = line.points.size();
  std::vector<double> along(count, 0), result(count);
  for (std::size_t n = 1; n < count; ++n) {
    along[n] = along[n - 1] + std::hypot(line.points[n].x - line.points[n - 1].x,
                                         line.points[n].y - line.points[n - 1].y);
  }
  const double length = std::max(along.back(), 1e-9);
  const bool any = std::ranges::any_of(
      line.points, [](const TerrainLine::Point& p) { return p.height.has_value(); });
  for (std::size_t n = 0; n < count; ++n) {
    const double t = along[n] / length;
    if (!any) {
      result[n] = heights.at(line.ridge ? kRidge : kValleyBegin + t * (kValleyEnd - kValleyBegin));
      continue;
    }
    std::size_t before = n, after = n;
    while (before > 0 && !line.points[before].height) --before;
    while (after + 1 < count && !line.points[after].height) ++after;
    const auto& low = line.points[before].height;
    const auto& high = line.points[after].height;
    if (!low || !high) {
      result[n] = low ? *low : *high;
    } else {
      const double span = along[after] - along[before];
      result[n] = span > 0 ? *low + (along[n] - along[before]) / span * (*high - *low) : *low;
    }
  }
  return result;
}

}  // namespace

LinesGuide guideOfLines(std::span<const TerrainLine> lines, int width, int height,
                        std::span<const Grid<float>> examples, const Progress& progress) {
  const Heights heights(examples);
  const double scale = std::min(1.0, static_cast<double>(kLongest) / std::max(width, height));
  const int w = std::max(2, static_cast<int>(std::lround(width * scale)));
  const int h = std::max(2, static_cast<int>(std::lround(height * scale)));
  Grid<float> guide(w, h, static_cast<float>(heights.at(0.5)));
  Grid<float> hold(w, h);
  for (const TerrainLine& line : lines) {
    const std::vector<double> at = heightsAlong(line, heights);
    const auto mark = [&](double x, double y, double value) {
      const int cx = static_cast<int>(std::floor(x * w / width));
      const int cy = static_cast<int>(std::floor(y * h / height));
      if (!guide.contains(cx, cy)) return;
      guide(cx, cy) = static_cast<float>(value);
      hold(cx, cy) = 1;
    };
    mark(line.points[0].x, line.points[0].y, at[0]);
    for (std::size_t n = 1; n < line.points.size(); ++n) {
      const TerrainLine::Point &a = line.points[n - 1], &b = line.points[n];
      const int steps = 1 + static_cast<int>(2 * scale * std::hypot(b.x - a.x, b.y - a.y));
      // Of lines that leave the map by far, what is on it is enough.
      for (int s = 1; s <= std::min(steps, 1 << 20); ++s) {
        const double t = static_cast<double>(s) / steps;
        mark(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), at[n - 1] + t * (at[n] - at[n - 1]));
      }
    }
  }
  const double reach = kReach * std::max(w, h);
  followSteps(guide, {Grid<float>(w, h), Grid<float>(w, h)}, hold,
              {.screen = 1 / (reach * reach), .cycles = 20}, progress);
  Grid<std::uint8_t> on(w, h);
  for (std::size_t s = 0; s < on.count(); ++s) on[s] = hold[s] > 0;
  const Grid<float> distance = distanceTo(on, false);
  const double counts = kCounts * std::max(w, h);
  Grid<float> weight(w, h);
  for (std::size_t s = 0; s < weight.count(); ++s)
    weight[s] = static_cast<float>(std::clamp(2 * (1 - distance[s] / counts), 0.0, 1.0));
  return {std::move(guide), std::move(weight)};
}

}  // namespace exemplar
