// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace exemplar::testing {

/// How much of a density along an axis, which is some periods long, is a grid of lines: the
/// amplitude at the grid's frequency, a share of the mean; the largest of the first three
/// harmonics. Three shifted grids that are alike show in the third alone.
inline double gridShare(const std::vector<double>& density, int period) {
  const auto n = static_cast<int>(density.size());
  double mean = 0, largest = 0;
  for (const double here : density) mean += here / n;
  for (int harmonic = 1; harmonic <= 3; ++harmonic) {
    std::complex<double> sum = 0;
    for (int x = 0; x < n; ++x)
      sum += density[static_cast<std::size_t>(x)] *
             std::polar(1.0, -2 * std::numbers::pi * harmonic * x / period);
    largest = std::max(largest, 2 * std::abs(sum) / n / mean);
  }
  return largest;
}

}  // namespace exemplar::testing
