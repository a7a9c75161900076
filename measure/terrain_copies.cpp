// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/terrain_copies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/parallel.h"
#include "measure/repeated_share.h"

namespace exemplar {
namespace {

constexpr int kWindow = 24;
constexpr std::size_t kWindows = 150, kFewestWindows = 24;
constexpr double kWork = 4e8;  ///< places that are looked at, over all windows and orientations
constexpr double kSameShare = 1.0 / 3;
constexpr int kProbes = 16;
constexpr double kProbesShare = 1.0 / 6;  ///< of what may differ, in the probes

constexpr int kPeakRadius = 8, kAround = 9, kShift = 2;
constexpr int kPeakMargin = kAround + kShift + 2;  // of the smoothed Laplacian
constexpr std::size_t kPeaks = 400;
constexpr double kSamePeak = 0.75, kWorthMoving = 0.3;

/// A place in a square of `side`, turned and mirrored: one of eight orientations.
Pixel turned(Pixel p, int side, int orientation) {
  if (orientation & 4) p.x = side - 1 - p.x;
  switch (orientation & 3) {
    case 1:
      return {side - 1 - p.y, p.x};
    case 2:
      return {side - 1 - p.x, side - 1 - p.y};
    case 3:
      return {p.y, side - 1 - p.x};
    default:
      return p;
  }
}

std::vector<float> windowAt(const Grid<float>& map, Pixel at, int side, int orientation) {
  std::vector<float> values(static_cast<std::size_t>(side) * side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Pixel to = turned({x, y}, side, orientation);
      values[static_cast<std::size_t>(to.y) * side + to.x] = map(at.x + x, at.y + y);
    }
  }
  return values;
}

/// The mean square; NaN where there is a hole.
double power(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double{v} * v;
  return sum / static_cast<double>(values.size());
}

/// Whether a window occurs anywhere in a map as it is.
class Finder {
 public:
  explicit Finder(std::vector<float> window) : window_(std::move(window)) {
    limit_ = power(window_) * kSameShare * kSameShare * static_cast<double>(window_.size());
    // The cells that say most about it, for most places fall at them.
    for (std::size_t cell = 0; cell < window_.size(); ++cell) probes_.push_back(cell);
    std::ranges::sort(probes_, [&](std::size_t a, std::size_t b) {
      const float x = std::abs(window_[a]), y = std::abs(window_[b]);
      return x != y ? x > y : a < b;
    });
    probes_.resize(kProbes);
  }

  bool occursInRow(const Grid<float>& map, int y) const {
    const int places = map.width() - kWindow + 1;
    std::array<std::ptrdiff_t, kProbes> steps;
    std::array<float, kProbes> wanted;
    for (std::size_t p = 0; p < kProbes; ++p) {
      steps[p] = static_cast<std::ptrdiff_t>(probes_[p] / kWindow) * map.width() +
                 static_cast<std::ptrdiff_t>(probes_[p] % kWindow);
      wanted[p] = window_[probes_[p]];
    }
    const float* row = &map.values()[map.index(0, y)];
    for (int x = 0; x < places; ++x) {
      double sum = 0;
      for (std::size_t p = 0; p < kProbes; ++p) {
        const double d = double{row[x + steps[p]]} - wanted[p];
        sum += d * d;
        if (!(sum <= kProbesShare * limit_)) break;
      }
      if (sum <= kProbesShare * limit_ && agrees(map, {x, y})) return true;
    }
    return false;
  }

 private:
  bool agrees(const Grid<float>& map, Pixel at) const {
    double sum = 0;
    for (int y = 0; y < kWindow; ++y) {
      for (int x = 0; x < kWindow; ++x) {
        const double d =
            double{map(at.x + x, at.y + y)} - window_[static_cast<std::size_t>(y) * kWindow + x];
        sum += d * d;
      }
      if (!(sum <= limit_)) return false;
    }
    return true;
  }

