// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

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

}  // namespace exemplar
