// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"

namespace exemplar {

struct Conflict;

/// Version of what `ProgressStyle::Json` writes (docs/progress.md).
inline constexpr int kProgressProtocol = 1;

/// How progress is shown on standard error.
enum class ProgressStyle {
  Auto,  ///< Line on a terminal; elsewhere each stage is named once, when it first begins
  Line,  ///< one line that changes: the stage, how much of the command is done, the time left
  Json,  ///< JSON objects, one a line, for programs (docs/progress.md)
  None,
};

/// The user at the terminal: sees how far the command is, reads its summary, may stop it by Ctrl-C.
/// Ctrl-C asks the work to stop; a second one ends the process at once.
class Terminal {
 public:
  Terminal(ProgressStyle style, bool quiet);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// What to hand to long work; valid as long as this object.
  const Progress& progress() const { return progress_; }
  /// One line of the summary on standard output: a label and its text.
  void say(std::string_view label, const std::string& text);
  bool quiet() const { return quiet_; }
  /// A document on standard output, as it is, also where the summary is not wanted.
  void print(const std::string& text);
  /// No summary from here on, for a command that prints a document.
  void beQuiet() { quiet_ = true; }
  /// One line on standard error about what is doubtful or was left out.
  void warn(const std::string& text);
  /// Says that a file was written.
  void wrote(std::string_view label, const std::filesystem::path& path, const std::string& text);
  /// Notes a file for `interruption`, and reports it to programs, without a line for people.
  void noteFile(const std::filesystem::path& path, std::string_view kind = "file");
  /// Reports to programs that the command is done.
  void done();
  /// Says that it failed: one line on standard error; programs hear which pins and sides exclude
  /// each other.
  void fail(const std::string& text, int status, const Conflict* conflict = nullptr);
  /// Wipes the progress line.
  void wipe();

  /// The warnings there were.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// What an interrupted command says: which files it has written by then.
  std::string interruption() const;

 private:
  void show(std::string_view stage, double fraction);
  void event(const std::string& json);

  ProgressStyle style_;
  bool quiet_;
  std::mutex mutex_;
  ProgressMeter meter_;
  std::set<std::string> stages_;  ///< that were named
  std::chrono::steady_clock::time_point shown_;
  std::size_t width_ = 0;
  std::vector<std::string> warnings_, written_;
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

}  // namespace exemplar
