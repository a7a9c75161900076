// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// A program that uses the installed library: README.md shows it.

#include <cstdio>
#include <exception>

#include <exemplar/mesh/mesh_file.h>
#include <exemplar/mesh/primitives.h>
#include <exemplar/reconstruct/reconstruct.h>
#include <exemplar/sdf/mesh_to_sdf.h>
#include <exemplar/synth/geometry/quilting/quilting.h>

using namespace exemplar;

/// Writes more of four balls; whether it is a closed surface.
bool moreBalls(const char* file) {
  TriangleMesh balls;  // or readMesh("balls.obj")
  for (const Vec3d& center : {Vec3d{2, 2, 2}, {6, 3, 2}, {3, 6, 2}, {6.5, 6.5, 2}})
    append(balls, makeSphere(center, 1.5));
  const DistanceField example = meshToSdf(balls, {.resolution = 24, .padding = 2});

  const Vec3i n = example.size();
  const SynthesisResult more =
      synthesizeByQuilting(example, {.size = {2 * n.x, 2 * n.y, n.z}, .seed = 1});
  const Reconstruction surface = reconstructSurface(more.field, more.origins, {example, &balls});

  writeMesh(file, surface.mesh);
  return surface.health.closed() && surface.health.manifold();
}

int main(int argc, char** argv) try {
  if (argc != 2) return std::puts("usage: more_balls OUT.obj"), 2;
  return moreBalls(argv[1]) ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "more_balls: %s\n", error.what());
  return 2;
}
