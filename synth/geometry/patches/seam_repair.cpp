// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/patches/seam_repair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cells.h"
#include "core/random.h"
#include "search/nearest_neighbor_field.h"
#include "synth/geometry/patches/patch_vote.h"

namespace exemplar {
namespace {

/// Distances count up to here, voxels of the level.
constexpr float kLimit = 4;
/// Of PatchMatch, from a field that is nearly right.
constexpr int kIterations = 2;

}  // namespace

Array3D<std::uint8_t> badSeams(const PyramidLevel& level, const PyramidSources& sources,
                               double limit) {
  Array3D<std::uint8_t> bad(sources.size());
  const auto copied = [&](const Vec3i& cell) {
    return std::clamp(level.source.values[level.source.values.clamped(cell)], -kLimit, kLimit);
  };
  parallelForEachCell(sources.size(), [&](const Vec3i& x) {
    const Vec3i from = sources[x];
    for (const Vec3i& step : kFaceSteps) {
      if (!sources.contains(x + step)) continue;
      const Vec3i there = sources[x + step];
      if (there == from + step) continue;
      const float cost = std::abs(copied(from) - copied(there - step)) +
                         std::abs(copied(from + step) - copied(there));
      if (static_cast<double>(cost) > limit) bad[x] = 1;
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
    parallelForEachCell(size, [&](const Vec3i& cell) {
      Vec3i p = cell;
      p[axis] *= stride[axis];
      for (int i = 0; i < patch[axis] && !next[cell]; ++i, ++p[axis]) {
        if (marked.contains(p)) next[cell] = marked[p];
      }
    });
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
    forEachCell(marked.size(), [&](const Vec3i& cell) {
      if (!marked[cell]) return;
      Vec3i p = cell;
      p[axis] *= stride[axis];
      for (int i = 0; i < patch[axis]; ++i, ++p[axis]) {
        if (next.contains(p)) next[p] = 1;
      }
    });
    marked = std::move(next);
  }
  return marked;
}

std::int64_t repairSeams(const PyramidLevel& level, const SeamRepairOptions& options,
                         PyramidSources& sources, Array3D<float>& target,
                         const Progress& progress) {
  const Vec3i size = level.target.framed();
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
    search.seed = Random(options.seed, stream::kSeamRepair).bits(0, round);
    const NearestNeighborField previous = std::move(field);
    search.start = &previous;
    field = nearestNeighborField({level.source.values}, {target}, search,
                                 progress.part(round / static_cast<double>(options.rounds),
                                               (round + 1) / static_cast<double>(options.rounds)));
    progress.check();
    target = vote(level, field, size, progress);
    pinTarget(level, options.truncation, target);
  }
  const Array3D<std::uint8_t> changed = samplesCovered(wanted, level.patch, search.stride, size);
  const PyramidSources found = plurality(level, field, size, &changed, progress);
  for (std::size_t s = 0; s < sources.count(); ++s) {
    if (changed.values()[s]) sources.values()[s] = found.values()[s];
  }
  return many * options.rounds;
}

}  // namespace exemplar
