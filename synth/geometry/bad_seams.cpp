// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/bad_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"
#include "search/nearest_neighbor_field.h"
#include "synth/geometry/patch_vote.h"

namespace exemplar {
namespace {

constexpr float kLimit = 4;
constexpr std::uint32_t kRepairStream = 0x0b74;
/// Of PatchMatch, from a field that is nearly right.
constexpr int kIterations = 2;

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

std::int64_t repairSeams(const PyramidLevel& level, const RepairOptions& options,
                         PyramidSources& sources, Array3D<float>& target,
                         const Progress& progress) {
  const Vec3i size = level.framedTarget();
  NearestNeighborFieldOptions search;
  search.patch = level.patch;
  search.method = NeighborMethod::PatchMatch;
  search.stride = min(Vec3i{options.stride, options.stride, options.stride}, level.patch);
  search.iterations = kIterations;
  search.window = options.window;
  NearestNeighborField field = fieldOf(level, sources, search.stride);
  const Array3D<std::uint8_t> wanted = patchesCovering(
      badSeams(level, sources, options.limit), level.patch, search.stride, field.position.size());
  const std::int64_t many = std::count(wanted.values().begin(), wanted.values().end(), 1);
  if (many == 0) return 0;
  search.wanted = &wanted;
  for (int round = 0; round < options.rounds; ++round) {
    search.seed = Random(options.seed, kRepairStream).bits(0, round);
    const NearestNeighborField previous = std::move(field);
    search.start = &previous;
    field = nearestNeighborField({level.source}, {target}, search, progress);
    if (progress.cancelled()) return many;
    target = vote(level, field, size);
    pinTarget(level, options.truncation, target);
  }
  const Array3D<std::uint8_t> changed = samplesCovered(wanted, level.patch, search.stride, size);
  const PyramidSources found = plurality(level, field, size, &changed);
  for (std::size_t s = 0; s < sources.count(); ++s) {
    if (changed.values()[s]) sources.values()[s] = found.values()[s];
  }
  return many * options.rounds;
}

}  // namespace exemplar
