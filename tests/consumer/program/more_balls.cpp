// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// A program that uses the installed library: README.md shows it.

#include <cstdio>
#include <exception>

#include <exemplar/engine/engine.h>
#include <exemplar/engine/realize.h>
#include <exemplar/mesh/mesh_file.h>
#include <exemplar/mesh/primitives.h>

using namespace exemplar;

/// Writes more of four balls; whether it is a closed surface.
bool moreBalls(const char* file) {
  TriangleMesh balls;  // or a path: readExample("balls.obj", ...)
  for (const Vec3d& center : {Vec3d{2, 2, 2}, {6, 3, 2}, {3, 6, 2}, {6.5, 6.5, 2}})
    append(balls, makeSphere(center, 1.5));
  const Example example = readExample(Source::of(balls), {.resolution = 24, .padding = 2});

  Request request;
  request.extent.scale = Vec3d{2, 2, 1};
  request.seed = 1;
  const Result more = engineNamed("geometry").run({&example, 1}, request);
  const Surface surface = realize(more, {&example, 1});

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
