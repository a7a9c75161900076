// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct PartExchangeOptions {
  std::uint64_t seed = 0;
  /// Parts are exchanged until the object differs from the example by this much, 1 - IoU; 0..1.
  double novelty = 0.25;
};

struct PartExchange {
  /// Which sample of the example each sample shows, less where it is; of the example's size.
  Array3D<Vec3i> offsets;
  /// Where that changes what is shown: seams may go anywhere but here. Of the example's size.
  Array3D<std::uint8_t> changed;
  int parts = 0;        ///< that were exchanged
  double distance = 0;  ///< to the example in place, 1 - IoU
};

/// Exchanges parts of an object that stands alone with others of its parts, with what is beside
/// them, or with nothing: a branch grows elsewhere, a house takes the place of another.
///
/// Laid over itself with an offset, the object agrees with itself in places: there it docks
/// (Bokeloh, Wand, Seidel: "A connection between partial symmetry and inverse procedural modeling",
/// SIGGRAPH 2010, doi:10.1145/1778765.1778841, section 3, on samples in place of triangles). What
/// is between falls into connected parts, each of which may be replaced by what lies over it, as
/// the border all around agrees. Offsets are drawn between places of the surface that look alike; a
/// part is taken where it changes the object, leaves its foot and its extent as they are, keeps the
/// share of solid within a twentieth, and lets nothing fall apart.
///
/// O(samples x offsets that are tried, at most 80). The same bytes at any number of threads. Throws
/// `Cancelled`.
PartExchange exchangeParts(const DistanceField& example, const PartExchangeOptions& options = {},
                           const Progress& progress = {});

}  // namespace exemplar
