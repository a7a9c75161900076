// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>

#include "core/array3d.h"
#include "core/loop_progress.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "sdf/triangle_tree.h"

namespace exemplar {

/// Calls body(low, high) for each block of samples of a box of `size`, in parallel: [low, high), at
/// most `side` samples a side. Reports as `stage`. Throws `Cancelled`.
template <class Body>
void forBlocks(const Vec3i& size, int side, const Progress& progress, std::string_view stage,
               const Body& body) {
  const auto blocks = [&](int n) { return static_cast<std::size_t>(n / side + (n % side != 0)); };
  const std::size_t nx = blocks(size.x), ny = blocks(size.y), nz = blocks(size.z);
  LoopProgress done(progress, stage, nx * ny * nz);
  parallelFor(0, nx * ny * nz, 1, [&](std::size_t b0, std::size_t b1) {
    for (std::size_t b = b0; b < b1; ++b) {
      const Vec3i low = Vec3i{static_cast<int>(b % nx), static_cast<int>(b / nx % ny),
                              static_cast<int>(b / (nx * ny))} *
                        side;
      body(low, min(low + Vec3i{side, side, side}, size));
      done.advance();
    }
  });
}

/// Visits the samples of a block to and fro, so that each one is next to the one before.
template <class Visit>
void serpentine(const Vec3i& low, const Vec3i& high, const Visit& visit) {
  bool backJ = false, backI = false;
  for (int k = low.z; k < high.z; ++k, backJ = !backJ) {
    for (int b = low.y; b < high.y; ++b, backI = !backI) {
      const int j = backJ ? high.y - 1 - (b - low.y) : b;
      for (int a = low.x; a < high.x; ++a) {
        visit(Vec3i{backI ? high.x - 1 - (a - low.x) : a, j, k});
      }
    }
  }
}

/// Sets each sample ijk to the distance of the point low + ijk from the surface where it is less
/// than `limit`, else to `limit`, which may be infinite. Exact; about 1 microsecond for each sample
/// within the limit, far blocks of samples are skipped at once. Throws `Cancelled`.
void sampleDistances(const TriangleTree& surface, double limit, const Vec3i& low,
                     Array3D<float>& distances, const Progress& progress = {});

}  // namespace exemplar
