// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// A program that uses the installed library: README.md shows it.

#include <cstdio>
#include <exception>

#include "mesh/mesh_file.h"
#include "mesh/primitives.h"
#include "reconstruct/reconstruct.h"
#include "sdf/mesh_to_sdf.h"
#include "synth/geometry/quilting/quilting.h"

int main(int argc, char** argv) try {
  using namespace exemplar;
  if (argc != 2) return std::puts("usage: more_balls OUT.obj"), 2;

  TriangleMesh balls;  // or readMesh("balls.obj")
  for (const Vec3d& center : {Vec3d{2, 2, 2}, {6, 3, 2}, {3, 6, 2}, {6.5, 6.5, 2}})
    append(balls, makeSphere(center, 1.5));
  const DistanceField example = meshToSdf(balls, {.resolution = 24, .padding = 2});

  const Vec3i n = example.size();
  const SynthesisResult more =
      synthesizeByQuilting(example, {.size = {2 * n.x, 2 * n.y, n.z}, .seed = 1});
  const Reconstruction surface = reconstructSurface(more.field, more.origins, {example, &balls});

  writeMesh(argv[1], surface.mesh);
  return surface.health.closed() && surface.health.manifold() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "more_balls: %s\n", error.what());
  return 2;
}
