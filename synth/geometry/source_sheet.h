// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/origin.h"
#include "synth/geometry/pyramid.h"

namespace exemplar {

/// All parts at full resolution, side by side along x with a layer of solid between them, none of
/// it usable: one field for what knows only one example. A single part that is all usable is
/// itself.
struct SourceSheet {
  DistanceField field;
  Array3D<std::uint8_t> usable;  ///< samples that may be copied, where not 0; empty: all
  std::vector<int> first;        ///< of each part, along x

  /// `parts` is not empty, and all fields are of one voxel size.
  explicit SourceSheet(const std::vector<SourcePart>& parts);

  /// A sample of the sheet (example 0, no turns) as one of the examples.
  Origin toExample(const std::vector<SourcePart>& parts, const Origin& origin) const;
};

}  // namespace exemplar
