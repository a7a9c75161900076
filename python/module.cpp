// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "python/shared.h"

#include <pybind11/stl.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>

#include "core/error.h"
#include "python/workers.h"

namespace exemplar::python {
namespace {

/// How often the caller's thread looks up.
constexpr std::chrono::milliseconds kWake{50};

/// What the caller's thread and the one that works for it share.
struct Call {
  std::atomic<bool> cancel{false};
  ProgressMeter meter;
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr failure;
};

}  // namespace

void runUnlocked(const Waiting& waiting, const std::function<void(const Progress&)>& work) {
  // The worker lets go of it last, which may be after the caller has seen that it is done.
  const auto call = std::make_shared<Call>();
  const int threads = waiting.threads;
  const auto run = [&work, threads, call] {
    const Progress progress(
        [&](std::string_view stage, double fraction) { call->meter.report(stage, fraction); },
        &call->cancel);
    try {
      if (threads > 0) {
        tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
        arena.execute([&] { work(progress); });
      } else {
        work(progress);
      }
    } catch (...) {
      call->failure = std::current_exception();
    }
    const std::lock_guard lock(call->mutex);
    call->done = true;
    call->ended.notify_one();
  };

  std::exception_ptr raised;  // by Python, while waiting
  onAWorker(run, py::module_::import("os").attr("getpid")().cast<long>());
  {
    const py::gil_scoped_release unlocked;
    std::unique_lock lock(call->mutex);
    while (!call->ended.wait_for(lock, kWake, [&] { return call->done; })) {
      if (call->cancel.load()) continue;
      lock.unlock();
      {
        const py::gil_scoped_acquire locked;
        try {
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
          const ProgressState state = call->meter.state();
          if (!waiting.progress.is_none() && !state.stage.empty()) {
            const py::object answer = waiting.progress(state.stage, state.fraction);
            if (answer.is(py::bool_(false))) call->cancel.store(true);
          }
        } catch (...) {
          raised = std::current_exception();
          call->cancel.store(true);
        }
      }
      lock.lock();
    }
  }
  if (raised) std::rethrow_exception(raised);
  if (call->failure) std::rethrow_exception(call->failure);
}

Vec3d vectorOf(const std::vector<double>& values, const std::string& name) {
  if (values.size() != 3) throw InputError(name + ": three numbers are wanted");
  return {values[0], values[1], values[2]};
}

Vec3i sidesOf(const py::object& given, const std::string& name) {
  if (py::isinstance<py::int_>(given)) {
    const int side = given.cast<int>();
    return {side, side, side};
  }
  const auto sides = given.cast<std::vector<int>>();
  if (sides.size() != 3) throw InputError(name + ": one or three whole numbers are wanted");
  return {sides[0], sides[1], sides[2]};
}

Axes axesOf(const py::object& given, const std::string& name) {
  if (given.is_none()) return {};
  if (py::isinstance<py::str>(given)) {
    const auto text = given.cast<std::string>();
    return parseAxes(text, "`" + name + "` " + text);
  }
  const auto on = given.cast<std::vector<bool>>();
  if (on.size() != 3) throw InputError(name + ": \"x,y\", or three truth values, are wanted");
  return {on[0], on[1], on[2]};
}

Origins originsOf(const py::object& given) {
  if (given.is_none()) return {};
  const auto array = given.cast<py::array_t<std::int16_t, py::array::forcecast>>();
  if (array.ndim() != 4 || array.shape(3) != 3)
    throw InputError("origins: an array of nx x ny x nz x 3 is wanted");
  const auto values = array.unchecked<4>();
  Origins origins({static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)),
                   static_cast<int>(array.shape(2))});
  for (int k = 0; k < origins.size().z; ++k)
    for (int j = 0; j < origins.size().y; ++j)
      for (int i = 0; i < origins.size().x; ++i)
        origins(i, j, k) = Origin({values(i, j, k, 0), values(i, j, k, 1), values(i, j, k, 2)});
  return origins;
}

Settings settingsOf(const Given& given) {
  Settings settings;
  for (const auto& [key, text] : given) settings.add(key, text);
  return settings;
}

std::string spelledAsKeywords(const std::string& message) {
  return spelled(message, [](std::string_view key) {
    std::string keyword(key);
    for (char& c : keyword)
      if (c == '-') c = '_';
    return "`" + keyword + "`";
  });
}

}  // namespace exemplar::python

PYBIND11_MODULE(_core, module) {
  using namespace exemplar::python;
  module.attr("__version__") = EXEMPLAR_VERSION;
  static py::exception<exemplar::InputError> inputError(module, "InputError", PyExc_ValueError);
  static py::exception<exemplar::Cancelled> cancelled(module, "Cancelled");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const exemplar::InputError& e) {
      inputError(spelledAsKeywords(e.what()).c_str());
    } catch (const exemplar::Cancelled& e) {
      cancelled(e.what());
    }
  });
  addGeometry(module);
  addParts(module);
  addLabelParts(module);
  addSearch(module);
  addEngine(module);
  addWorld(module);
}
