// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Signed distance fields: what they cost beside the plain way (every triangle for every sample) and
// beside OpenVDB's own conversions, with the largest error of each in the same run.
//
//     build/release/tests/bench/sdf/sdf_bench

#include <benchmark/benchmark.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "mesh/primitives.h"
#include "sdf/height_map.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/redistance.h"
#include "sdf/triangle_tree.h"

namespace exemplar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A finely tessellated ball in a box with room around it: 20 frequency^2 triangles.
struct Ball {
  TriangleMesh mesh;
  MeshToSdfOptions options;

  Ball(int resolution, int frequency, double halfWidth = 3) {
    mesh = makeSphere({}, 1, frequency);
    options.resolution = resolution;
    options.box = Box3d{{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}};
    options.halfWidth = halfWidth;
  }
};

// The largest difference from the ball's analytic distance, in voxels.
double worstError(const DistanceField& field) {
  double worst = 0;
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    const double d = length(field.position(cast<double>(field.values.ijk(s)))) - 1;
    const double t = field.truncation;
    worst = std::max(worst, std::abs(field.values.values()[s] - std::clamp(d, -t, t)));
  }
  return worst / field.voxelSize;
}

void report(benchmark::State& state, const DistanceField& field, double triangles) {
  const auto samples = static_cast<double>(field.values.count());
  state.counters["voxels/s"] =
      benchmark::Counter(samples, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["triangles"] = triangles;
}

void meshToSdfBall(benchmark::State& state, double halfWidth) {
  const Ball ball(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), halfWidth);
  DistanceField field;
  for (auto _ : state) field = meshToSdf(ball.mesh, ball.options);
  report(state, field, static_cast<double>(ball.mesh.triangles.size()));
  state.counters["worst_error_voxels"] = worstError(field);
}

