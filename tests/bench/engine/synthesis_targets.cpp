// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What geometry synthesis reaches of its targets on one example of each kind, and on shapes that
// nothing was tuned on: means over seeds, at the example's own size and at twice the size along x
// and y. Prints the tables of docs/synthesis.md. A figure that misses its target has a star.
//
//     synthesis_targets [SEEDS [FOLDER [KIND...]]]
//
// SEEDS is 5 by default. Into FOLDER ("-" for none) it writes the examples and the results as .vdb.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "engine/engine.h"
#include "engine/engines.h"
#include "engine/example.h"
#include "engine/result.h"
#include "measure/measure.h"
#include "measure/occupancy.h"
#include "measure/rolled_distance.h"
#include "sdf/vdb_file.h"
#include "tests/held_out_shapes.h"

namespace exemplar {
namespace {

using testing::ShapeKind;

/// What one result scored, in the order of the table's columns.
struct Column {
  const char* name;
  std::function<double(const Measures&)> figure;
  /// Whether a mean is as good as it should be, of what fills its box (`material`) or not.
  std::function<bool(double mean, bool material)> same;
  std::function<bool(double mean, bool material)> twice;
};

std::vector<Column> columns() {
  const auto least = [](double limit) { return [=](double v, bool) { return v >= limit; }; };
  const auto most = [](double limit) { return [=](double v, bool) { return v <= limit; }; };
  const auto within = [](double v, bool) { return v >= 0.93 && v <= 1.07; };
  const auto whatever = [](double, bool) { return true; };
  const auto alike = [](double v, bool material) {
    return v <= (material ? kAlikeMaterial : kAlike);
  };
  const auto alikeLarge = [](double v, bool) { return v <= kAlike; };
  using Figure = std::function<double(const Measures&)>;
  using Good = std::function<bool(double, bool)>;
  std::vector<Column> all;
  const auto add = [&](const char* name, const Figure& figure, const Good& same,
                       const Good& twice) {
    all.push_back({name, figure, same, twice});
  };
  add(
      "distance", [](const Measures& m) { return m.novelty.rolled.distance; }, least(0.2),
      whatever);
  add(
      "top", [](const Measures& m) { return m.novelty.offsets ? m.novelty.offsets->top : 1.0; },
      most(0.4), whatever);
  add(
      "multiscale",
      [](const Measures& m) { return m.multiscale ? m.multiscale->ratio : std::nan(""); }, alike,
      alikeLarge);
  add(
      "LP-dense", [](const Measures& m) { return m.likeness.dense.share; }, least(0.8), least(0.8));
  add(
      "coverage", [](const Measures& m) { return m.likeness.coverage.share; }, least(0.85),
      least(0.9));
  add(
      "solid", [](const Measures& m) { return m.likeness.occupancyRatio.value_or(0); }, within,
      within);
  add(
      "surface", [](const Measures& m) { return m.likeness.surfaceRatio.value_or(0); }, within,
      whatever);
  add(
      "pieces ×",
      [](const Measures& m) {
        return static_cast<double>(m.wholeness.pieces) /
               static_cast<double>(std::max<std::int64_t>(1, m.wholeness.examplePieces));
      },
      most(1.05), whatever);
  add(
      "floating",
      [](const Measures& m) {
        return std::max(0.0, m.wholeness.floatingShare - m.wholeness.exampleFloatingShare);
      },
      most(0.005), most(0.005));
  add(
      "sliced", [](const Measures& m) { return m.wholeness.slicedShare; }, most(0.02), whatever);
  add(
      "landmark", [](const Measures& m) { return static_cast<double>(m.landmarks.most()); },
      whatever, most(2));
  return all;
}

/// The mean distance of results from each other, each laid on the other by its best roll.
double rolledDiversity(const std::vector<Occupancy>& results) {
  double sum = 0;
  int pairs = 0;
  for (std::size_t a = 0; a < results.size(); ++a)
    for (std::size_t b = a + 1; b < results.size(); ++b, ++pairs)
      sum += rolledDistance(results[a], results[b]).distance;
  return pairs == 0 ? 0 : sum / pairs;
}

void printHead(bool twice) {
  std::printf("\n%s\n\n| example |", twice ? "Twice as long along x and y:" : "The same size:");
  for (const Column& column : columns()) std::printf(" %s |", column.name);
  std::printf(" Div | new and alike |\n|---|");
  for (std::size_t n = 0; n < columns().size() + 2; ++n) std::printf("---|");
  std::printf("\n");
}

void printRow(const ShapeKind& kind, bool twice, int seeds, const std::string& folder) {
  const DistanceField field = kind.make(kind.side, 0);
  const Example example = readExample(Source::of(field));
  const auto write = [&](const std::string& name, const DistanceField& what) {
    if (folder != "-") writeVdb(std::filesystem::path(folder) / (name + ".vdb"), what);
  };
  if (!twice) write(kind.name, field);
  std::vector<Column> all = columns();
  std::vector<double> sums(all.size());
  std::vector<Occupancy> results;
  bool material = false;
  int both = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    Request request;
    request.seed = static_cast<std::uint64_t>(seed);
    request.extent.scale = twice ? Vec3d{2, 2, 1} : Vec3d{1, 1, 1};
    const Result result = geometryEngine().run({&example, 1}, request, {});
    MeasureInput input;
    input.origins = &result.origins;
    const Measures measures = measure(example.field(), result.field(), input);
    for (std::size_t n = 0; n < all.size(); ++n) sums[n] += all[n].figure(measures);
    material = measures.novelty.rollingIsFair.x && measures.novelty.rollingIsFair.y;
    both += measures.frontier == Frontier::NewAndAlike;
    results.emplace_back(result.field());
    write(std::string(kind.name) + (twice ? "_twice_" : "_") + std::to_string(seed),
          result.field());
  }
  std::printf("| %s |", kind.name);
  for (std::size_t n = 0; n < all.size(); ++n) {
    const double mean = sums[n] / seeds;
    const bool good = (twice ? all[n].twice : all[n].same)(mean, material);
    std::printf(" %.2f%s |", mean, good ? "" : "*");
  }
  const double apart = rolledDiversity(results);
  std::printf(" %.2f%s | %d of %d |\n", apart, twice || apart >= 0.2 ? "" : "*", both, seeds);
  std::fflush(stdout);
}

}  // namespace
}  // namespace exemplar

int main(int argc, char** argv) {
  using namespace exemplar;
  try {
    const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    const std::string folder = argc > 2 ? argv[2] : "-";
    const std::vector<std::string> wanted(argv + std::min(argc, 3), argv + argc);
    std::vector<ShapeKind> kinds = testing::shapeKinds();
    for (const ShapeKind& kind : testing::heldOutKinds()) kinds.push_back(kind);
    for (const bool twice : {false, true}) {
      printHead(twice);
      for (const ShapeKind& kind : kinds) {
        if (wanted.empty() || std::ranges::find(wanted, kind.name) != wanted.end())
          printRow(kind, twice, seeds, folder);
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "synthesis_targets: %s\n", error.what());
    return 2;
  }
}
