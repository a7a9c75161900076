// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Continuous model synthesis beside the papers' own algorithm: one pass with backtracking, one pass
// that ends at the first failure, and blocks of 10 spacings without backtracking, from nothing.
// `complete` is the share of runs (or of blocks) that succeed.

#include <benchmark/benchmark.h>

#include <array>

#include "core/file.h"
#include "synth/continuous/blocks.h"
#include "synth/continuous/search.h"
#include "synth/continuous/solid_scene.h"

namespace exemplar::continuous {
namespace {

constexpr std::array<const char*, 3> kScenes{"houses", "pentagons", "skyscrapers"};

/// A scene's planes in a box of `side` x `side` x 6 spacings, and its domains.
struct Town {
  Solids solids;
  PlaneLattice lattice;
  PlaneSets planes;
  Centrals centrals;
  FigureSet figures;
  Arrangement arrangement;
  Puzzle puzzle;
  std::vector<std::uint32_t> vertices;
  std::vector<double> weights;

  Town(const char* name, int side)
      : solids(read(name)),
        lattice(latticeOf(solids)),
        planes(planesIn(lattice, windowOf(lattice, {side, side, 6}))),
        centrals(planes.normals),
        figures(extractFigures(solids, centrals)),
        arrangement(planes, centrals, 10'000'000),
        puzzle(makePuzzle(arrangement, figures, solids.ground)),
        weights(figures.size(), 1) {
    for (std::uint32_t v = 0; v < arrangement.vertices(); ++v)
      if (arrangement.inside(v)) vertices.push_back(v);
  }
  static Solids read(const char* name) {
    const std::string path = std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/" + name + ".toml";
    return readSolidScene(readFile(path), path).solids;
  }
};

void onePass(benchmark::State& state, bool backtracking) {
  const Town town(kScenes[static_cast<std::size_t>(state.range(0))],
                  static_cast<int>(state.range(1)));
  std::uint64_t seed = 0;
  std::int64_t complete = 0;
  for (auto _ : state) {
    Domains domains = town.puzzle.domains;
    Search::Marks marks(town.puzzle);
    Search search(town.puzzle, town.weights, domains, marks);
    search.setBacktracking(backtracking);
    search.begin(town.vertices, 1);
    const auto budget = 1000 + static_cast<std::int64_t>(town.vertices.size()) / 10;
    complete += search.run(Random(++seed), budget) == Found::All;
  }
  const auto runs = static_cast<double>(state.iterations());
  state.SetLabel(kScenes[static_cast<std::size_t>(state.range(0))]);
  state.counters["complete"] = static_cast<double>(complete) / runs;
  state.counters["vertices"] = static_cast<double>(town.vertices.size());
  state.counters["vertices_per_s"] = benchmark::Counter(
      static_cast<double>(town.vertices.size()) * runs, benchmark::Counter::kIsRate);
}
void BM_WithBacktracking(benchmark::State& state) { onePass(state, true); }
void BM_WithoutBacktracking(benchmark::State& state) { onePass(state, false); }

/// Blocks of 10 spacings, and their share that succeeds.
void BM_BlocksOfTen(benchmark::State& state) {
  const Town town(kScenes[static_cast<std::size_t>(state.range(0))],
                  static_cast<int>(state.range(1)));
  std::uint64_t seed = 0;
  BlockCounts sum;
  for (auto _ : state) {
    Domains labels = town.puzzle.domains;
    for (const std::uint32_t v : town.vertices) {
      std::ranges::fill(labels[v], 0);
      insert(labels[v], static_cast<std::size_t>(town.puzzle.background[v]));
    }
    const BlockCounts counts = modifyInBlocks(
        town.puzzle, town.weights, labels, Random(++seed),
        {.spacing = town.lattice.spacing, .side = 10, .rounds = 1, .backtracking = false});
    sum.blocks += counts.blocks;
    sum.kept += counts.kept;
  }
  state.SetLabel(kScenes[static_cast<std::size_t>(state.range(0))]);
  state.counters["complete"] = static_cast<double>(sum.kept) / static_cast<double>(sum.blocks);
  state.counters["vertices_per_s"] = benchmark::Counter(
      static_cast<double>(town.vertices.size()) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}

void arguments(benchmark::internal::Benchmark* b) {
  for (int scene = 0; scene < static_cast<int>(kScenes.size()); ++scene)
    for (const int side : {10, 30}) b->Args({scene, side});
  b->Unit(benchmark::kMillisecond)->Iterations(10);
}
BENCHMARK(BM_WithBacktracking)->Apply(arguments);
BENCHMARK(BM_WithoutBacktracking)->Apply(arguments);
BENCHMARK(BM_BlocksOfTen)->Apply(arguments);

}  // namespace
}  // namespace exemplar::continuous
