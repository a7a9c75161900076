// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/progress.h"

#include <algorithm>

namespace exemplar {
namespace {

/// Before so much is done, or so many seconds have passed, an estimate would be a guess.
constexpr double kLeastFraction = 0.02, kLeastSeconds = 1;

}  // namespace

void ProgressMeter::report(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  state_.stage = stage;
  state_.fraction = std::clamp(fraction, state_.fraction, 1.0);
}

ProgressState ProgressMeter::state() const {
  const std::lock_guard lock(mutex_);
  ProgressState state = state_;
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  if (elapsed > kLeastSeconds && state.fraction > kLeastFraction) {
    state.secondsLeft = elapsed * (1 - state.fraction) / state.fraction;
  }
  return state;
}

}  // namespace exemplar
