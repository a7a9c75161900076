// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "synth/geometry/pyramid.h"

namespace exemplar {

/// The samples of a level's target beside a seam that shows: where neighbours x (copied at offset
/// a) and y (at b) have |E(x + a) - E(x + b)| + |E(y + a) - E(y + b)| above `limit`, in voxels of
/// the level, distances cut off at four. Not 0 where so; of the target's size.
Array3D<std::uint8_t> badSeams(const PyramidLevel& level, const PyramidSources& sources,
                               double limit);

/// The patches, on a lattice of this stride and shape, that cover a marked sample.
Array3D<std::uint8_t> patchesCovering(const Array3D<std::uint8_t>& samples, const Vec3i& patch,
                                      const Vec3i& stride, const Vec3i& shape);

/// The samples, in a grid of this size, that marked patches cover.
Array3D<std::uint8_t> samplesCovered(const Array3D<std::uint8_t>& patches, const Vec3i& patch,
                                     const Vec3i& stride, const Vec3i& size);

struct RepairOptions {
  std::uint64_t seed = 0;
  double limit = 2;          ///< seams whose two sides differ by more, in voxels of the level, show
  int rounds = 1;            ///< of matches and votes, >= 1
  int stride = 2;            ///< of patches along each axis, samples, 1..patch
  Vec3i window{-1, -1, -1};  ///< how far from its place a patch may come from; negative: anywhere
  float truncation = 4;      ///< of the air that the target is framed by, voxels
};

/// Optimises away the seams that show: patches that cover one are searched for and vote, and what
/// they cover takes their sources; all else stays as copied. `target` is what `sources` show, and
/// what the votes made of it afterwards. Returns how many patches were searched for. Deterministic;
/// when cancelled, `sources` stay as they were.
std::int64_t repairSeams(const PyramidLevel& level, const RepairOptions& options,
                         PyramidSources& sources, Array3D<float>& target,
                         const Progress& progress = {});

}  // namespace exemplar
