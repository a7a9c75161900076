// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/progress.h"

namespace exemplar {

// Steps of the standard library that take a second and more of gigabytes, and hear while they last
// that they should stop.

/// How many items of a plain loop are done between two looks at a `Progress`: well below 10 ms.
inline constexpr std::size_t kItemsBetweenLooks = std::size_t{1} << 16;

/// Whether a plain loop should look at its `Progress` before item `n`.
constexpr bool looksUp(std::size_t n) { return n % kItemsBetweenLooks == 0; }

/// A vector of `count` equal values. Throws `Cancelled`.
template <class Vector>
Vector filled(std::size_t count, const typename Vector::value_type& value,
              const Progress& progress) {
  constexpr std::size_t kStep = std::size_t{1} << 22;
  Vector items;
  items.reserve(count);
  while (items.size() < count) {
    progress.check();
    items.resize(std::min(count, items.size() + kStep), value);
  }
  return items;
}

/// Sorts by a total order, in parallel. Throws `Cancelled`; the items are then in any order, and
/// some may be moved from.
template <class Items, class Before>
void sortInParallel(Items& items, const Progress& progress, const Before& before) {
  tbb::parallel_sort(items.begin(), items.end(), [&](const auto& a, const auto& b) {
    progress.check();
    return before(a, b);
  });
}
template <class Items>
void sortInParallel(Items& items, const Progress& progress) {
  sortInParallel(items, progress, [](const auto& a, const auto& b) { return a < b; });
}

}  // namespace exemplar
