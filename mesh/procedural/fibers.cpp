// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "mesh/primitives.h"
#include "mesh/procedural/noise.h"
#include "mesh/procedural/processes.h"

namespace exemplar {

ProcessSample makeFibers(const FibersProcess& process, const Vec3d& extent, std::uint64_t seed,
                         const Progress& progress) {
  const Random places(seed, stream::kFiberPlaces), shapes(seed, stream::kFiberShapes);
  const double margin = process.spacing;
  const Vec3d window = extent * process.side;
  ProcessSample sample;
  sample.box = {{0, 0, 0}, window};
  std::vector<Vec3d> axes =
      scatteredPoints(places, window.y + 2 * margin, window.z + 2 * margin, process.spacing);
  const Material materials[] = {
      {.name = "amber fiber", .baseColor = {0.62f, 0.36f, 0.12f, 1}, .roughness = 0.5f},
      {.name = "pale fiber", .baseColor = {0.76f, 0.64f, 0.44f, 1}, .roughness = 0.6f}};
  TriangleMesh byMaterial[2];
  for (std::size_t n = 0; n < axes.size(); ++n) {
    progress.report("laying fibers", static_cast<double>(n) / static_cast<double>(axes.size()));
    const double radius = shapes.uniform(process.minRadius, process.maxRadius, n, 0);
    std::vector<Vec3d> path;
    for (double x = -margin; x <= window.x + margin; x += 1.5) {
      // Two waves a fiber and direction, of lengths that no window holds twice.
      Vec3d p{x, axes[n].x - margin, axes[n].y - margin};
      for (int axis = 1; axis <= 2; ++axis) {
        for (int wave = 0; wave < 2; ++wave) {
          const int draw = 4 * axis + 2 * wave;
          const double wavelength =
              process.side * shapes.uniform(wave ? 0.35 : 0.8, wave ? 0.6 : 1.5, n, draw);
          const double phase = shapes.uniform(0, 2 * std::numbers::pi, n, draw + 1);
          p[axis] += process.waviness * (wave ? 0.3 : 0.7) *
                     std::sin(2 * std::numbers::pi * x / wavelength + phase);
        }
      }
      path.push_back(p);
    }
    append(byMaterial[shapes.below(2, n, 20)], makeTube(path, std::vector<double>{radius}, 20));
  }
  for (int m = 0; m < 2; ++m) {
    if (byMaterial[m].triangles.empty()) continue;
    setMaterial(byMaterial[m], materials[m]);
    append(sample.mesh, byMaterial[m]);
  }
  return sample;
}

}  // namespace exemplar
