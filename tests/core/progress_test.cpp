// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/progress.h"

#include <gtest/gtest.h>

#include <vector>

namespace exemplar {
namespace {

TEST(Progress, PartsOfPartsMakeOneFraction) {
  std::vector<double> seen;
  const Progress whole([&](std::string_view, double fraction) { seen.push_back(fraction); });
  const Progress half = whole.part(0.5, 1);
  half.report("a", 0);
  half.part(0.5, 1).report("b", 0.5);
  half.report("c", 2);  // beyond its end is its end
  EXPECT_EQ(seen, (std::vector<double>{0.5, 0.875, 1}));
}

TEST(Progress, ThrowsWhereItWasCancelled) {
  std::atomic<bool> cancel = false;
  int reports = 0;
  const Progress progress([&](std::string_view, double) { ++reports; }, &cancel);
  const Progress part = progress.part(0, 0.5);
  part.report("", 0);
  part.check();
  cancel = true;
  EXPECT_TRUE(part.cancelled());
  EXPECT_THROW(part.check(), Cancelled);
  EXPECT_THROW(part.report("", 1), Cancelled);
  EXPECT_EQ(reports, 1);
  EXPECT_NO_THROW(Progress().check());
}

TEST(ProgressMeter, NeverFalls) {
  ProgressMeter meter;
  EXPECT_EQ(meter.state().stage, "");
  meter.report("reading", 0.4);
  meter.report("searching", 0.1);
  EXPECT_EQ(meter.state().stage, "searching");
  EXPECT_EQ(meter.state().fraction, 0.4);
  meter.report("writing", 7);
  EXPECT_EQ(meter.state().fraction, 1);
  EXPECT_FALSE(meter.state().secondsLeft);  // too soon to say
}

}  // namespace
}  // namespace exemplar
