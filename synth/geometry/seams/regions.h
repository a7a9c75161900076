// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "core/vec.h"

namespace exemplar {

/// The connected regions of a grid: samples that share faces and have the same key. Rows along x
/// are cut into runs of one key, and runs of neighboring rows joined.
struct Regions {
  struct Run {
    int begin, end;        ///< along x
    std::uint32_t region;  ///< numbered in the order of their first samples
  };
  std::vector<Run> runs;              ///< in the order of the grid
  std::vector<std::size_t> rowBegin;  ///< of each row (y fastest, then z) in `runs`, and the end
  std::uint32_t count = 0;            ///< of regions
  Vec3i size;

  /// Calls `body(run, first sample)` for each run, in the order of the grid.
  template <class Body>
  void forEachRun(const Body& body) const {
    for (std::size_t row = 0; row + 1 < rowBegin.size(); ++row) {
      Vec3i first{0, static_cast<int>(row % size.y), static_cast<int>(row / size.y)};
      for (std::size_t r = rowBegin[row]; r < rowBegin[row + 1]; ++r) {
        first.x = runs[r].begin;
        body(runs[r], first);
      }
    }
  }
  /// The same in parallel, rows by one thread each.
  template <class Body>
  void parallelForEachRun(const Body& body) const {
    parallelFor(0, rowBegin.size() - 1, 64, [&](std::size_t from, std::size_t to) {
      for (std::size_t row = from; row < to; ++row) {
        Vec3i first{0, static_cast<int>(row % size.y), static_cast<int>(row / size.y)};
        for (std::size_t r = rowBegin[row]; r < rowBegin[row + 1]; ++r) {
          first.x = runs[r].begin;
          body(runs[r], first);
        }
      }
    });
  }
};

/// Finds the regions of a grid that is not empty; `key(ijk)` is compared with ==. O(samples), in
/// parallel; the same at any number of threads.
template <class Key>
Regions findRegions(const Vec3i& size, const Key& key) {
  Regions regions;
  regions.size = size;
  const auto ny = static_cast<std::size_t>(size.y);
  const std::size_t rows = ny * static_cast<std::size_t>(size.z);
  regions.rowBegin.assign(rows + 1, 0);
  const auto overRows = [&](const auto& take) {
    parallelFor(0, rows, 64, [&](std::size_t from, std::size_t to) {
      for (std::size_t row = from; row < to; ++row) {
        Vec3i p{0, static_cast<int>(row % ny), static_cast<int>(row / ny)};
        auto here = key(static_cast<const Vec3i&>(p));
        int begin = 0;
        for (p.x = 1; p.x < size.x; ++p.x) {
          const auto next = key(static_cast<const Vec3i&>(p));
          if (next == here) continue;
          take(row, begin, p.x);
          begin = p.x;
          here = next;
        }
        take(row, begin, size.x);
      }
    });
  };
  overRows([&](std::size_t row, int, int) { ++regions.rowBegin[row + 1]; });
  for (std::size_t row = 0; row < rows; ++row) {
    regions.rowBegin[row + 1] += regions.rowBegin[row];
  }
  regions.runs.resize(regions.rowBegin.back());
  std::vector<std::size_t> next(regions.rowBegin.begin(), regions.rowBegin.end() - 1);
  overRows([&](std::size_t row, int begin, int end) {
    regions.runs[next[row]++] = {begin, end, 0};
  });

  DisjointSets sets(regions.runs.size());
  const auto joinRows = [&](std::size_t rowA, std::size_t rowB) {
    std::size_t a = regions.rowBegin[rowA], b = regions.rowBegin[rowB];
    const std::size_t aEnd = regions.rowBegin[rowA + 1], bEnd = regions.rowBegin[rowB + 1];
    const auto at = [&](std::size_t row, int x) {
      return Vec3i{x, static_cast<int>(row % ny), static_cast<int>(row / ny)};
    };
    while (a < aEnd && b < bEnd) {
      const Regions::Run &runA = regions.runs[a], &runB = regions.runs[b];
      // Rows are covered without gaps, so these two overlap.
      if (key(at(rowA, runA.begin)) == key(at(rowB, runB.begin))) {
        sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
      }
      const int endA = runA.end, endB = runB.end;
      a += endA <= endB;
      b += endB <= endA;
    }
  };
  for (std::size_t row = 0; row < rows; ++row) {
    if (row % ny > 0) joinRows(row - 1, row);
    if (row >= ny) joinRows(row - ny, row);
  }
  const std::vector<std::uint32_t> number = sets.numbered(&regions.count);
  for (std::size_t r = 0; r < regions.runs.size(); ++r) regions.runs[r].region = number[r];
  return regions;
}

/// How many regions of cells there are that `inside` holds of.
template <class Inside>
std::uint32_t countPieces(const Vec3i& size, const Inside& inside) {
  const Regions regions = findRegions(size, inside);
  std::vector<std::uint8_t> counts(regions.count);
  regions.forEachRun(
      [&](const Regions::Run& run, const Vec3i& first) { counts[run.region] = inside(first); });
  return static_cast<std::uint32_t>(std::count(counts.begin(), counts.end(), 1));
}

}  // namespace exemplar
