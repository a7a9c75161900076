// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/spectrum.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr int kFewestWaves = 4, kShortestWave = 4;
constexpr int kBandsPerOctave = 4;
constexpr std::size_t kWindows = 64;

using Complex = std::complex<double>;

/// A window of the map with its plane taken away, fading to its border; empty where it has a hole.
std::vector<Complex> fadedWindow(const Grid<float>& heights, int x0, int y0, int side) {
  std::vector<Complex> window(static_cast<std::size_t>(side) * side);
  const double middle = (side - 1) / 2.0;
  double mean = 0, alongX = 0, alongY = 0, spread = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double h = heights(x0 + x, y0 + y);
      if (std::isnan(h)) return {};
      mean += h;
      alongX += h * (x - middle);
      alongY += h * (y - middle);
    }
  }
  for (int x = 0; x < side; ++x) spread += (x - middle) * (x - middle);
  const double count = static_cast<double>(window.size());
  mean /= count;
  alongX /= spread * side;
  alongY /= spread * side;
  const auto fade = [&](int at) {
    const double s = std::sin(std::numbers::pi * (at + 0.5) / side);
    return s * s;
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double rest =
          heights(x0 + x, y0 + y) - mean - alongX * (x - middle) - alongY * (y - middle);
      window[static_cast<std::size_t>(y) * side + x] = rest * fade(x) * fade(y);
    }
  }
  return window;
}

void transformSquare(std::vector<Complex>& window, int side) {
  const auto n = static_cast<std::size_t>(side);
  std::vector<Complex> line(n);
  for (std::size_t y = 0; y < n; ++y) {
    line.assign(window.begin() + static_cast<std::ptrdiff_t>(y * n),
                window.begin() + static_cast<std::ptrdiff_t>((y + 1) * n));
    fourierTransform(line);
    std::ranges::copy(line, window.begin() + static_cast<std::ptrdiff_t>(y * n));
  }
  for (std::size_t x = 0; x < n; ++x) {
    for (std::size_t y = 0; y < n; ++y) line[y] = window[y * n + x];
    fourierTransform(line);
    for (std::size_t y = 0; y < n; ++y) window[y * n + x] = line[y];
  }
}

/// Sums of power in bands of wave numbers.
struct Bands {
  std::vector<double> power, logWaves;
  std::vector<double> count;

  Bands& operator+=(const Bands& other) {
    if (power.empty()) return *this = other;
    for (std::size_t b = 0; b < power.size() && !other.power.empty(); ++b) {
      power[b] += other.power[b];
      logWaves[b] += other.logWaves[b];
      count[b] += other.count[b];
    }
    return *this;
  }
};

Bands bandsOf(const std::vector<Complex>& transform, int side) {
  const double most = static_cast<double>(side) / kShortestWave;
  const auto bands =
      static_cast<std::size_t>(std::ceil(kBandsPerOctave * std::log2(most / kFewestWaves)));
  Bands sums{std::vector<double>(bands), std::vector<double>(bands), std::vector<double>(bands)};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double waves = std::hypot(std::min(x, side - x), std::min(y, side - y));
      if (waves < kFewestWaves || waves >= most) continue;
      const auto band = std::min(
          bands - 1, static_cast<std::size_t>(kBandsPerOctave * std::log2(waves / kFewestWaves)));
      sums.power[band] += std::norm(transform[static_cast<std::size_t>(y) * side + x]);
      sums.logWaves[band] += std::log(waves);
      sums.count[band] += 1;
    }
  }
  return sums;
}

}  // namespace

void fourierTransform(std::vector<std::complex<double>>& values) {
  const std::size_t n = values.size();
  assert(std::has_single_bit(n));
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  std::vector<Complex> roots(n / 2);
  for (std::size_t k = 0; k < roots.size(); ++k)
    roots[k] =
        std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
  for (std::size_t half = 1; half < n; half *= 2) {
    const std::size_t step = n / (2 * half);
    for (std::size_t begin = 0; begin < n; begin += 2 * half) {
      for (std::size_t k = 0; k < half; ++k) {
        const Complex a = values[begin + k], root = roots[k * step], b = values[begin + half + k];
        // Written out: std::complex looks for infinities.
        const Complex turned{b.real() * root.real() - b.imag() * root.imag(),
                             b.real() * root.imag() + b.imag() * root.real()};
        values[begin + k] = a + turned;
        values[begin + half + k] = a - turned;
      }
    }
  }
}

std::optional<double> spectrumSlope(const Grid<float>& heights, int side,
                                    const Progress& progress) {
  assert(side >= 32 && std::has_single_bit(static_cast<unsigned>(side)));
  const std::size_t columns = static_cast<std::size_t>(heights.width() / side);
  const std::size_t windows = columns * static_cast<std::size_t>(heights.height() / side);
  const std::size_t used = std::min(windows, kWindows);
  const Bands sums = parallelSum<Bands>(0, used, 1, [&](std::size_t first, std::size_t) {
    progress.check();
    const std::size_t window = first * windows / used;
    std::vector<Complex> values = fadedWindow(heights, static_cast<int>(window % columns) * side,
                                              static_cast<int>(window / columns) * side, side);
    if (values.empty()) return Bands{};
    transformSquare(values, side);
    return bandsOf(values, side);
  });
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t band = 0; band < sums.power.size(); ++band) {
    if (sums.count[band] == 0 || !(sums.power[band] > 0)) continue;
    const double u = sums.logWaves[band] / sums.count[band];
    const double v = std::log(sums.power[band] / sums.count[band]);
    n += 1;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  if (n < 2) return std::nullopt;
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace exemplar
