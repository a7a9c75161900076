// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What fresh samples of a scene's own process score against the scene: the figures that a perfect
// synthesizer is expected to reach. Prints the table of docs/measures.md.
//
//     fresh_scores [SCENE...]     all bundled scenes without arguments

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "measure/measure.h"
#include "mesh/scene.h"
#include "sdf/mesh_to_sdf.h"

namespace exemplar {
namespace {

constexpr int kSamples = 5;

DistanceField sample(const Scene& scene, double voxelSize) {
  MeshToSdfOptions options;
  options.voxelSize = voxelSize;
  options.box = scene.box;
  options.halfWidth = 4;
  return meshToSdf(scene.mesh, options);
}

void printRow(const std::string& name) {
  const auto path = findScene(name);
  const Scene scene = readScene(path);
  const Vec3d size = scene.box.size();
  const double voxelSize = std::max({size.x, size.y, size.z}) / scene.resolution;
  const DistanceField example = sample(scene, voxelSize);

  std::vector<Measures> measures;
  std::vector<Occupancy> results;
  for (int s = 0; s < kSamples; ++s) {
    // Seeds that no scene file is likely to have.
    const DistanceField fresh =
        sample(readScene(path, {.seed = 1000u + s, .extent = scene.scale}), voxelSize);
    measures.push_back(measure(example, fresh));
    results.emplace_back(fresh);
  }
  const auto mean = [&](const std::function<double(const Measures&)>& figure) {
    double sum = 0;
    for (const Measures& m : measures) sum += figure(m);
    return sum / kSamples;
  };
  const auto share = [](const std::optional<PatchLikeness>& p) {
    return p ? p->share : std::nan("");
  };
  const Vec3i n = example.size(), r = results[0].size();
  std::printf(
      "| %s | %d x %d x %d | %d x %d x %d | %.3f | %.3f | %.3f | %.3f | %.3f | %.2f | %.2f | %.3f "
      "| "
      "%.3f | %.1f / %.1f | %.4f | %.2f |\n",
      name.c_str(), n.x, n.y, n.z, r.x, r.y, r.z,
      mean([](const Measures& m) { return m.likeness.dense.share; }),
      mean([](const Measures& m) { return m.likeness.coverage.share; }),
      mean([&](const Measures& m) { return share(m.likeness.denseInterior); }),
      mean([&](const Measures& m) { return share(m.likeness.coverageInterior); }),
      mean([](const Measures& m) { return m.likeness.dense.meanIou; }), mean([](const Measures& m) {
        return m.likeness.patches ? m.likeness.patches->distance : NAN;
      }),
      mean([](const Measures& m) { return m.likeness.patches ? m.likeness.patches->floor : NAN; }),
      mean([](const Measures& m) { return m.likeness.occupancyRatio.value_or(NAN); }),
      mean([](const Measures& m) { return m.likeness.surfaceRatio.value_or(NAN); }),
      mean([](const Measures& m) { return m.likeness.pieces->examplePerMillion; }),
      mean([](const Measures& m) { return m.likeness.pieces->resultPerMillion; }),
      mean([](const Measures& m) { return m.likeness.pieces->brokenShare; }), diversity(results));
  std::fflush(stdout);
}

}  // namespace
}  // namespace exemplar

int main(int argc, char** argv) {
  try {
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty()) {
      names = exemplar::bundledScenes();
      std::erase_if(names, [](const std::string& name) {  // scenes of solids have no process
        return exemplar::readFile(exemplar::findScene(name)).find("kind = \"solids\"") !=
               std::string::npos;
      });
    }
    std::printf(
        "| scene | example | fresh sample | LP-dense | coverage | LP interior | coverage interior "
        "| "
        "mean IoU | FPD | its floor | occupancy | surface | pieces a million cells, example / "
        "fresh "
        "| broken | Div |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& name : names) exemplar::printRow(name);
  } catch (const exemplar::InputError& error) {
    std::fprintf(stderr, "fresh_scores: %s\n", error.what());
    return 2;
  }
}
