// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// How long one exact match takes, on one thread. Blocks of n/8 samples a side of one field are
// matched in another of the same process.
//
//     match/<method>/<n>/<block>[/<scene>]   one octant unknown; balls where no scene is named
//     table1/<method>/<n>/<block>            known in full, as Lagae 2004, table 1
//     build/<n>/<block>/<threads>            of the index
//     field/<method>/...                     all blocks of a target
//
// Methods: `linear`, vectorized and left early; `fft`, correlation with the source's transforms
// precomputed; `paper`, the tree of Lagae 2004, section 4; `best`, our index; in table1 also
// `exhaustive`, the paper's own kind of linear search. The time of a benchmark is the median over
// its queries of the thread's processor time. All methods must give the same answers, or the
// program aborts. At the end come the ratios, by which to judge: absolute times depend on the
// machine and its other work.

#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "cases.h"
#include "exhaustive_scan.h"
#include "fft_correlation.h"
#include "fields.h"
#include "search/block_index.h"
#include "search/linear_scan.h"
#include "search/nearest_neighbor_field.h"
#include "search/search_tree.h"

namespace exemplar::bench {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Processor time of this thread: what other work does to a shared machine's clock stays out.
double threadSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Medians by benchmark, for the ratios, and the distances found, which all methods share.
std::map<std::string, double>& medians() {
  static std::map<std::string, double> all;
  return all;
}

void agree(const std::string& what, int query, double distance) {
  static std::map<std::string, double> seen;
  const auto [entry, isNew] = seen.emplace(what + '/' + std::to_string(query), distance);
  if (isNew || entry->second == distance) return;
  std::fprintf(stderr, "%s: query %d is at distance %.9g by one method and %.9g by another\n",
               what.c_str(), query, entry->second, distance);
  std::abort();
}

using Answer = std::function<double(const Query&)>;  // the distance of a query's best match

// Times each of `queries` queries once, after one that does not count.
void timeQueries(benchmark::State& state, const std::string& group, const std::string& method,
                 const MatchCase& c, bool whole, int queries, double scale, const Answer& answer) {
  const std::string name =
      std::to_string(c.n) + '/' + std::to_string(c.block) + (group == "match" ? '/' + c.scene : "");
  std::vector<double> seconds;
  for (auto _ : state) {
    answer(c.query(-1));
    for (int q = 0; q < queries; ++q) {
      const Query query = whole ? c.wholeQuery(q) : c.query(q);
      const double start = threadSeconds();
      const double distance = answer(query);
      seconds.push_back(scale * (threadSeconds() - start));
      if (scale == 1) agree(group + '/' + name, q, distance);
    }
    state.SetIterationTime(median(seconds));
  }
  medians()[group + '/' + name + '/' + method] = median(seconds);
  state.counters["queries"] = queries;
}

int few(int n) { return n <= 64 ? 41 : n <= 128 ? 15 : 5; }

// The structures, made on first use; the last one is kept.
const BlockIndex<std::uint8_t>& indexOf(const MatchCase& c) {
  static std::string key;
  static std::unique_ptr<BlockIndex<std::uint8_t>> index;
  if (const std::string wanted = c.scene + std::to_string(c.n); key != wanted) {
    index.reset();
    index = std::make_unique<BlockIndex<std::uint8_t>>(c.source, Vec3i{c.block, c.block, c.block});
    key = wanted;
  }
  return *index;
}

void match(benchmark::State& state, const std::string& method, const std::string& scene, int n,
           bool whole) {
  const MatchCase& c = matchCase(scene, n);
  const std::string group = whole ? "table1" : "match";
  const auto run = [&](int queries, const Answer& answer, double scale = 1) {
    timeQueries(state, group, method, c, whole, queries, scale, answer);
  };
  if (method == "linear") {
    run(few(n), [&](const Query& q) { return linearScan(c.source, q).distance; });
  } else if (method == "exhaustive") {
    const int stride = n <= 64 ? 1 : n <= 128 ? 8 : 64;
    const int slices = c.n - c.block + 1, looked = (slices + stride - 1) / stride;
    run(
        5, [&](const Query& q) { return exhaustiveScan(c.source, q, stride).distance; },
        static_cast<double>(slices) / looked);
  } else if (method == "fft") {
    FftCorrelation fft(c.source);
    run(few(n), [&](const Query& q) { return fft.findBest(q).distance; });
  } else if (method == "paper") {
    const SearchTree tree(c.source, c.block);
    run(few(n), [&](const Query& q) { return tree.findBest(q).distance; });
    state.counters["bytes_per_sample"] =
        static_cast<double>(tree.bytes()) / static_cast<double>(c.source.count());
  } else {
    const BlockIndex<std::uint8_t>& index = indexOf(c);
    BlockIndexStatistics total;
    run(401, [&](const Query& q) {
      BlockIndexStatistics s;
      const double distance = index.findBest(q, {}, &s).distance;
      total.leaves += s.leaves;
      total.boxes += s.boxes;
      total.blocks += s.blocks;
      return distance;
    });
    state.counters["leaves"] = static_cast<double>(total.leaves) / 402;
    state.counters["boxes"] = static_cast<double>(total.boxes) / 402;
    state.counters["blocks"] = static_cast<double>(total.blocks) / 402;
    state.counters["bytes_per_sample"] =
        static_cast<double>(index.bytes()) / static_cast<double>(c.source.count());
  }
}

void build(benchmark::State& state, int n, int threads) {
  const MatchCase& c = matchCase("balls", n);
  tbb::task_arena arena(threads);
  double bytes = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    arena.execute([&] {
      const BlockIndex<std::uint8_t> index(c.source, {c.block, c.block, c.block});
      bytes = static_cast<double>(index.bytes());
    });
    state.SetIterationTime(secondsSince(start));
  }
  state.counters["bytes_per_sample"] = bytes / static_cast<double>(c.source.count());
}

