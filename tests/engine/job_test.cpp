// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/error.h"
#include "engine/engines.h"
#include "tests/engine/examples.h"

namespace exemplar {
namespace {

TEST(Job, GivesWhatTheEngineGives) {
  const Example example = readExample(Source::of(rings()));
  Request request;
  request.extent.size = Vec3i{20, 20, 1};
  request.seed = 4;
  Job job;
  EXPECT_FALSE(job.poll().running);
  job.start({example}, request, modelEngine());
  const Result result = job.take();
  EXPECT_EQ(result.labels().cells, modelEngine().run({&example, 1}, request).labels().cells);
  EXPECT_FALSE(job.poll().finished);
}

TEST(Job, CancelsAndMayBeStartedAgain) {
  Job job;
  std::atomic<bool> began = false;
  job.start([&](const Progress& progress) -> Result {
    while (true) {
      progress.report("turning in circles", 0.5);
      began = true;
      std::this_thread::yield();
    }
  });
  while (!began) std::this_thread::yield();
  EXPECT_TRUE(job.poll().running);
  EXPECT_EQ(job.poll().progress.stage, "turning in circles");
  EXPECT_EQ(job.poll().progress.fraction, 0.5);
  EXPECT_THROW(job.start([](const Progress&) { return Result{}; }), std::logic_error);
  job.cancel();
  EXPECT_EQ(job.take().outcome, Outcome::Cancelled);
  job.start([](const Progress&) { return Result{.why = "again"}; });
  EXPECT_EQ(job.take().why, "again");
}

TEST(Job, CarriesErrorsToWhoTakesTheResult) {
  Job job;
  job.start([](const Progress&) -> Result { throw InputError("no such thing"); });
  EXPECT_THROW(job.take(), InputError);
  EXPECT_THROW(job.take(), std::logic_error);
}

TEST(Job, EndsWithItsWork) {
  std::atomic<bool> ended = false;
  {
    Job job;
    job.start([&](const Progress& progress) -> Result {
      try {
        while (true) progress.check();
      } catch (const Cancelled&) {
        ended = true;
        throw;
      }
    });
  }
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace exemplar
