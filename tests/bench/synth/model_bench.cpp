// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Model synthesis: model/<method>/<example>/<x>x<y>x<z>/<threads>, each beside plain one-pass
// propagation by AC-4 (baseline/ac4/...), with the share of seeds that complete.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "ac4_baseline.h"
#include "synth/model/examples.h"
#include "synth/model/synthesize.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

struct Example {
  const char* name;
  LabelGrid (*make)();
};
constexpr Example kExamples[] = {{"canyon", test::canyon},
                                 {"city", test::city},
                                 {"gadgets", test::gadgets},
                                 {"parliament", test::parliament},
                                 {"escheresque", test::escheresque}};

/// Resets the largest resident size, where the system can.
void forgetPeak() {
  if (std::FILE* f = std::fopen("/proc/self/clear_refs", "w")) {
    std::fputs("5", f);
    std::fclose(f);
  }
}

/// A line of /proc/self/status in bytes: the resident size now (VmRSS) or at most (VmHWM).
double residentBytes(const char* key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == std::string(key) + ":" && status >> kilobytes) return 1024 * kilobytes;
  }
  return 0;
}

void synthesize(benchmark::State& state, const LabelGrid& example, const ModelOptions& wanted,
                int threads) {
  const Adjacency adjacency = findAdjacency(example);
  ModelOptions o = wanted;
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(threads);
  std::int64_t complete = 0;
  forgetPeak();
  const double before = residentBytes("VmRSS");
  for (auto _ : state) {
    ModelResult r;
    arena.execute([&] { r = synthesizeModel(std::span(&example, 1), adjacency, o); });
    complete += r.outcome == Outcome::Complete;
    state.PauseTiming();
    if (r.outcome == Outcome::Complete && o.seed == wanted.seed &&
        findViolations(r.grid(), example).count != 0) {
      state.SkipWithError("a pair of labels that the example does not show");
    }
    ++o.seed;
    state.ResumeTiming();
  }
  const double cells = static_cast<double>(volume(o.size));
  state.counters["cells/s"] = benchmark::Counter(cells * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate);
  state.counters["complete"] =
      static_cast<double>(complete) / static_cast<double>(state.iterations());
  state.counters["MB"] = (residentBytes("VmHWM") - before) / 1e6;
}

void baseline(benchmark::State& state, const LabelGrid& example, const Vec3i& size) {
  const Adjacency adjacency = findAdjacency(example);
  std::uint64_t seed = 0, bytes = 0;
  std::int64_t complete = 0;
  for (auto _ : state) {
    const bench::Ac4Result r = bench::synthesizeByAc4(adjacency, size, seed++);
    complete += r.complete;
    bytes = std::max(bytes, r.bytes);
  }
  const double cells = static_cast<double>(volume(size));
  state.counters["cells/s"] = benchmark::Counter(cells * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate);
  state.counters["complete"] =
      static_cast<double>(complete) / static_cast<double>(state.iterations());
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
}

std::string words(const Vec3i& n) {
  return std::to_string(n.x) + "x" + std::to_string(n.y) + "x" + std::to_string(n.z);
}

const bool kRegistered = [] {
  for (const Example& e : kExamples) {
    const LabelGrid example = e.make();
    std::vector<Vec3i> sizes{{40, 40, 10}, {80, 80, 10}};
    if (std::string(e.name) == "canyon" || std::string(e.name) == "city") {
      sizes.push_back({200, 200, 20});
    }
    for (const Vec3i& n : sizes) {
      ModelOptions o;
      o.size = n;
      o.choice = LabelChoice::Uniform;
      o.sides[0].kind = o.sides[1].kind = SideRule::Kind::Free;
      o.sides[2].kind = o.sides[3].kind = SideRule::Kind::Free;
      const std::string place = std::string(e.name) + "/" + words(n);
      o.method = ModelMethod::Whole;
      benchmark::RegisterBenchmark(("model/whole/" + place + "/1").c_str(),
                                   [=](benchmark::State& s) { synthesize(s, example, o, 1); })
          ->Unit(benchmark::kMillisecond);
      o.method = ModelMethod::Blocks;
      for (const int threads : {1, 2}) {
        benchmark::RegisterBenchmark(
            ("model/blocks/" + place + "/" + std::to_string(threads)).c_str(),
            [=](benchmark::State& s) { synthesize(s, example, o, threads); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
      }
      if (volume(n) > 100000) continue;
      benchmark::RegisterBenchmark(("baseline/ac4/" + place + "/1").c_str(),
                                   [=](benchmark::State& s) { baseline(s, example, n); })
          ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace exemplar
