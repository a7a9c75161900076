// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "core/progress.h"

namespace exemplar {

/// Reports the progress of a loop whose steps finish in any order, on any thread: the fraction
/// never falls, and at most about a hundred reports are made, one at a time.
class LoopProgress {
 public:
  /// `steps` in total; `progress` is that of the loop alone.
  LoopProgress(const Progress& progress, std::string_view stage, std::size_t steps)
      : progress_(progress), stage_(stage), steps_(std::max<std::size_t>(steps, 1)) {}
  LoopProgress(const LoopProgress&) = delete;
  LoopProgress& operator=(const LoopProgress&) = delete;

  /// Counts `steps` more as done. Throws `Cancelled` where the work should stop. Quick.
  void advance(std::size_t steps = 1) {
    progress_.check();
    const std::size_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
    if (done < next_.load(std::memory_order_relaxed)) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    const std::size_t now = done_.load(std::memory_order_relaxed);
    next_.store(now + steps_ / 100 + 1, std::memory_order_relaxed);
    progress_.report(stage_, static_cast<double>(now) / static_cast<double>(steps_));
  }
  /// Throws `Cancelled` where the work should stop, for long steps.
  void check() const { progress_.check(); }

 private:
  Progress progress_;
  std::string stage_;
  std::size_t steps_;
  std::atomic<std::size_t> done_ = 0, next_ = 0;
  std::mutex mutex_;
};

}  // namespace exemplar
