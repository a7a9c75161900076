// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "engine/engine.h"

namespace exemplar {

/// How far a job is.
struct JobState {
  bool running = false;
  bool finished = false;  ///< `take` has something to give
  ProgressState progress;
};

/// A synthesis that runs on a thread of its own, for whoever must not wait: an editor, a notebook.
/// Not thread-safe itself: one thread starts, polls, cancels and takes.
class Job {
 public:
  Job();
  /// Cancels and waits.
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Begins `engine.run`. Throws `std::logic_error` while another is running or waits to be taken.
  void start(std::vector<Example> examples, Request request, const Engine& engine);
  /// Begins any work that ends with a result: reading, synthesizing, adding detail.
  void start(std::function<Result(const Progress&)> work);

  /// Quick, at any time.
  JobState poll() const;
  /// Asks the work to stop; its result then has `Outcome::Cancelled`.
  void cancel();
  /// Waits for the work and gives its result, once; throws what it threw (`InputError`, ...), but
  /// for `Cancelled`, which is an outcome.
  Result take();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace exemplar