// Every triangle for every sample, and the winding number as the sum over all of them.
void bruteForce(benchmark::State& state) {
  const Ball ball(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  std::vector<Corners> corners;
  for (const auto& [a, b, c] : ball.mesh.triangles)
    corners.push_back({ball.mesh.positions[a], ball.mesh.positions[b], ball.mesh.positions[c]});
  DistanceField field = meshToSdf(ball.mesh, ball.options);
  for (auto _ : state) {
    parallelFor(0, field.values.count(), 64, [&](std::size_t s0, std::size_t s1) {
      for (std::size_t s = s0; s < s1; ++s) {
        const Vec3d p = field.position(cast<double>(field.values.ijk(s)));
        double nearest = kInfinity, angle = 0;
        for (const Corners& t : corners) {
          nearest = std::min(nearest, squaredDistance(p, t));
          const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
          const double la = length(a), lb = length(b), lc = length(c);
          angle += std::atan2(dot(a, cross(b, c)),
                              la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
        }
        const double d = std::min<double>(std::sqrt(nearest), field.truncation);
        field.values.values()[s] = static_cast<float>(std::abs(angle) > 3.14159265 ? -d : d);
      }
    });
  }
  report(state, field, static_cast<double>(corners.size()));
  state.counters["worst_error_voxels"] = worstError(field);
}

// OpenVDB's mesh to volume and a dense copy of it.
void openvdbMeshToVolume(benchmark::State& state) {
  const Ball ball(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  DistanceField field = meshToSdf(ball.mesh, ball.options);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  for (const Vec3d& p : ball.mesh.positions) {
    const Vec3d q = field.index(p);
    points.emplace_back(q.x, q.y, q.z);
  }
  for (const auto& [a, b, c] : ball.mesh.triangles) triangles.emplace_back(a, b, c);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(
      points, triangles);
  const Vec3i n = field.size();
  for (auto _ : state) {
    const auto grid =
        openvdb::tools::meshToVolume<openvdb::FloatGrid>(adapter, openvdb::math::Transform(), 3, 3);
    openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(
        {{0, 0, 0}, {n.x - 1, n.y - 1, n.z - 1}}, field.values.data());
    openvdb::tools::copyToDense(*grid, dense);
  }
  for (float& v : field.values.values()) v *= static_cast<float>(field.voxelSize);
  report(state, field, static_cast<double>(triangles.size()));
  state.counters["worst_error_voxels"] = worstError(field);
}

// Forty overlapping balls; with holes, the sign has to be asked at every sample.
void meshToSdfOverlapping(benchmark::State& state, double holes) {
  const Random random(5);
  TriangleMesh mesh;
  for (int b = 0; b < 40; ++b)
    append(mesh,
           makeSphere({random.uniform(b, 0), random.uniform(b, 1), random.uniform(b, 2)}, 0.18, 8));
  std::size_t t = 0;
  std::erase_if(mesh.triangles, [&](const auto&) { return random.uniform(1000 + t++) < holes; });
  MeshToSdfOptions options;
  options.resolution = static_cast<int>(state.range(0));
  DistanceField field;
  for (auto _ : state) field = meshToSdf(mesh, options);
  report(state, field, static_cast<double>(mesh.triangles.size()));
}

// Large single triangles that cross each other everywhere: n of them cross about n^2 / 12 times.
void meshToSdfCrossing(benchmark::State& state) {
  const Random random(5);
  TriangleMesh mesh;
  for (std::uint32_t v = 0; v < 3 * state.range(0); ++v) {
    mesh.positions.push_back({random.uniform(v, 0), random.uniform(v, 1), random.uniform(v, 2)});
    if (v % 3 == 2) mesh.triangles.push_back({v - 2, v - 1, v});
  }
  MeshToSdfOptions options;
  options.resolution = 48;
  DistanceField field;
  for (auto _ : state) field = meshToSdf(mesh, options);
  report(state, field, static_cast<double>(mesh.triangles.size()));
}

// A closed scan so noisy that most of its triangles cross others: 20 frequency^2 triangles.
void meshToSdfNoisy(benchmark::State& state) {
  const Random random(5);
  TriangleMesh mesh = makeSphere({}, 1, static_cast<int>(state.range(0)));
  const double noise = 1.0 / static_cast<double>(state.range(0));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    mesh.positions[v] +=
        Vec3d{random.normal(v, 0), random.normal(v, 2), random.normal(v, 4)} * noise;
  MeshToSdfOptions options;
  options.resolution = 64;
  DistanceField field;
  for (auto _ : state) field = meshToSdf(mesh, options);
  report(state, field, static_cast<double>(mesh.triangles.size()));
}

DistanceField warpedBall(int n) {
  DistanceField field = meshToSdf(makeSphere({}, 1, 30), Ball(n, 1, 6).options);
  for (std::size_t s = 0; s < field.values.count(); ++s)
    field.values.values()[s] *=
        static_cast<float>(2 + std::sin(3 * field.position(cast<double>(field.values.ijk(s))).x));
  return field;
}

void redistanceField(benchmark::State& state) {
  const DistanceField before = warpedBall(static_cast<int>(state.range(0)));
  DistanceField field;
  for (auto _ : state) field = redistance(before);
  report(state, field, 0);
  state.counters["worst_error_voxels"] = worstError(field);
}

// OpenVDB's fast sweeping on the same band.
void openvdbSdfToSdf(benchmark::State& state) {
  DistanceField field = warpedBall(static_cast<int>(state.range(0)));
  const DistanceField exact = redistance(field);
  const Vec3i n = field.size();
  const openvdb::CoordBBox box({0, 0, 0}, {n.x - 1, n.y - 1, n.z - 1});
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, field.values.data());
  const auto grid = openvdb::FloatGrid::create(field.truncation * 3);
  openvdb::tools::copyFromDense(dense, *grid, 0.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(field.voxelSize));
  for (auto v = grid->beginValueOn(); v; ++v) {
    const openvdb::Coord c = v.getCoord();
    if (std::abs(exact.values(c.x(), c.y(), c.z())) >= exact.truncation) v.setValueOff();
  }
  openvdb::FloatGrid::Ptr swept;
  for (auto _ : state) swept = openvdb::tools::sdfToSdf(*grid);
  double worst = 0;
  for (auto v = swept->cbeginValueOn(); v; ++v) {
    const openvdb::Coord c = v.getCoord();
    const double d = length(field.position({double(c.x()), double(c.y()), double(c.z())})) - 1;
    worst = std::max(worst, std::abs(*v - d));
  }
  report(state, field, 0);
  state.counters["worst_error_voxels"] = worst / field.voxelSize;
}

void heightMap(benchmark::State& state) {
  HeightMap map{Grid<float>(400, 400), 1};
  for (int p = 0; p < 160000; ++p)
    map.heights[p] = static_cast<float>(30 * std::sin(p % 400 * 0.05) * std::cos(p / 400 * 0.04));
  HeightMapToSdfOptions options;
  options.resolution = static_cast<int>(state.range(0));
  DistanceField field;
  for (auto _ : state) field = heightMapToSdf(map, options);
  report(state, field, 2.0 * 399 * 399);
}

// Winding numbers of a torus with holes at the samples of 4 x 4 x 4 blocks, one by one or together.
void windingNumbers(benchmark::State& state, bool together) {
  const TriangleMesh mesh = makeTorus({}, {0, 0, 1}, 0.7, 0.3, 200, 100);
  std::vector<Corners> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (t % 7)
      corners.push_back({mesh.positions[mesh.triangles[t][0]], mesh.positions[mesh.triangles[t][1]],
                         mesh.positions[mesh.triangles[t][2]]});
  const TriangleTree tree(corners);
  const Random random(1);
  std::vector<Vec3d> points;
  for (int block = 0; block < 64; ++block)
    for (int p = 0; p < 64; ++p)
      points.push_back(Vec3d{random.uniform(-1, 1, block, 0), random.uniform(-1, 1, block, 1),
                             random.uniform(-0.4, 0.4, block, 2)} +
                       Vec3d{double(p % 4), double(p / 4 % 4), double(p / 16)} * 0.03);
  std::vector<double> result(points.size());
  for (auto _ : state) {
    if (together) {
      tree.windingNumbers(points, result);
    } else {
      for (std::size_t p = 0; p < points.size(); ++p) result[p] = tree.windingNumber(points[p]);
    }
    benchmark::DoNotOptimize(result.data());
  }
  state.counters["points/s"] = benchmark::Counter(static_cast<double>(points.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

#define EXEMPLAR_BENCH(name, ...)     \
  BENCHMARK_CAPTURE(__VA_ARGS__)      \
      ->Name(name)                    \
      ->Unit(benchmark::kMillisecond) \
      ->MeasureProcessCPUTime()       \
      ->UseRealTime()
const std::vector<std::vector<std::int64_t>> kSizes{{64, 128}, {8, 32, 100}};

EXEMPLAR_BENCH("mesh/band", meshToSdfBall, band, 3.0)
    ->ArgsProduct(kSizes)
    ->ArgNames({"n", "frequency"});
EXEMPLAR_BENCH("mesh/full", meshToSdfBall, full, kInfinity)
    ->ArgsProduct(kSizes)
    ->ArgNames({"n", "frequency"});
EXEMPLAR_BENCH("mesh/overlapping", meshToSdfOverlapping, closed, 0.0)
    ->Arg(64)
    ->Arg(128)
    ->ArgName("n");
EXEMPLAR_BENCH("mesh/open", meshToSdfOverlapping, open, 0.05)->Arg(64)->Arg(128)->ArgName("n");
BENCHMARK(meshToSdfCrossing)
    ->Name("mesh/crossing")
    ->Arg(30)
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->ArgName("triangles")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(meshToSdfNoisy)
    ->Name("mesh/noisy")
    ->Arg(12)
    ->Arg(23)
    ->Arg(46)
    ->Arg(92)
    ->ArgName("frequency")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(bruteForce)
    ->Name("mesh/brute_force")
    ->Args({64, 8})
    ->ArgNames({"n", "frequency"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK(openvdbMeshToVolume)
    ->Name("mesh/openvdb")
    ->ArgsProduct(kSizes)
    ->ArgNames({"n", "frequency"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(redistanceField)
    ->Name("redistance/ours")
    ->Arg(64)
    ->Arg(128)
    ->ArgName("n")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(openvdbSdfToSdf)
    ->Name("redistance/openvdb")
    ->Arg(64)
    ->Arg(128)
    ->ArgName("n")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(heightMap)
    ->Name("height_map")
    ->Arg(64)
    ->Arg(128)
    ->ArgName("n")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
EXEMPLAR_BENCH("winding/one_by_one", windingNumbers, single, false);
EXEMPLAR_BENCH("winding/in_blocks", windingNumbers, batch, true);

}  // namespace
}  // namespace exemplar
