// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/same_voxels.h"

#include <cmath>
#include <sstream>

#include "core/error.h"

namespace exemplar {

void requireSameVoxels(const DistanceField& example, const DistanceField& result) {
  if (example.values.empty() || result.values.empty())
    throw InputError(std::string("the ") + (example.values.empty() ? "example" : "result") +
                     " has no samples; give a field with at least one");
  if (!(std::abs(example.voxelSize - result.voxelSize) <= 1e-3 * example.voxelSize)) {
    std::ostringstream message;
    message << "the example has voxels of " << example.voxelSize << " and the result of "
            << result.voxelSize << "; measure both at the same voxel size";
    throw InputError(message.str());
  }
}

}  // namespace exemplar
