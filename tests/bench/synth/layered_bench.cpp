// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Layered shape synthesis beside the paper's plain variant: matching of boundaries, and a shape on
// one resolution. `distance` is the mean distance of a match, in cells; `toExample` and `boundary`
// are figures of the shape.

#include <benchmark/benchmark.h>

#include "layered_baseline.h"
#include "measure/layers.h"
#include "synth/layered/layers.h"
#include "tests/synth/layered/layer_samples.h"

namespace exemplar::bench {
namespace {

/// An example of 400 x 300 and a random start of the same share, `side` cells wide.
struct Instance {
  LayerVolume layers = testing::noiseLayers(400, 300, 2, 2);
  ShapeOptions options;
  ShapeExample example;
  Shape start;

  explicit Instance(int side)
      : example(shapeExample(layerShape(layers, 2), nullptr, nullptr, options, Random(1))),
        start(layerShape(testing::noiseLayers(side, side * 3 / 4, 2, 3), 2)) {}
};

void matching(benchmark::State& state, bool plain) {
  const Instance i(static_cast<int>(state.range(0)));
  const BoundaryPatches set(i.start, boundaryOf(i.start, true), i.options.patch, 1, true);
  const auto uses = fairUses(set.count(), i.example.patches.count(), Random(1));
  double distance = 0;
  for (auto _ : state) {
    const std::vector<BoundaryMatch> matches =
        plain ? matchPlainly(set, i.example.patches, uses)
              : assignPatches(set, i.example.patches, uses, AssignmentKind::Greedy, Random(2))
                    .matches;
    distance = 0;
    for (const BoundaryMatch& match : matches) distance += match.distance;
  }
  state.counters["patches"] = static_cast<double>(set.count());
  state.counters["distance"] = distance / static_cast<double>(set.count());
}

void shape(benchmark::State& state, bool plain) {
  const Instance i(static_cast<int>(state.range(0)));
  Shape made;
  for (auto _ : state) {
    made = plain ? optimizePlainly(i.start, i.example, 5, Random(3))
                 : optimizeShape(i.start, i.example, {}, {.iterations = 5, .settled = 0}, Random(3))
                       .shape;
  }
  LayerVolume map(made.size());
  for (std::size_t p = 0; p < map.count(); ++p)
    map.data()[p] = static_cast<std::uint8_t>(1 + made.data()[p]);
  const LayerLikeness likeness = measureLayers(i.layers, false, map).layers.front();
  state.counters["toExample"] = likeness.toExample.value_or(1);
  state.counters["boundary"] = likeness.boundaryRatio.value_or(0);
}

/// A layer on all resolutions, by this library alone.
void layer(benchmark::State& state) {
  const Instance i(16);
  const int side = static_cast<int>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(synthesizeLayers(i.layers, {side, side * 3 / 4, 1}, {}));
}

/// All cores' time, so that what else the machine does counts little.
void measured(benchmark::internal::Benchmark* of) {
  of->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}

BENCHMARK_CAPTURE(matching, ours, false)->Arg(200)->Arg(400)->Apply(measured);
BENCHMARK_CAPTURE(matching, plain, true)->Arg(200)->Arg(400)->Apply(measured);
BENCHMARK_CAPTURE(shape, ours, false)->Arg(200)->Apply(measured);
BENCHMARK_CAPTURE(shape, plain, true)->Arg(200)->Apply(measured);
BENCHMARK(layer)->Arg(400)->Arg(800)->Apply(measured);

}  // namespace
}  // namespace exemplar::bench