  std::vector<float> window_;
  std::vector<std::size_t> probes_;
  double limit_ = 0;
};

/// Scales to a length of 1 with a mean of 0; false where all are equal.
bool normalize(std::vector<float>& values) {
  double mean = 0;
  for (const float v : values) mean += v;
  mean /= static_cast<double>(values.size());
  for (float& v : values) v = static_cast<float>(v - mean);
  const double length = std::sqrt(power(values) * static_cast<double>(values.size()));
  if (!(length > 0)) return false;
  for (float& v : values) v = static_cast<float>(v / length);
  return true;
}

double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  // Eight sums side by side, in one order everywhere.
  float sums[8] = {};
  std::size_t n = 0;
  for (; n + 8 <= a.size(); n += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) sums[lane] += a[n + lane] * b[n + lane];
  double sum = 0;
  for (const float s : sums) sum += s;
  for (; n < a.size(); ++n) sum += double{a[n]} * b[n];
  return sum;
}

/// The surroundings of a peak in all orientations, and moved.
class Surroundings {
 public:
  Surroundings(const Grid<float>& detail, Pixel at) : detail_(&detail), at_(at) {
    here_ = around({0, 0}, 0);
    whole_ = !here_.empty();
    for (int o = 0; o < 8 && whole_; ++o) turned_[static_cast<std::size_t>(o)] = around({0, 0}, o);
  }

  bool whole() const { return whole_; }
  bool same(const Surroundings& other) const {
    for (const std::vector<float>& theirs : other.turned_) {
      const double straight = correlation(here_, theirs);
      if (straight >= kSamePeak) return true;
      if (straight < kWorthMoving) continue;
      for (int dy = -kShift; dy <= kShift; ++dy) {
        for (int dx = -kShift; dx <= kShift; ++dx) {
          const std::vector<float> moved = around({dx, dy}, 0);
          if (!moved.empty() && correlation(moved, theirs) >= kSamePeak) return true;
        }
      }
    }
    return false;
  }

 private:
  std::vector<float> around(Pixel shift, int orientation) const {
    constexpr int kSide = 2 * kAround + 1;
    std::vector<float> values = windowAt(
        *detail_, {at_.x + shift.x - kAround, at_.y + shift.y - kAround}, kSide, orientation);
    if (!normalize(values)) values.clear();
    return values;
  }

  const Grid<float>* detail_;
  Pixel at_;
  std::vector<float> here_;
  std::array<std::vector<float>, 8> turned_;
  bool whole_ = false;
};

}  // namespace

Grid<float> smoothed3x3(const Grid<float>& values) {
  Grid<float> result(values.width(), values.height(), std::numeric_limits<float>::quiet_NaN());
  parallelFor(1, static_cast<std::size_t>(std::max(1, values.height() - 1)), 32,
              [&](std::size_t first, std::size_t last) {
                for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
                  for (int x = 1; x + 1 < values.width(); ++x) {
                    float sum = 0;
                    for (int dy = -1; dy <= 1; ++dy)
                      for (int dx = -1; dx <= 1; ++dx) sum += values(x + dx, y + dy);
                    result(x, y) = sum / 9;
                  }
                }
              });
  return result;
}

Grid<float> laplacian(const Grid<float>& heights) {
  Grid<float> result(heights.width(), heights.height(), std::numeric_limits<float>::quiet_NaN());
  if (heights.height() < 3) return result;
  parallelFor(1, static_cast<std::size_t>(heights.height()) - 1, 32,
              [&](std::size_t first, std::size_t last) {
                for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
                  for (int x = 1; x + 1 < heights.width(); ++x) {
                    result(x, y) = heights(x - 1, y) + heights(x + 1, y) + heights(x, y - 1) +
                                   heights(x, y + 1) - 4 * heights(x, y);
                  }
                }
              });
  return result;
}

