// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/slice_docking.h"

#include <algorithm>
#include <cmath>

#include "core/cells.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Slices are compared at about this many columns.
constexpr int kColumns = 2048;
/// Distances count up to here, voxels.
constexpr float kLimit = 3;
/// How much the surface changes is averaged over so many slices to either side.
constexpr int kSmooth = 3;
/// A column has the surface near a slice where that is within so many voxels of it.
constexpr float kNear = 1.5F;

/// What it costs that two sides of a joint differ by `d` voxels: steps of a voxel can be evened
/// out, larger ones tear.
float misfit(float d) { return (d + d * d) / 2; }

}  // namespace

SliceDocking::SliceDocking(const DistanceField& example, int axis, const Progress& progress)
    : slices_(example.size()[axis]) {
  const Vec3i n = example.size();
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  int step = 1;
  while ((n[u] / step) * (n[v] / step) > kColumns) ++step;
  const int across = (n[u] + step - 1) / step, along = (n[v] + step - 1) / step;
  const auto columns = static_cast<std::size_t>(across) * static_cast<std::size_t>(along);
  const auto count = static_cast<std::size_t>(slices_);
  const auto voxel = static_cast<float>(example.voxelSize);

  std::vector<float> values(columns * count);
  parallelFor(0, count, 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t s = from; s < to; ++s) {
      Vec3i p;
      p[axis] = static_cast<int>(s);
      for (std::size_t c = 0; c < columns; ++c) {
        p[u] = static_cast<int>(c) % across * step;
        p[v] = static_cast<int>(c) / across * step;
        values[s * columns + c] = std::clamp(example.values[p] / voxel, -kLimit, kLimit);
      }
    }
  });
  sections_.assign(count, 0);
  forEachCell(n, [&](const Vec3i& p) {
    if (example.values[p] < 0) sections_[static_cast<std::size_t>(p[axis])] += 1;
  });
  const auto isSolid = [](double section) { return section > 0; };
  const auto first = std::find_if(sections_.begin(), sections_.end(), isSolid);
  solidBegin_ = static_cast<int>(first - sections_.begin());
  const auto last = std::find_if(sections_.rbegin(), sections_.rend(), isSolid);
  solidEnd_ = std::max(solidBegin_, static_cast<int>(sections_.rend() - last));
  double solid = 0;
  for (const double section : sections_) solid += section;
  for (double& section : sections_) section *= (solidEnd_ - solidBegin_) / std::max(1.0, solid);

  double surface = 0;
  for (const float value : values) surface += std::abs(value) < kNear;
  surface /= std::max(1, solidEnd_ - solidBegin_);

  changes_.assign(count, 1);
  for (std::size_t s = 0; s < count; ++s) {
    double sum = 0, near = 0;
    for (int t = -kSmooth; t <= kSmooth; ++t) {
      const int at = static_cast<int>(s) + t;
      if (at < 1 || at + 1 >= slices_) continue;
      const float* here = &values[static_cast<std::size_t>(at) * columns];
      for (std::size_t c = 0; c < columns; ++c) {
        if (std::abs(here[c]) >= kNear) continue;
        const float* column = here + c;
        const float slope = std::min(1.0F, std::abs(column[columns] - *(column - columns)) / 2);
        sum += slope * slope;
        near += 1;
      }
    }
    if (near > 0) changes_[s] = sum / std::min(near, (2 * kSmooth + 1) * surface);
  }

  costs_.assign(count * count, 0);
  parallelFor(0, count, 1, [&](std::size_t from, std::size_t to) {
    std::vector<float> least(columns), before(columns);
    for (std::size_t a = from; a < to; ++a) {
      progress.check();
      for (std::size_t b = a + 1; b < count; ++b) {
        std::fill(least.begin(), least.end(), kLimit);
        // In value and slope: at two slices that follow each other.
        std::fill(before.begin(), before.end(), kLimit);
        for (int t = -kJointReach; t < kJointReach; ++t) {
          const int s = static_cast<int>(a) + t, q = static_cast<int>(b) + t;
          if (s < 0 || q >= slices_) continue;
          const float* one = &values[static_cast<std::size_t>(s) * columns];
          const float* other = &values[static_cast<std::size_t>(q) * columns];
          for (std::size_t c = 0; c < columns; ++c) {
            const float d = std::abs(one[c] - other[c]);
            least[c] = std::min(least[c], std::max(d, before[c]));
            before[c] = d;
          }
        }
        double sum = 0;
        for (std::size_t c = 0; c < columns; ++c) sum += misfit(least[c]);
        const auto cost = static_cast<float>(sum / std::max(1.0, surface));
        costs_[a * count + b] = costs_[b * count + a] = cost;
      }
    }
  });
}

}  // namespace exemplar