// All blocks of a target at stride 2, on one thread: by single queries, by single queries with the
// neighbors' matches as hints, as a batch, and by PatchMatch, whose error is how much farther its
// matches are on average (a share of the exact mean distance).
struct Batch {
  Levels levelSource, levelTarget;
  Channels source, target;
  NearestNeighborFieldOptions options;
  double exact = 0;   // sum of the exact distances
  double single = 0;  // seconds a block by single queries

  Batch() : levelSource(matchCase("balls", 64).source) {
    // Balls of the source's size.
    levelTarget = fields::quantized(fields::ballPacking(128, 6.4, 2), 6.4);
    for (const auto& [levels, channels] :
         {std::pair(&levelSource, &source), std::pair(&levelTarget, &target)}) {
      Array3D<float> values(levels->size());
      for (std::size_t s = 0; s < values.count(); ++s) values.data()[s] = levels->data()[s];
      channels->push_back(std::move(values));
    }
    options.patch = {8, 8, 8};
    options.stride = {2, 2, 2};
  }
};

Batch& batch() {
  static Batch made;
  return made;
}

void field(benchmark::State& state, const std::string& method) {
  Batch& b = batch();
  const Vec3i patches{61, 61, 61};
  const auto blocks = static_cast<double>(volume(patches));
  double sum = 0, seconds = 0;
  tbb::task_arena one(1);
  for (auto _ : state) {
    const double start = threadSeconds();
    if (method == "single" || method == "hinted") {
      static const BlockIndex<std::uint8_t> index(b.levelSource, {8, 8, 8});
      std::vector<BlockMatch> hints;
      Array3D<BlockMatch> found(patches);
      for (int k = 0; k < patches.z; ++k)
        for (int j = 0; j < patches.y; ++j)
          for (int i = 0; i < patches.x; ++i) {
            const Query query{fields::block(b.levelTarget, {2 * i, 2 * j, 2 * k}, {8, 8, 8}), {}};
            hints.clear();
            if (method == "hinted")
              for (const Vec3i& step : {Vec3i{1, 0, 0}, Vec3i{0, 1, 0}, Vec3i{0, 0, 1}})
                if (const Vec3i at = Vec3i{i, j, k} - step; max(at, Vec3i{}) == at) {
                  BlockMatch moved = found[at];
                  moved.position += step * 2;
                  hints.push_back(moved);
                }
            found(i, j, k) = index.findBest(query, hints);
            sum += found(i, j, k).distance;
          }
    } else {
      NearestNeighborField result;
      NearestNeighborFieldOptions options = b.options;
      options.method = method == "exact" ? NeighborMethod::Exact : NeighborMethod::PatchMatch;
      one.execute([&] { result = nearestNeighborField(b.source, b.target, options); });
      for (float d : result.distance.values()) sum += static_cast<double>(d);
    }
    seconds = threadSeconds() - start;
    state.SetIterationTime(seconds);
  }
  state.counters["microseconds_per_block"] = 1e6 * seconds / blocks;
  if (method == "single") b.single = seconds / blocks;
  if (method == "exact") b.exact = sum;
  if (method == "hinted" && b.exact > 0 && std::abs(sum / b.exact - 1) > 1e-4) std::abort();
  if (method == "patchmatch" && b.exact > 0) state.counters["error"] = sum / b.exact - 1;
  if (b.single > 0) state.counters["times_single"] = b.single / (seconds / blocks);
}

void registerAll() {
  const auto once = [](const std::string& name, auto&& run) {
    benchmark::RegisterBenchmark(name.c_str(), run)
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  };
  const std::string sizes[] = {"64/8", "128/16", "256/32"};
  for (const char* scene : {"balls", "terrain", "chainmail"})
    for (const std::string& size : sizes) {
      const int n = std::stoi(size);
      for (const char* method : {"best", "linear", "fft", "paper"}) {
        const std::string tail = scene == std::string("balls") ? "" : std::string("/") + scene;
        once(std::string("match/") + method + '/' + size + tail,
             [=](benchmark::State& s) { match(s, method, scene, n, false); });
      }
    }
  for (const char* method : {"best", "linear"})
    once(std::string("match/") + method + "/64/8/noise",
         [=](benchmark::State& s) { match(s, method, "noise", 64, false); });
  for (const std::string& size : sizes)
    for (const char* method : {"best", "exhaustive", "linear", "paper"}) {
      const int n = std::stoi(size);
      once(std::string("table1/") + method + '/' + size,
           [=](benchmark::State& s) { match(s, method, "balls", n, true); });
    }
  for (int threads : {1, 2})
    for (const std::string& size : sizes) {
      const int n = std::stoi(size);
      once("build/" + size + '/' + std::to_string(threads),
           [=](benchmark::State& s) { build(s, n, threads); });
    }
  for (const char* method : {"single", "exact", "hinted", "patchmatch"})
    once(std::string("field/") + method + "/128/8", [=](benchmark::State& s) { field(s, method); });
}

// How many times longer every other method takes than `best`.
void printRatios() {
  std::printf("\ntimes the median of `best`\n");
  for (const auto& [name, seconds] : medians()) {
    const std::string what = name.substr(0, name.rfind('/'));
    const auto best = medians().find(what + "/best");
    if (best == medians().end()) continue;
    std::printf("%-36s %12.1f us %10.1f x\n", name.c_str(), 1e6 * seconds, seconds / best->second);
  }
}

}  // namespace
}  // namespace exemplar::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  exemplar::bench::registerAll();
  benchmark::RunSpecifiedBenchmarks();
  exemplar::bench::printRatios();
}
