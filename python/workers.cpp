// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "python/workers.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace exemplar::python {
namespace {

struct Worker {
  std::mutex mutex;
  std::condition_variable given;
  std::function<void()> work;
};

/// Those of one process. Neither they nor their threads are ever ended but by the process's end:
/// a thread may still be on its way back when the module is taken down.
struct Workers {
  long process = 0;
  std::mutex mutex;
  std::vector<Worker*> idle;

  void loop(Worker& own) {
    while (true) {
      std::function<void()> work;
      {
        std::unique_lock lock(own.mutex);
        own.given.wait(lock, [&] { return static_cast<bool>(own.work); });
        work = std::exchange(own.work, {});
      }
      work();
      const std::lock_guard lock(mutex);
      idle.push_back(&own);
    }
  }
};

}  // namespace

void onAWorker(std::function<void()> work, long process) {
  static Workers* workers = nullptr;
  if (workers == nullptr || workers->process != process) {
    workers = new Workers;
    workers->process = process;
  }
  Worker* worker = nullptr;
  {
    const std::lock_guard lock(workers->mutex);
    if (!workers->idle.empty()) {
      worker = workers->idle.back();
      workers->idle.pop_back();
    }
  }
  const bool isNew = worker == nullptr;
  if (isNew) worker = new Worker;
  {
    const std::lock_guard lock(worker->mutex);
    worker->work = std::move(work);
  }
  worker->given.notify_one();
  if (isNew) std::thread([all = workers, worker] { all->loop(*worker); }).detach();
}

}  // namespace exemplar::python
