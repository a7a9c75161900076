// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "core/progress.h"

namespace exemplar::test {

/// Expects that `work(progress)` reports fractions of 0..1 that never fall, each with a stage, and
/// that it throws `Cancelled` when it is cancelled before it begins and at each of its reports.
template <class Work>
void expectHearsCancellation(const Work& work) {
  std::vector<double> fractions;
  work(Progress([&](std::string_view stage, double fraction) {
    EXPECT_FALSE(stage.empty());
    fractions.push_back(fraction);
  }));
  ASSERT_FALSE(fractions.empty());
  EXPECT_GE(fractions.front(), 0);
  EXPECT_LE(fractions.back(), 1);
  for (std::size_t n = 1; n < fractions.size(); ++n) {
    EXPECT_GE(fractions[n], fractions[n - 1]) << "report " << n;
  }
  // The last report may come when nothing is left to do.
  for (std::size_t at = 0; at < fractions.size(); ++at) {
    std::atomic<bool> cancel = at == 0;
    std::size_t reports = 0;
    const Progress progress([&](std::string_view, double) { cancel = ++reports == at || cancel; },
                            &cancel);
    EXPECT_THROW(work(progress), Cancelled) << "at report " << at;
    EXPECT_EQ(reports, at);
  }
}

}  // namespace exemplar::test
