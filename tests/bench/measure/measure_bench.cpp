// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// How long measuring takes: n³ samples against n³, all cores. White noise is the worst case of the
// window search, since its bounds then decide nothing. `likeness_by_linear_search` is the baseline:
// every window against every other, a word at a time, without bounds (on a hundredth of the work).

#include <benchmark/benchmark.h>

#include <array>
#include <bit>
#include <cstdlib>
#include <vector>

#include "measure/measure.h"
#include "tests/measure/fields.h"

namespace exemplar {
namespace {

DistanceField packing(int n, std::uint64_t seed) { return testing::ballPacking({n, n, n}, seed); }

void count(benchmark::State& state, int n) {
  state.counters["voxels_per_second"] =
      benchmark::Counter(1.0 * n * n * n, benchmark::Counter::kIsIterationInvariantRate);
}

void all(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const DistanceField example = packing(n, 1), result = packing(n, 2);
  const Origins origins = testing::makeOrigins({n, n, n}, [&](const Vec3i& p) {
    return Origin({p.x * 3 % n, p.y, p.z});
  });
  for (auto _ : state) {
    const Measures m = measure(example, result, {.origins = &origins});
    if (!(m.likeness.dense.meanIou > 0.5)) std::abort();
  }
  count(state, n);
}

void likenessOfNoise(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Occupancy a(testing::noise({n, n, n}, 0.25, 1)), b(testing::noise({n, n, n}, 0.25, 2));
  for (auto _ : state) benchmark::DoNotOptimize(patchLikeness(a, b));
  count(state, n);
}

void likenessOfBalls(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Occupancy a(packing(n, 1)), b(packing(n, 2));
  PatchLikeness likeness;
  for (auto _ : state) likeness = patchLikeness(a, b);
  state.counters["pairs_per_second"] =
      benchmark::Counter(static_cast<double>(likeness.windows * likeness.references),
                         benchmark::Counter::kIsIterationInvariantRate);
}

void likenessByLinearSearch(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Occupancy volume(packing(n, 1));
  using Window = std::array<std::uint64_t, 21>;
  std::vector<Window> windows;
  for (int z = 0; z + 11 <= n; ++z)
    for (int y = 0; y + 11 <= n; ++y)
      for (int x = 0; x + 11 <= n; ++x) {
        Window w{};
        for (int bit = 0; bit < 1331; ++bit)
          if (volume.solid(x + bit % 11, y + bit / 11 % 11, z + bit / 121))
            w[bit / 64] |= std::uint64_t{1} << (bit % 64);
        windows.push_back(w);
      }
  constexpr int asked = 10;
  for (auto _ : state) {
    double sum = 0;
    for (int a = 0; a < asked; ++a) {
      double best = 0;
      for (const Window& w : windows) {
        int both = 0, either = 0;
        for (int i = 0; i < 21; ++i) {
          both += std::popcount(w[i] & windows[a * 97][i]);
          either += std::popcount(w[i] | windows[a * 97][i]);
        }
        if (either > 0) best = std::max(best, static_cast<double>(both) / either);
      }
      sum += best;
    }
    benchmark::DoNotOptimize(sum);
  }
  state.counters["pairs_per_second"] =
      benchmark::Counter(static_cast<double>(asked) * static_cast<double>(windows.size()),
                         benchmark::Counter::kIsIterationInvariantRate);
}

void distanceOfPatches(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const DistanceField a = packing(n, 1), b = packing(n, 2);
  for (auto _ : state) benchmark::DoNotOptimize(patchDistance(a, b));
}

BENCHMARK(all)
    ->Name("measure/all")
    ->Arg(64)
    ->Arg(128)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(likenessOfBalls)
    ->Name("measure/likeness_of_balls")
    ->Arg(64)
    ->Arg(128)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(likenessOfNoise)
    ->Name("measure/likeness_of_noise")
    ->Arg(64)
    ->Arg(128)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(likenessByLinearSearch)
    ->Name("measure/likeness_by_linear_search")
    ->Arg(64)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(distanceOfPatches)
    ->Name("measure/distance_of_patches")
    ->Arg(64)
    ->Arg(128)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace exemplar
