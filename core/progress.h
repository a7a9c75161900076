// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <functional>
#include <string_view>
#include <utility>

namespace exemplar {

/// How long work tells how far it is, and hears that it should stop: one parameter for both.
///
/// A default-constructed one is silent and never cancels. `report` may be called from any thread
/// that runs the work, one at a time. Work that finds `cancelled()` returns soon with the status
/// that its result type has for it; it does not throw.
class Progress {
 public:
  /// `stage` is what is being done ("matching, level 2 of 3"), `fraction` how much of it: 0..1.
  using Report = std::function<void(std::string_view stage, double fraction)>;

  Progress() = default;
  explicit Progress(Report report, const std::atomic<bool>* cancel = nullptr)
      : report_(std::move(report)), cancel_(cancel) {}

  void report(std::string_view stage, double fraction) const {
    if (report_) report_(stage, fraction);
  }
  bool cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

 private:
  Report report_;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace exemplar
