// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/bad_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr float kLimit = 4;

}  // namespace

Array3D<std::uint8_t> badSeams(const PyramidLevel& level, const PyramidSources& sources,
                               double limit) {
  Array3D<std::uint8_t> bad(sources.size());
  const auto copied = [&](const Vec3i& cell) {
    return std::clamp(level.source[level.source.clamped(cell)], -kLimit, kLimit);
  };
  const std::size_t row = static_cast<std::size_t>(sources.size().x);
  parallelFor(0, sources.count() / row, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin * row; s < end * row; ++s) {
      const Vec3i x = sources.ijk(s), from = sources.values()[s];
      for (int direction = 0; direction < 6 && !bad.values()[s]; ++direction) {
        Vec3i step{0, 0, 0};
        step[direction / 2] = direction % 2 ? -1 : 1;
        if (!sources.contains(x + step)) continue;
        const Vec3i there = sources[x + step];
        if (there == from + step) continue;
        const float cost = std::abs(copied(from) - copied(there - step)) +
                           std::abs(copied(from + step) - copied(there));
        bad.values()[s] = static_cast<double>(cost) > limit;
      }
    }
  });
  return bad;
}

Array3D<std::uint8_t> patchesCovering(const Array3D<std::uint8_t>& samples, const Vec3i& patch,
                                      const Vec3i& stride, const Vec3i& shape) {
  // Along one axis after the other, each shrinking to the lattice.
  Array3D<std::uint8_t> marked = samples;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3i size = marked.size();
    size[axis] = shape[axis];
    Array3D<std::uint8_t> next(size);
    for (std::size_t s = 0; s < next.count(); ++s) {
      Vec3i p = next.ijk(s);
      p[axis] *= stride[axis];
      for (int i = 0; i < patch[axis] && !next.values()[s]; ++i, ++p[axis]) {
        if (marked.contains(p)) next.values()[s] = marked[p];
      }
    }
    marked = std::move(next);
  }
  return marked;
}

Array3D<std::uint8_t> samplesCovered(const Array3D<std::uint8_t>& patches, const Vec3i& patch,
                                     const Vec3i& stride, const Vec3i& size) {
  Array3D<std::uint8_t> marked = patches;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3i grown = marked.size();
    grown[axis] = size[axis];
    Array3D<std::uint8_t> next(grown);
    for (std::size_t s = 0; s < marked.count(); ++s) {
      if (!marked.values()[s]) continue;
      Vec3i p = marked.ijk(s);
      p[axis] *= stride[axis];
      for (int i = 0; i < patch[axis]; ++i, ++p[axis]) {
        if (next.contains(p)) next[p] = 1;
      }
    }
    marked = std::move(next);
  }
  return marked;
}

}  // namespace exemplar
