// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/random.h"
#include "measure/distribution.h"

namespace exemplar {
namespace {

using Complex = std::complex<double>;

TEST(FourierTransform, IsItsDefinition) {
  const Random random(1);
  for (const std::size_t n : {1u, 2u, 8u, 64u}) {
    std::vector<Complex> values(n), direct(n);
    for (std::size_t i = 0; i < n; ++i)
      values[i] = {random.uniform(-1, 1, i), random.uniform(-1, 1, i, 1)};
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        const double turns = static_cast<double>(i * k) / static_cast<double>(n);
        direct[k] += values[i] * std::polar(1.0, -2 * std::numbers::pi * turns);
      }
    }
    fourierTransform(values);
    // n terms of size 1 in double precision.
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_NEAR(std::abs(values[k] - direct[k]), 0, 1e-14 * static_cast<double>(n * n));
  }
}

/// A map whose waves have a power of their number to the `slope`, in random directions and phases.
Grid<float> waves(int side, double slope) {
  std::vector<Complex> plane(static_cast<std::size_t>(side) * side);
  const Random random(3);
  const auto n = static_cast<std::size_t>(side);
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) {
      const double waves = std::hypot(std::min(x, n - x), std::min(y, n - y));
      const std::size_t at = y * n + x;
      if (waves > 0) plane[at] = std::polar(std::pow(waves, slope / 2), random.uniform(0, 7, at));
    }
  }
  std::vector<Complex> line(n);
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) line[x] = plane[y * n + x];
    fourierTransform(line);
    for (std::size_t x = 0; x < n; ++x) plane[y * n + x] = line[x];
  }
  Grid<float> map(side, side);
  for (std::size_t x = 0; x < n; ++x) {
    for (std::size_t y = 0; y < n; ++y) line[y] = plane[y * n + x];
    fourierTransform(line);
    for (std::size_t y = 0; y < n; ++y)
      map(static_cast<int>(x), static_cast<int>(y)) = static_cast<float>(line[y].real());
  }
  return map;
}

TEST(SpectrumSlope, IsThatOfTheWaves) {
  for (const double slope : {0.0, -1.5, -3.0}) {
    // Some 8,000 waves of random power in 20 bands: within 0.1; whole and in 16 windows.
    EXPECT_NEAR(*spectrumSlope(waves(256, slope), 256), slope, 0.15) << slope;
    EXPECT_NEAR(*spectrumSlope(waves(256, slope), 64), slope, 0.25) << slope;
  }
}

TEST(SpectrumSlope, PassesOverHolesAndPlanes) {
  Grid<float> map = waves(128, -2);
  const double whole = *spectrumSlope(map, 64);
  map(3, 3) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(*spectrumSlope(map, 64), whole, 0.3);
  EXPECT_FALSE(spectrumSlope(map, 128));
  EXPECT_FALSE(spectrumSlope(Grid<float>(64, 64, 5), 64));
  EXPECT_FALSE(spectrumSlope(map, 256));
}

TEST(EarthMoversDistance, IsTheMeanOfWhatSortedValuesMove) {
  EXPECT_DOUBLE_EQ(earthMoversDistance({1, 2, 3}, {1, 2, 3}), 0);
  EXPECT_DOUBLE_EQ(earthMoversDistance({1, 2, 3}, {2, 3, 4}), 1);
  EXPECT_DOUBLE_EQ(earthMoversDistance({0}, {-1, 5}), 3);
  EXPECT_DOUBLE_EQ(earthMoversDistance({0, 0, 1, 1}, {0, 1}), 0);
  const Random random(2);
  std::vector<double> a, b;
  for (std::uint64_t n = 0; n < 100; ++n) {
    a.push_back(random.uniform(n));
    b.push_back(3 * random.uniform(n, 1));
  }
  std::ranges::sort(a);
  std::ranges::sort(b);
  double moved = 0;
  for (std::size_t n = 0; n < a.size(); ++n) moved += std::abs(a[n] - b[n]) / 100;
  EXPECT_NEAR(earthMoversDistance(a, b), moved, 1e-12);
}

}  // namespace
}  // namespace exemplar
