// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/block_pyramid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"

namespace exemplar {

namespace {

// At each sample, the sum of the eight samples at the corners of a cube of side `step` whose first
// corner it is; where that cube reaches beyond the box, what is there is not defined.
template <class To, class From>
Array3D<To> addCorners(const Array3D<From>& from, int step) {
  const Vec3i size = from.size();
  Array3D<To> to(size);
  const Vec3i whole = size - Vec3i{step, step, step};
  if (std::min({whole.x, whole.y, whole.z}) < 1) return to;
  const std::size_t dx = step, dy = static_cast<std::size_t>(step) * size.x, dz = dy * size.y;
  parallelFor(0, whole.z, 4, [&](std::size_t begin, std::size_t end) {
    for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
      for (int j = 0; j < whole.y; ++j) {
        const From* a = from.data() + from.index(0, j, k);
        To* out = to.data() + to.index(0, j, k);
        for (int i = 0; i < whole.x; ++i, ++a)
          out[i] = To(a[0]) + To(a[dx]) + To(a[dy]) + To(a[dy + dx]) + To(a[dz]) + To(a[dz + dx]) +
                   To(a[dz + dy]) + To(a[dz + dy + dx]);
      }
  });
  return to;
}

// The positions of cells of `side` samples that lie wholly in a box.
Vec3i cellPositions(const Vec3i& size, int side) {
  return max(Vec3i{0, 0, 0}, size - Vec3i{side - 1, side - 1, side - 1});
}

}  // namespace

int blockLevels(int blockSize) {
  if (blockSize < 1 || blockSize > 256 || !std::has_single_bit(static_cast<unsigned>(blockSize)))
    throw InputError("a block size of " + std::to_string(blockSize) +
                     " has no pyramid; it must be a power of two from 1 to 256");
  return std::countr_zero(static_cast<unsigned>(blockSize));
}

double lipschitzEpsilon(int cellSide, double lipschitz) {
  return lipschitz * lipschitz * (static_cast<double>(cellSide) * cellSide - 1);
}

SlidingPyramid::SlidingPyramid(Array3D<std::uint8_t> source, int largestCell) {
  const int scales = blockLevels(largestCell);
  Array3D<std::uint32_t> sums;  // at most 255 · 256³ < 2^32
  for (int scale = 1; scale <= scales; ++scale) {
    const int step = 1 << (scale - 1);
    sums = scale == 1 ? addCorners<std::uint32_t>(source, step)
                      : addCorners<std::uint32_t>(sums, step);
    Array3D<std::uint8_t> averages(source.size());
    const Vec3i cells = cellPositions(source.size(), 2 * step);
    const std::uint32_t half = 1u << (3 * scale - 1);
    parallelFor(0, cells.z, 4, [&](std::size_t begin, std::size_t end) {
      for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k)
        for (int j = 0; j < cells.y; ++j) {
          const std::size_t row = averages.index(0, j, k);
          for (int i = 0; i < cells.x; ++i)
            averages.data()[row + i] = static_cast<std::uint8_t>(
                (std::uint64_t{sums.data()[row + i]} + half) >> (3 * scale));
        }
    });
    averages_.push_back(std::move(averages));
  }
  averages_.insert(averages_.begin(), std::move(source));
}

std::vector<double> SlidingPyramid::cellDeviations(int finest) const {
  const Array3D<std::uint8_t>& samples = averages_[finest];
  std::vector<double> deviations(averages_.size(), 0);
  Array3D<std::int64_t> sums(samples.size()), squares(samples.size());
  for (std::size_t i = 0; i < samples.count(); ++i) {
    sums.data()[i] = samples.data()[i];
    squares.data()[i] = sums.data()[i] * sums.data()[i];
  }
  for (int scale = finest + 1; scale <= scales(); ++scale) {
    sums = addCorners<std::int64_t>(sums, 1 << (scale - 1));
    squares = addCorners<std::int64_t>(squares, 1 << (scale - 1));
    const Vec3i cells = cellPositions(samples.size(), 1 << scale);
    const std::int64_t n = std::int64_t{1} << (3 * (scale - finest));
    double largest = 0;  // of n² times the variance: at most 2^24 · 2^40, rounded up below
    for (int k = 0; k < cells.z; ++k)
      for (int j = 0; j < cells.y; ++j) {
        const std::size_t row = samples.index(0, j, k);
        for (int i = 0; i < cells.x; ++i) {
          const double sum = static_cast<double>(sums.data()[row + i]);
          largest = std::max(
              largest,
              static_cast<double>(n) * static_cast<double>(squares.data()[row + i]) - sum * sum);
        }
      }
    deviations[scale] = std::sqrt(largest) / static_cast<double>(n) * (1 + 1e-9);
  }
  return deviations;
}

SumRange cellSums(int average, int scale, int finest) {
  const std::int64_t n = std::int64_t{1} << (3 * (scale - finest));
  if (scale == finest) return {average, average};
  const std::int64_t middle = n * average;
  // The average of the cell's source samples lies in [average - 1/2, average + 1/2); where the
  // finest averages are rounded themselves, their own average may be off by another half.
  if (finest == 0)
    return {std::max<std::int64_t>(0, middle - n / 2), std::min(255 * n, middle + n / 2 - 1)};
  return {std::max<std::int64_t>(0, middle - n), std::min(255 * n, middle + n)};
}

}  // namespace exemplar
