// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/progress.h"
#include "search/nearest_neighbor_field.h"
#include "synth/geometry/pyramid/pyramid.h"

namespace exemplar {

/// The field that the search for a level's target starts from: each patch, on a lattice of this
/// stride, at where its middle comes from.
NearestNeighborField fieldOf(const PyramidLevel& level, const PyramidSources& sources,
                             const Vec3i& stride);

/// Each sample of a level's target, of this size, becomes the mean of what the patches that cover
/// it hold there, weighted by how near each is to its match and the sample to its middle (Kwatra et
/// al., "Texture optimization for example-based synthesis", SIGGRAPH 2005,
/// doi:10.1145/1073204.1073263, section 3.2). Throws `Cancelled`.
Array3D<float> vote(const PyramidLevel& level, const NearestNeighborField& field, const Vec3i& size,
                    const Progress& progress = {});

/// Each sample takes the source on which the patches that cover it agree most, by the same weights;
/// the first in the order of the patches on ties. With `where` (of this size) only those whose mark
/// is not 0; what the others have then means nothing. Throws `Cancelled`.
PyramidSources plurality(const PyramidLevel& level, const NearestNeighborField& field,
                         const Vec3i& size, const Array3D<std::uint8_t>* where = nullptr,
                         const Progress& progress = {});

}  // namespace exemplar
