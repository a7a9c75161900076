// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "synth/geometry/pyramid/pyramid.h"

namespace exemplar {

/// Marks (not 0) the samples of a level's target beside a seam that shows: where neighbors x
/// (copied at offset a) and y (at b) have |E(x + a) - E(x + b)| + |E(y + a) - E(y + b)| above
/// `limit`, in voxels of the level, distances cut off at four.
Array3D<std::uint8_t> badSeams(const PyramidLevel& level, const PyramidSources& sources,
                               double limit);

/// The patches, on a lattice of this stride and shape, that cover a marked sample.
Array3D<std::uint8_t> patchesCovering(const Array3D<std::uint8_t>& samples, const Vec3i& patch,
                                      const Vec3i& stride, const Vec3i& shape);

/// The samples, in a grid of this size, that marked patches cover.
Array3D<std::uint8_t> samplesCovered(const Array3D<std::uint8_t>& patches, const Vec3i& patch,
                                     const Vec3i& stride, const Vec3i& size);

struct SeamRepairOptions {
  std::uint64_t seed = 0;
  double limit = 2;          ///< seams whose two sides differ by more, in voxels of the level, show
  int rounds = 1;            ///< of matches and votes, >= 1
  int stride = 2;            ///< of patches along each axis, samples, 1..patch
  Vec3i window{-1, -1, -1};  ///< how far from its place a patch may come from; negative: anywhere
  float truncation = 4;      ///< of the air that the target is framed by, voxels
};

/// Replaces what is beside seams that show: patches that cover one are matched and vote, and the
/// samples that they cover take the patches' sources; everything else stays as copied. `target` is
/// what `sources` show, and afterwards what the votes made of it. Returns how many patches were
/// searched for. Deterministic. Throws `Cancelled` with `sources` as they were.
std::int64_t repairSeams(const PyramidLevel& level, const SeamRepairOptions& options,
                         PyramidSources& sources, Array3D<float>& target,
                         const Progress& progress = {});

}  // namespace exemplar
