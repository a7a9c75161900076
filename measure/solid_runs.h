// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/progress.h"
#include "measure/occupancy.h"

namespace exemplar {

/// The solid of a volume as runs of cells along x, those of one connected component (by cells'
/// faces) with one number. 12 bytes a run. Throws `Cancelled`.
class SolidRuns {
 public:
  /// Solid cells x0..x1 (excluded) of one row.
  struct Run {
    int x0, x1;
    std::uint32_t id;
  };

  explicit SolidRuns(const Occupancy& occupancy, const Progress& progress = {});

  /// Those of row (y, z), by x.
  std::span<const Run> row(int y, int z) const {
    const std::size_t r = static_cast<std::size_t>(z) * rowsPerLayer_ + y;
    return std::span(runs_).subspan(rowStart_[r], rowStart_[r + 1] - rowStart_[r]);
  }
  /// One run's number that stands for all of its component.
  std::uint32_t component(const Run& run) { return sets_.find(run.id); }
  std::size_t count() const { return runs_.size(); }

  /// Calls `touch(a, b)` for each two runs of two rows that have an x in common.
  template <class Touch>
  static void forEachOverlap(std::span<const Run> a, std::span<const Run> b, const Touch& touch) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (a[i].x0 < b[j].x1 && b[j].x0 < a[i].x1) touch(a[i], b[j]);
      if (a[i].x1 < b[j].x1) {
        ++i;
      } else {
        ++j;
      }
    }
  }

 private:
  std::size_t rowsPerLayer_;
  std::vector<Run> runs_;
  std::vector<std::size_t> rowStart_;  ///< rows in order of y, then z
  DisjointSets sets_;
};

}  // namespace exemplar
