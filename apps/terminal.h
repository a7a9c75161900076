// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <chrono>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/progress.h"

namespace exemplar {

/// Thrown between two steps of a command when the user has pressed Ctrl-C; exit status 4.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; no file was written") {}
};

/// The user at the terminal: sees how far the work is, may stop it by Ctrl-C.
///
/// On a terminal one line on stderr tells the stage, its percentage and an estimate of the time
/// left; elsewhere each stage is named once when it begins. Ctrl-C asks the work to stop; a second
/// one ends the process at once.
class Terminal {
 public:
  explicit Terminal(bool quiet = false);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// What to hand to long work; valid as long as this object.
  const Progress& progress() const { return progress_; }
  /// Wipes the progress line and begins a new step; throws `Interrupted` when Ctrl-C was pressed.
  void step(std::string_view stage);
  /// Wipes the progress line and prints one line of the summary to stdout: a label and its text.
  void say(std::string_view label, const std::string& text);
  /// Wipes the progress line.
  void wipe();
  /// Throws `Interrupted` when Ctrl-C was pressed.
  void stopIfInterrupted() const;

 private:
  void show(std::string_view stage, double fraction);

  bool quiet_, interactive_;
  std::mutex mutex_;
  std::string stage_;
  std::chrono::steady_clock::time_point began_, shown_;
  std::size_t width_ = 0;
  Progress progress_;
};

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// "12,345,678".
std::string withThousands(long long n);
/// "0.83 s", "12 s", "3 min 20 s".
std::string readableSeconds(double seconds);
/// "812 MB".
std::string readableBytes(double bytes);

}  // namespace exemplar
