// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Model pieces: taking a scene apart and putting one together; labels as a mesh and as text, beside
// the copying of as many bytes.

#include <benchmark/benchmark.h>

#include <cstring>
#include <stdexcept>

#include "core/random.h"
#include "mesh/scene.h"
#include "voxelize/label_file.h"
#include "voxelize/label_mesh.h"
#include "voxelize/model_pieces.h"

namespace exemplar {
namespace {

const char* const kScenes[] = {"castle", "city", "library"};

Scene sceneOf(const benchmark::State& state) {
  return readScene(std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/" + kScenes[state.range(0)] +
                   ".toml");
}

void countRate(benchmark::State& state, const char* what, double each) {
  state.counters[what] = benchmark::Counter(each * static_cast<double>(state.iterations()),
                                            benchmark::Counter::kIsRate);
}

void CutIntoPieces(benchmark::State& state) {
  const Scene scene = sceneOf(state);
  ModelPieces pieces;
  for (auto _ : state) {
    pieces = cutIntoPieces(scene.mesh, {.cellSize = *scene.cell, .box = scene.box});
  }
  if (pieces.grid.labelCount() < 60) throw std::runtime_error("too few pieces");
  state.SetLabel(kScenes[state.range(0)]);
  countRate(state, "triangles/s", static_cast<double>(scene.mesh.triangles.size()));
}

void AssemblePieces(benchmark::State& state) {
  const Scene scene = sceneOf(state);
  const ModelPieces pieces = cutIntoPieces(scene.mesh, {.cellSize = *scene.cell, .box = scene.box});
  TriangleMesh mesh;
  for (auto _ : state) mesh = assemblePieces(pieces.grid, pieces);
  state.SetLabel(kScenes[state.range(0)]);
  countRate(state, "triangles/s", static_cast<double>(mesh.triangles.size()));
}

/// Labels in lumps of four cells a side, as scenes have them.
LabelGrid lumps(int side, int labels) {
  const Random random(1);
  LabelGrid grid;
  grid.cells = Array3D<Label>({side, side, side});
  grid.labels.resize(labels);
  grid.labels[0] = emptyLook();
  for (std::size_t n = 0; n < grid.cells.count(); ++n) {
    const Vec3i c = grid.cells.ijk(n);
    const std::uint64_t lump = (c.z / 4 * 1000ull + c.y / 4) * 1000 + c.x / 4;
    grid.cells.values()[n] = static_cast<Label>(random.below(labels, lump));
  }
  return grid;
}

void LabelMesh(benchmark::State& state) {
  const LabelGrid grid = lumps(static_cast<int>(state.range(0)), 50);
  for (auto _ : state) benchmark::DoNotOptimize(labelMesh(grid));
  countRate(state, "cells/s", static_cast<double>(grid.cells.count()));
}

void ReadText(benchmark::State& state) {
  const LabelGrid grid = lumps(static_cast<int>(state.range(0)), 50);
  const std::string text = formatLabelText(grid);
  LabelGrid back;
  for (auto _ : state) back = parseLabelText(text, "grid.txt");
  if (back.cells != grid.cells) throw std::runtime_error("read back differently");
  state.SetBytesProcessed(static_cast<std::int64_t>(text.size()) * state.iterations());
}

void ReadVox(benchmark::State& state) {
  const LabelGrid grid = lumps(static_cast<int>(state.range(0)), 50);
  const std::string bytes = formatVox(grid, "grid.vox");
  LabelGrid back;
  for (auto _ : state) back = parseVox(bytes, "grid.vox");
  if (back.cells != grid.cells) throw std::runtime_error("read back differently");
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes.size()) * state.iterations());
}

/// The baseline of the readers.
void CopyText(benchmark::State& state) {
  const std::string text = formatLabelText(lumps(static_cast<int>(state.range(0)), 50));
  std::string copy(text.size(), ' ');
  for (auto _ : state) {
    std::memcpy(copy.data(), text.data(), text.size());
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(text.size()) * state.iterations());
}

BENCHMARK(CutIntoPieces)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(AssemblePieces)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);
BENCHMARK(LabelMesh)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(ReadText)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(ReadVox)->Arg(64)->Unit(benchmark::kMillisecond);
BENCHMARK(CopyText)->Arg(64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace exemplar
