// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <string_view>
#include <vector>

#include "core/progress.h"

namespace exemplar::testing {

/// Runs `work(progress)` once to its end, and expects at least `least` reports whose fractions only
/// rise, within 0..1. Then cancels it before it begins and at its first, middle and last report,
/// and expects `Cancelled` each time. The work must not be slow: it runs up to five times.
template <class Work>
void expectReportsAndStops(std::size_t least, const Work& work) {
  std::vector<double> fractions;
  work(Progress([&](std::string_view, double fraction) { fractions.push_back(fraction); }));
  ASSERT_GE(fractions.size(), least);
  double before = 0;
  for (const double fraction : fractions) {
    EXPECT_GE(fraction, before);
    EXPECT_LE(fraction, 1);
    before = fraction;
  }
  std::atomic<bool> cancel = true;
  EXPECT_THROW(work(Progress({}, &cancel)), Cancelled);
  // Which report is the last depends on the threads; one in four of them is there in every run.
  for (const std::size_t at : {std::size_t{0}, fractions.size() / 8, fractions.size() / 4}) {
    cancel = false;
    std::size_t reports = 0;
    const Progress progress([&](std::string_view, double) { cancel = reports++ >= at; }, &cancel);
    EXPECT_THROW(work(progress), Cancelled) << "at report " << at << " of " << fractions.size();
  }
}

}  // namespace exemplar::testing
