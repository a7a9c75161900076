// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/linear_scan.h"

#include <cmath>
#include <limits>

#include "search/block_sum.h"

namespace exemplar {

namespace {

// The largest sum that is less than `sum`.
std::int64_t below(std::int64_t sum) { return sum - 1; }
double below(double sum) { return std::nextafter(sum, -1.0); }

}  // namespace

template <class Sample>
BlockMatch linearScan(const Array3D<Sample>& source, const BlockQuery<Sample>& query) {
  const BlockSum<Sample> rows(query, source.size());
  const Vec3i positions = blockPositions(source.size(), query.samples.size());
  auto limit = std::numeric_limits<SquaredSum<Sample>>::max();
  BlockMatch best;
  for (int k = 0; k < positions.z; ++k)
    for (int j = 0; j < positions.y; ++j) {
      const std::size_t row = source.index(0, j, k);
      const std::size_t end = positions.x;
      for (std::size_t i = 0; i < end; ++i) {
        SquaredSum<Sample> sum;
        i += rows.firstWithin(source.data() + row + i, end - i, limit, sum);
        if (i >= end) break;
        best = {source.ijk(row + i), rows.distance(sum), 0};
        limit = below(sum);
      }
    }
  return best;
}

template BlockMatch linearScan(const Array3D<std::uint8_t>&, const BlockQuery<std::uint8_t>&);
template BlockMatch linearScan(const Array3D<float>&, const BlockQuery<float>&);

}  // namespace exemplar
