// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "core/progress.h"

namespace exemplar {

/// The share of things that look the same as another of them, by their `same`; none of fewer than
/// two. O(n^2); the same at any number of threads. Throws `Cancelled`.
template <class Thing>
std::optional<double> repeatedShare(std::span<const Thing> things, const Progress& progress) {
  if (things.size() < 2) return std::nullopt;
  std::vector<std::atomic<std::uint8_t>> again(things.size());
  parallelFor(0, things.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t a = first; a < last; ++a) {
      progress.check();
      for (std::size_t b = a + 1; b < things.size(); ++b)
        if (things[a].same(things[b])) again[a] = again[b] = 1;
    }
  });
  std::size_t count = 0;
  for (const auto& flag : again) count += flag;
  return static_cast<double>(count) / static_cast<double>(things.size());
}

}  // namespace exemplar
