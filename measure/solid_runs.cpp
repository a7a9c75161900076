// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/solid_runs.h"

#include <bit>

namespace exemplar {

SolidRuns::SolidRuns(const Occupancy& occupancy, const Progress& progress)
    : rowsPerLayer_(static_cast<std::size_t>(occupancy.size().y)), sets_(0) {
  const Vec3i n = occupancy.size();
  rowStart_.push_back(0);
  const auto join = [&](const Run& a, const Run& b) { sets_.join(a.id, b.id); };
  for (int z = 0; z < n.z; ++z) {
    progress.report("finding pieces", static_cast<double>(z) / n.z);
    for (int y = 0; y < n.y; ++y) {
      for (int x = 0; x < n.x;) {
        const std::uint64_t cells = occupancy.bits(x, y, z);
        if ((cells & 1) == 0) {
          x += std::countr_zero(cells);
          continue;
        }
        const int first = x;
        for (int solid = 64; solid == 64; x += solid)
          solid = std::countr_one(occupancy.bits(x, y, z));
        runs_.push_back({first, x, sets_.add()});
      }
      rowStart_.push_back(runs_.size());
      if (y > 0) forEachOverlap(row(y - 1, z), row(y, z), join);
      if (z > 0) forEachOverlap(row(y, z - 1), row(y, z), join);
    }
  }
}

}  // namespace exemplar
