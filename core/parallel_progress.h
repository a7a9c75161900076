// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <mutex>
#include <string_view>

#include "core/progress.h"

namespace exemplar {

/// Reports how many of the equal steps of parallel work are done, in whatever order they end: the
/// fraction only rises. What it is made with outlives it.
class ParallelProgress {
 public:
  ParallelProgress(const Progress& progress, std::string_view stage, std::size_t steps)
      : progress_(progress), stage_(stage), steps_(steps) {}

  /// Says that `steps` more are done. From any thread. Throws `Cancelled` where the work should
  /// stop.
  void done(std::size_t steps = 1) {
    const std::lock_guard lock(mutex_);
    done_ += steps;
    progress_.report(stage_, static_cast<double>(done_) / static_cast<double>(steps_));
  }
  /// Throws `Cancelled` where the work should stop. Quick.
  void check() const { progress_.check(); }

 private:
  const Progress& progress_;
  std::string_view stage_;
  std::size_t steps_, done_ = 0;
  std::mutex mutex_;
};

}  // namespace exemplar
