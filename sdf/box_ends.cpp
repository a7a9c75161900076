// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/box_ends.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/cells.h"

namespace exemplar {
namespace {

// How much of the fullest slabs an end must hold, and how much of it must go on.
constexpr double kFull = 0.6, kGoesOn = 0.5, kAlike = 0.5;
constexpr double kFullestSlabs = 0.75;

}  // namespace

bool looksCut(const DistanceField& field, int axis) {
  const Vec3i size = field.size();
  const int length = size[axis], u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (length < 4) return false;
  const auto width = static_cast<std::size_t>(size[u]);
  std::vector<std::vector<std::uint8_t>> slabs(
      static_cast<std::size_t>(length),
      std::vector<std::uint8_t>(width * static_cast<std::size_t>(size[v])));
  std::vector<double> solid(static_cast<std::size_t>(length));
  forEachCell(size, [&](const Vec3i& p) {
    if (!(field.values[p] < 0)) return;
    slabs[p[axis]][p[u] + width * p[v]] = 1;
    ++solid[p[axis]];
  });
  std::vector<double> sorted = solid;
  std::ranges::sort(sorted);
  const double full = sorted[static_cast<std::size_t>(kFullestSlabs * (length - 1))];
  const auto both = [](const auto& a, const auto& b) {
    double count = 0;
    for (std::size_t s = 0; s < a.size(); ++s) count += a[s] & b[s];
    return count;
  };
  for (const int end : {0, length - 1}) {
    const int inwards = end == 0 ? 1 : -1;
    if (!(solid[end] > 0) || (solid[end] + solid[end + inwards]) / 2 < kFull * full) return false;
    double goesOn = 0;
    for (int step = 1; step <= 4; ++step) {
      const int in = end + inwards * std::max(step, length * step / 16);
      const auto inner = static_cast<std::size_t>(std::clamp(in, 0, length - 1));
      const double less = std::min(solid[end], solid[inner]);
      if (less > 0) goesOn += both(slabs[end], slabs[inner]) / less / 4;
    }
    if (goesOn < kGoesOn) return false;
  }
  const double common = both(slabs.front(), slabs.back());
  return common >= kAlike * (solid.front() + solid.back() - common);
}

}  // namespace exemplar
