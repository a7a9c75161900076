// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace exemplar {

/// The Kolmogorov-Smirnov distance of two samples: the largest difference of their cumulative
/// distributions, 0..1. Both are ascending and not empty. O(values).
inline double kolmogorovSmirnov(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const double value = std::min(a[i], b[j]);
    while (i < a.size() && a[i] == value) ++i;
    while (j < b.size() && b[j] == value) ++j;
    most = std::max(most, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                   static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return most;
}

/// The earth mover's distance of two samples: how far, on average, values have to be moved to make
/// one distribution of the other; in their unit. Both are ascending and not empty. O(values).
inline double earthMoversDistance(const std::vector<double>& a, const std::vector<double>& b) {
  double distance = 0, last = std::min(a.front(), b.front());
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    const bool fromA = j == b.size() || (i < a.size() && a[i] <= b[j]);
    const double value = fromA ? a[i] : b[j];
    distance += std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                         static_cast<double>(j) / static_cast<double>(b.size())) *
                (value - last);
    last = value;
    ++(fromA ? i : j);
  }
  return distance;
}

}  // namespace exemplar
