// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <string_view>
#include <thread>
#include <vector>

#include "core/progress.h"

// Checks of how long work reports its progress and hears that it should stop.

namespace exemplar {

/// The fractions that `work(progress)` reports.
template <class Work>
std::vector<double> reportedFractions(const Work& work) {
  std::vector<double> fractions;
  work(Progress([&](std::string_view, double fraction) { fractions.push_back(fraction); }));
  return fractions;
}

/// Runs `work(progress)` until `reports` reports have been made, the last of which cancels it.
/// Returns whether it threw `Cancelled`.
template <class Work>
bool stopsAfter(std::size_t reports, const Work& work) {
  std::atomic<bool> cancel = reports == 0;
  std::size_t seen = 0;
  const Progress progress([&](std::string_view, double) { cancel = ++seen >= reports; }, &cancel);
  try {
    work(progress);
  } catch (const Cancelled&) {
    return true;
  }
  return false;
}

/// Expects that the fractions of `work(progress)` rise from 0 to 1, `least` of them at least, and
/// that it throws `Cancelled` wherever it is cancelled: before it begins, after any report but the
/// last (some are tried), and from another thread.
template <class Work>
void expectReportsAndStops(const Work& work, std::size_t least) {
  std::vector<double> fractions = reportedFractions(work);
  ASSERT_FALSE(fractions.empty());
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_EQ(fractions.back(), 1);
  for (std::size_t n = 1; n < fractions.size(); ++n) ASSERT_LE(fractions[n - 1], fractions[n]);

  // With one thread the number of reports is the same in every run.
  tbb::task_arena one(1);
  one.execute([&] { fractions = reportedFractions(work); });
  const std::size_t count = fractions.size();
  EXPECT_GE(count, least);
  for (const std::size_t reports :
       {std::size_t{0}, std::size_t{1}, count / 4, count / 2, count * 3 / 4, count - 1}) {
    one.execute(
        [&] { EXPECT_TRUE(stopsAfter(reports, work)) << "after " << reports << " of " << count; });
  }
  // With more threads there may be more reports than that.
  one.execute([&] { EXPECT_FALSE(stopsAfter(count + 1, work)); });

  std::atomic<bool> half = false, cancel = false;
  std::thread other([&] {
    half.wait(false);
    cancel = true;
    cancel.notify_all();
  });
  const Progress progress(
      [&](std::string_view, double fraction) {
        if (fraction < 0.5) return;
        half = true;
        half.notify_all();
        cancel.wait(false);
      },
      &cancel);
  EXPECT_THROW(work(progress), Cancelled);
  half = true;
  half.notify_all();
  other.join();
}

}  // namespace exemplar
