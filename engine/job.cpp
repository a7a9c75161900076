// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/job.h"

#include <atomic>
#include <exception>
#include <stdexcept>
#include <thread>
#include <utility>

namespace exemplar {

struct Job::Work {
  std::atomic<bool> cancel{false}, finished{false};
  ProgressMeter meter;
  Result result;
  std::exception_ptr failure;
  std::thread thread;

  void run(const std::function<Result(const Progress&)>& work) {
    const Progress progress(
        [this](std::string_view stage, double fraction) { meter.report(stage, fraction); },
        &cancel);
    try {
      result = work(progress);
    } catch (const Cancelled&) {
      result.outcome = Outcome::Cancelled;
      result.why = "cancelled";
    } catch (...) {
      failure = std::current_exception();
    }
    finished = true;
  }
};

Job::Job() = default;

Job::~Job() {
  if (!work_) return;
  cancel();
  work_->thread.join();
}

void Job::start(std::vector<Example> examples, Request request, const Engine& engine) {
  start([examples = std::move(examples), request = std::move(request),
         &engine](const Progress& progress) { return engine.run(examples, request, progress); });
}

void Job::start(std::function<Result(const Progress&)> work) {
  if (work_) throw std::logic_error("Job::start: its last result was not taken");
  auto begun = std::make_unique<Work>();
  begun->thread = std::thread([work = std::move(work), state = begun.get()] { state->run(work); });
  work_ = std::move(begun);
}

JobState Job::poll() const {
  if (!work_) return {};
  const bool finished = work_->finished;
  return {!finished, finished, work_->meter.state()};
}

void Job::cancel() {
  if (work_) work_->cancel = true;
}

Result Job::take() {
  if (!work_) throw std::logic_error("Job::take: nothing was started");
  work_->thread.join();
  const std::unique_ptr<Work> work = std::move(work_);
  if (work->failure) std::rethrow_exception(work->failure);
  return std::move(work->result);
}

}  // namespace exemplar
