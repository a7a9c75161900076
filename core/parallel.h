// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <vector>

namespace exemplar {

/// Calls `body(begin, end)` on pieces of [begin, end) of about `grain` items, in parallel. The body
/// writes only to slots of its own items, so that the result cannot depend on the threads.
template <class Body>
void parallelFor(std::size_t begin, std::size_t end, std::size_t grain, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, grain),
                    [&](const tbb::blocked_range<std::size_t>& r) { body(r.begin(), r.end()); });
}

/// The sum of `term(begin, end)` over pieces of exactly `grain` items (the last may be shorter),
/// added in the order of the pieces: the same bytes at any number of threads. `Sum` needs `+=`.
template <class Sum, class Term>
Sum parallelSum(std::size_t begin, std::size_t end, std::size_t grain, const Term& term) {
  if (begin >= end) return Sum{};
  const std::size_t pieces = (end - begin + grain - 1) / grain;
  std::vector<Sum> partial(pieces);
  parallelFor(0, pieces, 1, [&](std::size_t p0, std::size_t p1) {
    for (std::size_t p = p0; p < p1; ++p) {
      const std::size_t first = begin + p * grain;
      partial[p] = term(first, first + grain < end ? first + grain : end);
    }
  });
  Sum sum{};
  for (const Sum& s : partial) sum += s;
  return sum;
}

}  // namespace exemplar
