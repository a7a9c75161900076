// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "exhaustive_scan.h"

#include <limits>

namespace exemplar::bench {

namespace {

// A compiler of 2004 knew no vectors.
#if defined(__clang__)
#define EXEMPLAR_SCALAR
#define EXEMPLAR_SCALAR_LOOP _Pragma("clang loop vectorize(disable)")
#else
#define EXEMPLAR_SCALAR __attribute__((optimize("no-tree-vectorize")))
#define EXEMPLAR_SCALAR_LOOP
#endif

EXEMPLAR_SCALAR std::int64_t sumOf(const std::uint8_t* source, const std::uint8_t* query, int nx,
                                   int ny, int block) {
  std::int64_t sum = 0;
  for (int k = 0; k < block; ++k)
    for (int j = 0; j < block; ++j) {
      const std::uint8_t* s = source + (static_cast<std::size_t>(k) * ny + j) * nx;
      const std::uint8_t* q = query + (static_cast<std::size_t>(k) * block + j) * block;
      int row = 0;
      EXEMPLAR_SCALAR_LOOP
      for (int i = 0; i < block; ++i) {
        const int d = int{s[i]} - int{q[i]};
        row += d * d;
      }
      sum += row;
    }
  return sum;
}

}  // namespace

BlockMatch exhaustiveScan(const Array3D<std::uint8_t>& source,
                          const BlockQuery<std::uint8_t>& query, int stride) {
  const Vec3i positions = blockPositions(source.size(), query.samples.size());
  const int block = query.samples.size().x;
  std::int64_t best = std::numeric_limits<std::int64_t>::max();
  Vec3i at{};
  for (int k = 0; k < positions.z; k += stride)
    for (int j = 0; j < positions.y; ++j)
      for (int i = 0; i < positions.x; ++i) {
        const std::int64_t sum = sumOf(source.data() + source.index(i, j, k), query.samples.data(),
                                       source.size().x, source.size().y, block);
        if (sum >= best) continue;
        best = sum;
        at = {i, j, k};
      }
  return {at, static_cast<double>(best) / static_cast<double>(query.samples.count())};
}

}  // namespace exemplar::bench
