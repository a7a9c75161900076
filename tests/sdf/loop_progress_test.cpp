// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/loop_progress.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "tests/sdf/cancellation.h"

namespace exemplar {
namespace {

TEST(LoopProgress, ReportsFromAnyThreadAndNeverFalls) {
  const auto loop = [](const Progress& progress) {
    progress.report("looping", 0);
    LoopProgress done(progress, "looping", 10000);
    parallelFor(0, 10000, 1, [&](std::size_t b, std::size_t e) { done.advance(e - b); });
    progress.report("looping", 1);
  };
  expectReportsAndStops(loop, 50);
  tbb::task_arena eight(8);
  const std::vector<double> fractions = eight.execute([&] { return reportedFractions(loop); });
  EXPECT_LE(fractions.size(), 103u);
  for (std::size_t n = 1; n < fractions.size(); ++n) EXPECT_LE(fractions[n - 1], fractions[n]);
}

TEST(LoopProgress, HearsCancellationAtEveryStep) {
  std::atomic<bool> cancel = false;
  LoopProgress done(Progress({}, &cancel), "looping", 1000000);
  done.advance();
  cancel = true;
  EXPECT_THROW(done.advance(), Cancelled);
  EXPECT_THROW(done.check(), Cancelled);
}

}  // namespace
}  // namespace exemplar
