// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// How long geometry synthesis takes, all cores, in samples of the result a second. Block copying
// by the paper's search tree is the baseline of every other way to search, which give the same
// bytes; quilting is the default engine of plain examples, voting that of everything else. n is the
// side of the example and half that of the result.

#include <benchmark/benchmark.h>

#include <cstdlib>

#include "synth/geometry/blocks.h"
#include "synth/geometry/quilting/quilting.h"
#include "synth/geometry/seams/seams.h"
#include "synth/geometry/voting/voting.h"
#include "tests/synth/fields.h"

namespace exemplar {
namespace {

DistanceField packing(int n) { return testing::balls({n, n, n}, 5, 1); }

void count(benchmark::State& state, const Vec3i& size) {
  state.counters["samples_per_second"] = benchmark::Counter(
      static_cast<double>(volume(size)), benchmark::Counter::kIsIterationInvariantRate);
}

/// Balls n³ to (3n/2)³, or ground n x n x n/2 to twice that in the plane.
void blocks(benchmark::State& state, BlockSearch search, bool ground) {
  const int n = static_cast<int>(state.range(0));
  const DistanceField example = ground ? testing::ground({n, n, n / 2}, 1) : packing(n);
  BlocksOptions options;
  options.size = ground ? Vec3i{2 * n, 2 * n, n / 2} : Vec3i{3 * n / 2, 3 * n / 2, 3 * n / 2};
  options.search = search;
  SynthesisResult result;
  for (auto _ : state) result = synthesizeBlocks(example, options);
  if (testing::samplesNotCopied(example, result) != 0) std::abort();
  count(state, options.size);
}

void quilted(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const DistanceField example = packing(n);
  QuiltingOptions options;
  options.size = {2 * n, 2 * n, 2 * n};
  SynthesisResult result;
  for (auto _ : state) result = synthesizeByQuilting(example, options);
  for (const Origin& origin : result.origins.values()) {
    if (!example.values.contains(origin.cell())) std::abort();
  }
  count(state, options.size);
}

void voted(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const DistanceField example = packing(n);
  const Vec3i size{2 * n, 2 * n, 2 * n};
  SynthesisResult result;
  for (auto _ : state) result = synthesizeByVoting(example, {.size = size});
  for (const Origin& origin : result.origins.values()) {
    if (!example.values.contains(origin.cell())) std::abort();
  }
  count(state, size);
}

/// Seams between random cubes of an example: more than any engine leaves.
void seams(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const DistanceField example = packing(n);
  const Vec3i size{2 * n, 2 * n, 2 * n};
  Origins start(size);
  Array3D<float> target(size);
  for (std::size_t s = 0; s < start.count(); ++s) {
    const Vec3i p = start.ijk(s), cube{p.x / 9, p.y / 9, p.z / 9};
    const Vec3i moved = p + cube * 4;
    start[p] = Origin({moved.x % n, moved.y % n, moved.z % n});
    target[p] = example.values[start[p].cell()];
  }
  const std::int64_t before = seamCost(example.values, target, start);
  Origins origins;
  for (auto _ : state) {
    origins = start;
    refineSeams(example.values, target, origins);
  }
  if (seamCost(example.values, target, origins) > before) std::abort();
  count(state, size);
}

BENCHMARK_CAPTURE(blocks, tree, BlockSearch::Tree, false)
    ->Name("blocks/balls/by_tree")
    ->Arg(32)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blocks, scan, BlockSearch::Scan, false)
    ->Name("blocks/balls/by_scan")
    ->Arg(32)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blocks, groundTree, BlockSearch::Tree, true)
    ->Name("blocks/ground/by_tree")
    ->Arg(64)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(blocks, groundScan, BlockSearch::Scan, true)
    ->Name("blocks/ground/by_scan")
    ->Arg(64)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(quilted)
    ->Name("quilting/balls")
    ->Arg(32)
    ->Arg(64)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(voted)->Name("voting/balls")->Arg(32)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(seams)->Name("seams/cubes")->Arg(32)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace exemplar
