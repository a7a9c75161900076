// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace exemplar {

/// Thrown out of work whose `Progress` was cancelled, so that cancellation never travels as an
/// empty or half-made value. Whoever started the work catches it: the engines
/// (`Outcome::Cancelled`), a `Job`, the command. No `InputError`, and no error at all.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

/// How long work reports how far it is, and hears that it should stop: one parameter for both.
///
/// A default-constructed one is silent and never cancels. `report` may be called from any thread
/// that runs the work, one at a time.
class Progress {
 public:
  /// `stage` is what is being done ("matching, level 2 of 3"), `fraction` how much of the whole
  /// work is done: 0..1.
  using Report = std::function<void(std::string_view stage, double fraction)>;

  Progress() = default;
  explicit Progress(Report report, const std::atomic<bool>* cancel = nullptr)
      : report_(std::move(report)), cancel_(cancel) {}

  /// Says that `fraction` (0..1) of this work is done. Throws `Cancelled` where it should stop.
  void report(std::string_view stage, double fraction) const {
    check();
    if (report_)
      report_(stage, from_ + (to_ - from_) * (fraction < 0 ? 0 : fraction < 1 ? fraction : 1));
  }
  /// Throws `Cancelled` where the work should stop. Quick: call it in inner loops.
  void check() const {
    if (cancelled()) throw Cancelled();
  }
  /// Whether the work should stop, for callers that cannot throw.
  bool cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

  /// What a step that does the share from `from` to `to` of this work (0 <= from <= to <= 1)
  /// reports to: its own 0..1 is that share.
  Progress part(double from, double to) const {
    Progress part = *this;
    part.from_ = from_ + (to_ - from_) * from;
    part.to_ = from_ + (to_ - from_) * to;
    return part;
  }

 private:
  Report report_;
  const std::atomic<bool>* cancel_ = nullptr;
  double from_ = 0, to_ = 1;
};

/// How far work is, as somebody who waits for it sees it.
struct ProgressState {
  std::string stage;                  ///< what is being done; empty before the first report
  double fraction = 0;                ///< of the whole work, 0..1; never falls
  std::optional<double> secondsLeft;  ///< an estimate, once there is something to go by
};

/// Takes reports from a `Progress` and keeps what they amount to. Thread-safe.
class ProgressMeter {
 public:
  ProgressMeter() : began_(std::chrono::steady_clock::now()) {}

  void report(std::string_view stage, double fraction);
  ProgressState state() const;

 private:
  mutable std::mutex mutex_;
  std::chrono::steady_clock::time_point began_;
  ProgressState state_;
};

}  // namespace exemplar
