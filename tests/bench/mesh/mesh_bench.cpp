// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Reading and writing a mesh in each format, and its health, against what the machine can do at
// best: copying the file's bytes through the page cache.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <stdexcept>

#include "core/file.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "mesh/primitives.h"

namespace exemplar {
namespace {

const char* const kEndings[] = {".obj", ".ply", ".stl", ".off", ".glb"};

/// A torus of 2 n² triangles with colors, UVs and a material.
TriangleMesh torus(std::int64_t n) {
  TriangleMesh mesh =
      makeTorus({0, 0, 0}, {0, 0, 1}, 2, 0.5, static_cast<int>(n), static_cast<int>(n));
  mesh.colors.assign(mesh.positions.size(), {0.1f, 0.2f, 0.3f, 1.0f});
  for (const auto& triangle : mesh.triangles) {
    auto& uv = mesh.uvs.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const Vec3d& p = mesh.positions[triangle[c]];
      uv[c] = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
  }
  mesh.materials = {Material{.name = "torus"}};
  mesh.triangleMaterials.assign(mesh.triangles.size(), 0);
  return mesh;
}

std::filesystem::path fileOf(const benchmark::State& state) {
  return std::filesystem::temp_directory_path() /
         (std::string("exemplar_mesh_bench") + kEndings[state.range(0)]);
}

void countTriangles(benchmark::State& state, const TriangleMesh& mesh) {
  state.SetLabel(kEndings[state.range(0)]);
  state.counters["triangles/s"] = benchmark::Counter(
      static_cast<double>(mesh.triangles.size()) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}

void Write(benchmark::State& state) {
  const TriangleMesh mesh = torus(state.range(1));
  const std::filesystem::path path = fileOf(state);
  for (auto _ : state) writeMesh(path, mesh);
  countTriangles(state, mesh);
}

void Read(benchmark::State& state) {
  const TriangleMesh mesh = torus(state.range(1));
  const std::filesystem::path path = fileOf(state);
  writeMesh(path, mesh);
  if (readMesh(path).triangles.size() != mesh.triangles.size())
    throw std::logic_error("read wrong");
  for (auto _ : state) benchmark::DoNotOptimize(readMesh(path));
  countTriangles(state, mesh);
}

void ReadBytesOnly(benchmark::State& state) {
  const TriangleMesh mesh = torus(state.range(1));
  const std::filesystem::path path = fileOf(state);
  writeMesh(path, mesh);
  for (auto _ : state) benchmark::DoNotOptimize(readFile(path));
  countTriangles(state, mesh);
}

void formats(benchmark::internal::Benchmark* b) {
  for (const std::int64_t format : {0, 1, 2, 3, 4}) b->Args({format, 700});
  b->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}
BENCHMARK(Write)->Apply(formats);
BENCHMARK(Read)->Apply(formats);
BENCHMARK(ReadBytesOnly)->Apply(formats);

void Health(benchmark::State& state) {
  const TriangleMesh mesh = torus(700);
  const bool selfIntersections = state.range(0) != 0;
  for (auto _ : state) {
    const MeshHealth health = meshHealth(mesh, {.selfIntersections = selfIntersections});
    if (!health.closed() || health.selfIntersections != 0)
      throw std::logic_error("a sound torus is not");
  }
  state.SetLabel(selfIntersections ? "with self-intersections" : "topology");
  state.counters["triangles/s"] = benchmark::Counter(
      static_cast<double>(mesh.triangles.size()) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}
BENCHMARK(Health)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace exemplar
