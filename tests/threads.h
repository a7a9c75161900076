// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

namespace exemplar::testing {

/// What `make()` returns when `threads` threads work on it, whatever the number of cores.
template <class Make>
auto onThreads(int threads, const Make& make) {
  tbb::task_arena arena(threads);
  return arena.execute(make);
}

/// Expects the same result of `make()` at one and at eight threads.
template <class Make>
void expectSameAtAnyThreads(const Make& make) {
  EXPECT_TRUE(onThreads(1, make) == onThreads(8, make));
}

}  // namespace exemplar::testing
