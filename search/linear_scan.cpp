// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/linear_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "search/block_sum.h"

namespace exemplar {

namespace {

// Calls `take(index, sum)` for every block, in the order of their indices, whose sum is at most the
// limit; `take` returns the limit for the blocks that follow.
template <class Sample, class Take>
void scanBlocks(const Array3D<Sample>& source, const BlockSum<Sample>& rows, const Vec3i& block,
                SquaredSum<Sample> limit, const Take& take) {
  const Vec3i positions = blockPositions(source.size(), block);
  for (int k = 0; k < positions.z; ++k)
    for (int j = 0; j < positions.y; ++j) {
      const std::size_t row = source.index(0, j, k);
      const std::size_t end = positions.x;
      for (std::size_t i = 0; i < end; ++i) {
        SquaredSum<Sample> sum;
        i += rows.firstWithin(source.data() + row + i, end - i, limit, sum);
        if (i < end) limit = take(row + i, sum);
      }
    }
}

template <class Sample>
constexpr auto kNoLimit = std::numeric_limits<SquaredSum<Sample>>::max();

// The largest sum that is less than `sum`.
std::int64_t below(std::int64_t sum) { return sum - 1; }
double below(double sum) { return std::nextafter(sum, -1.0); }

template <class Sample>
std::vector<BlockMatch> matches(
    const std::vector<std::pair<SquaredSum<Sample>, std::size_t>>& found,
    const Array3D<Sample>& source, const BlockSum<Sample>& rows) {
  std::vector<BlockMatch> result;
  for (const auto& [sum, index] : found)
    result.push_back({source.ijk(index), rows.distance(sum), 0});
  return result;
}

}  // namespace

template <class Sample>
BlockMatch linearScan(const Array3D<Sample>& source, const BlockQuery<Sample>& query) {
  const BlockSum<Sample> rows(query, source.size());
  BlockMatch best;
  scanBlocks(source, rows, query.samples.size(), kNoLimit<Sample>,
             [&](std::size_t index, SquaredSum<Sample> sum) {
               best = {source.ijk(index), rows.distance(sum), 0};
               return below(sum);
             });
  return best;
}

template <class Sample>
std::vector<BlockMatch> linearScanNearest(const Array3D<Sample>& source,
                                          const BlockQuery<Sample>& query, int count) {
  if (count < 1) throw InputError("the number of blocks to find must be at least 1");
  const BlockSum<Sample> rows(query, source.size());
  // The nearest so far, the farthest of them on top.
  std::vector<std::pair<SquaredSum<Sample>, std::size_t>> heap;
  scanBlocks(source, rows, query.samples.size(), kNoLimit<Sample>,
             [&](std::size_t index, SquaredSum<Sample> sum) {
               heap.emplace_back(sum, index);
               std::ranges::push_heap(heap);
               if (heap.size() > static_cast<std::size_t>(count)) {
                 std::ranges::pop_heap(heap);
                 heap.pop_back();
               }
               return heap.size() < static_cast<std::size_t>(count) ? kNoLimit<Sample>
                                                                    : below(heap.front().first);
             });
  std::ranges::sort_heap(heap);
  return matches(heap, source, rows);
}

template <class Sample>
std::vector<BlockMatch> linearScanWithin(const Array3D<Sample>& source,
                                         const BlockQuery<Sample>& query, double tolerance,
                                         int limit) {
  if (!(tolerance >= 0)) throw InputError("the tolerance of a match must be at least 0");
  if (limit < 1) throw InputError("the number of blocks to find must be at least 1");
  const BlockSum<Sample> rows(query, source.size());
  SquaredSum<Sample> smallest = kNoLimit<Sample>;
  scanBlocks(source, rows, query.samples.size(), smallest,
             [&](std::size_t, SquaredSum<Sample> sum) { return below(smallest = sum); });
  const double farthest = static_cast<double>(smallest) * (1 + tolerance);
  const auto last = static_cast<SquaredSum<Sample>>(
      std::min(farthest, static_cast<double>(std::numeric_limits<std::int64_t>::max() / 2)));
  std::vector<std::pair<SquaredSum<Sample>, std::size_t>> found;
  scanBlocks(source, rows, query.samples.size(), last,
             [&](std::size_t index, SquaredSum<Sample> sum) {
               found.emplace_back(sum, index);
               return last;
             });
  std::ranges::sort(found);
  if (found.size() > static_cast<std::size_t>(limit)) found.resize(limit);
  return matches(found, source, rows);
}

template BlockMatch linearScan(const Array3D<std::uint8_t>&, const BlockQuery<std::uint8_t>&);
template BlockMatch linearScan(const Array3D<float>&, const BlockQuery<float>&);
template std::vector<BlockMatch> linearScanNearest(const Array3D<std::uint8_t>&,
                                                   const BlockQuery<std::uint8_t>&, int);
template std::vector<BlockMatch> linearScanNearest(const Array3D<float>&, const BlockQuery<float>&,
                                                   int);
template std::vector<BlockMatch> linearScanWithin(const Array3D<std::uint8_t>&,
                                                  const BlockQuery<std::uint8_t>&, double, int);
template std::vector<BlockMatch> linearScanWithin(const Array3D<float>&, const BlockQuery<float>&,
                                                  double, int);

}  // namespace exemplar