std::optional<double> verbatimShare(const Grid<float>& example, const Grid<float>& result,
                                    const Progress& progress) {
  const int columns = result.width() - kWindow - 1, rows = result.height() - kWindow - 1;
  const int placesX = example.width() - kWindow + 1, placesY = example.height() - kWindow + 1;
  if (columns < 1 || rows < 1 || placesX < 1 || placesY < 1) return std::nullopt;
  const Grid<float> among = laplacian(example), detail = laplacian(result);
  const auto most = std::clamp(static_cast<std::size_t>(kWork / (8.0 * placesX * placesY)),
                               kFewestWindows, kWindows);
  // A lattice as even as the map's sides allow.
  const double step =
      std::max(1.0, std::sqrt(static_cast<double>(columns) * rows / static_cast<double>(most)));
  std::vector<Pixel> places;
  for (double y = step / 2; y < rows; y += step)
    for (double x = step / 2; x < columns; x += step)
      places.push_back({1 + static_cast<int>(x), 1 + static_cast<int>(y)});
  // What is next to nothing beside the whole map's detail is flat ground.
  double whole = 0;
  std::size_t cells = 0;
  for (const float v : detail.values()) {
    if (std::isnan(v)) continue;
    whole += double{v} * v;
    ++cells;
  }
  const double least = cells > 0 ? 1e-4 * whole / static_cast<double>(cells) : 0;
  std::vector<std::uint8_t> counts(places.size()), found(places.size());
  parallelFor(0, places.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      const double own = power(windowAt(detail, places[n], kWindow, 0));
      if (!(own > least)) continue;  // a hole is no number
      counts[n] = 1;
      for (int orientation = 0; orientation < 8 && !found[n]; ++orientation) {
        progress.check();
        const Finder finder(windowAt(detail, places[n], kWindow, orientation));
        for (int y = 0; y < placesY && !found[n]; ++y) found[n] = finder.occursInRow(among, y);
      }
    }
  });
  const auto counted = std::ranges::count(counts, 1);
  if (counted == 0) return std::nullopt;
  return static_cast<double>(std::ranges::count(found, 1)) / static_cast<double>(counted);
}

std::vector<Peak> prominentPeaks(const Grid<float>& heights, std::size_t most) {
  std::vector<Peak> peaks;
  const auto isPeak = [&](int x, int y) {
    const float h = heights(x, y);
    for (int dy = -kPeakRadius; dy <= kPeakRadius; ++dy) {
      for (int dx = -kPeakRadius; dx <= kPeakRadius; ++dx) {
        const float other = heights(x + dx, y + dy);
        const bool before = dy < 0 || (dy == 0 && dx < 0);
        if (before ? !(other < h) : !(other <= h)) return false;  // so is one without data
      }
    }
    return true;
  };
  for (int y = kPeakMargin; y < heights.height() - kPeakMargin; ++y) {
    for (int x = kPeakMargin; x < heights.width() - kPeakMargin; ++x) {
      if (!(heights(x, y) >= heights(x + 1, y)) || !isPeak(x, y)) continue;
      double around = 0;
      int count = 0;
      bool whole = true;
      for (int dy = -kPeakMargin; dy <= kPeakMargin; ++dy) {
        for (int dx = -kPeakMargin; dx <= kPeakMargin; ++dx) {
          const float h = heights(x + dx, y + dy);
          whole &= !std::isnan(h);
          if (std::max(std::abs(dx), std::abs(dy)) != kPeakRadius) continue;
          around += h;
          ++count;
        }
      }
      if (whole) peaks.push_back({{x, y}, static_cast<float>(heights(x, y) - around / count)});
    }
  }
  std::ranges::stable_sort(
      peaks, [](const Peak& a, const Peak& b) { return a.prominence > b.prominence; });
  if (peaks.size() > most) peaks.resize(most);
  return peaks;
}

std::optional<double> repeatedPeaks(const Grid<float>& heights, const Progress& progress) {
  const Grid<float> detail = smoothed3x3(laplacian(heights));
  std::vector<Surroundings> peaks;
  for (const Peak& peak : prominentPeaks(heights, kPeaks)) {
    Surroundings surroundings(detail, peak.at);
    if (surroundings.whole()) peaks.push_back(std::move(surroundings));
  }
  return repeatedShare<Surroundings>(peaks, progress);
}

}  // namespace exemplar
