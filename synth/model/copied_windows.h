// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/patch_sources.h"
#include "synth/model/problem.h"

namespace exemplar {

/// Which windows of 8 x 8 columns of a result stand verbatim in the example, over the full height
/// and in all frames: what a result must not consist of. Windows that are alike all over, as ground
/// under air is, do not count. Where the example or the result is narrower, windows are, too; where
/// one is higher, the lower one's height counts.
class CopiedWindows {
 public:
  CopiedWindows(const ModelProblem& problem, std::span<const PatchSource> sources);

  /// Finds all copies in a result: a label for each position.
  void count(std::span<const Label> grid, const Progress& progress = {});

  struct Window {
    std::int32_t place;  ///< x * size.y + y of its first column
    bool copied;         ///< now
  };
  struct Change {
    std::vector<std::pair<std::int32_t, std::uint64_t>> columns;  ///< those that differ now
    std::vector<Window> windows;                                  ///< those whose answer differs
    std::vector<std::uint64_t> hashes, sums;                      // scratch
  };
  /// What differs in the columns from `low` to before `high`, of which `grid` shows new labels;
  /// returns how many more copies there are. What goes over a periodic side continues there.
  int look(std::span<const Label> grid, const Vec3i& low, const Vec3i& high, Change& change) const;
  void keep(const Change& change);

  std::int64_t copies() const { return copies_; }
  std::int64_t windows() const { return static_cast<std::int64_t>(copied_.size()); }

 private:
  std::uint64_t column(const Label* lowest, std::int64_t step) const;
  bool shows(std::uint64_t hash) const;

  const ModelProblem* problem_;
  Vec3i size_;
  Axes periodic_;
  int wideX_, wideY_, high_, frames_;
  std::vector<std::uint64_t> known_;  // windows of the example; sorted by hash in a table, 0: none
  std::vector<std::uint64_t> column_;
  std::vector<std::uint8_t> copied_;
  std::int64_t copies_ = 0;
};

}  // namespace exemplar
