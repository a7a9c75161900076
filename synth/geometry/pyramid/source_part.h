// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/array3d.h"
#include "core/origin.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// An example as it is copied from: turned by quarter turns about z.
struct SourcePart {
  DistanceField field;  ///< turned
  int example = 0;      ///< its number
  int turns = 0;        ///< quarter turns anticlockwise, 0..3
  /// Samples that may be copied, where not 0; empty: all.
  Array3D<std::uint8_t> usable;

  /// Which sample of the example, as it was read, a sample of `field` is.
  Vec3i unturned(const Vec3i& cell) const { return turnedCell(cell, field.size(), -turns); }
};

/// `field` turned by quarter turns about z, anticlockwise; samples only change places.
DistanceField turnedField(const DistanceField& field, int turns);

/// All parts at full resolution, side by side along x with a layer of solid between them, none of
/// it usable: one field for steps that know a single example. A single part that is all usable is
/// left as it is.
struct SourceSheet {
  DistanceField field;
  Array3D<std::uint8_t> usable;  ///< samples that may be copied, where not 0; empty: all
  std::vector<int> first;        ///< of each part, along x

  /// `parts` is not empty, and all fields have one voxel size.
  explicit SourceSheet(const std::vector<SourcePart>& parts);

  /// A sample of the sheet (example 0, no turns) as one of the examples.
  Origin toExample(const std::vector<SourcePart>& parts, const Origin& origin) const;
};

}  // namespace exemplar
