// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/level_seams.h"

#include <algorithm>
#include <utility>

#include "core/cells.h"

namespace exemplar {
namespace {

/// Seams see distances up to here, in voxels: one through air or through
/// solid is free.
constexpr float kSeamTruncation = 4;
/// A few samples of a coarse level reach far: pieces grow into large ones.
constexpr SeamOptions kCoarseSeams{.reach = 16, .length = 0.05};

Array3D<float> clamped(Array3D<float> values, float limit) {
  for (float& v : values.values()) v = std::clamp(v, -limit, limit);
  return values;
}

}  // namespace

void refineSeamsAround(const Array3D<float>& source, const Array3D<float>& target,
                       const Axes& periodic, SeamOptions options, Origins& origins,
                       const Progress& progress) {
  if (!periodic.any()) {
    refineSeams(source, target, origins, options, progress);
    return;
  }
  const Vec3i n = origins.size();
  Array3D<std::uint8_t> outer(n);
  parallelForEachCell(n, [&](const Vec3i& p) {
    for (int axis = 0; axis < 3; ++axis) {
      if (periodic[axis] && (p[axis] == 0 || p[axis] == n[axis] - 1)) outer[p] = 1;
    }
  });
  const SeamOptions around = options;
  const Array3D<std::uint8_t> kept = options.fixed ? *options.fixed : Array3D<std::uint8_t>(n);
  Vec3i half{0, 0, 0};
  for (int axis = 0; axis < 3; ++axis) half[axis] = periodic[axis] ? n[axis] / 2 : 0;
  double done = 0;
  for (const Vec3i& shift : {Vec3i{0, 0, 0}, half}) {
    Array3D<std::uint8_t> fixed = rolled(kept, shift);
    for (std::size_t s = 0; s < fixed.count(); ++s) fixed.values()[s] |= outer.values()[s];
    options.fixed = &fixed;
    Array3D<std::uint8_t> air;
    if (around.air) {
      air = rolled(*around.air, shift);
      options.air = &air;
    }
    Origins moved = rolled(origins, shift);
    refineSeams(source, rolled(target, shift), moved, options, progress.part(done, done + 0.5));
    origins = rolled(moved, Vec3i{0, 0, 0} - shift);
    done += 0.5;
  }
}

void cutSeams(const PyramidLevel& level, const Array3D<float>& target, PyramidSources& sources,
              const Progress& progress) {
  const Array3D<float> source = clamped(level.source.values, kSeamTruncation);
  const bool inner = level.target.periodic.any();
  const auto cropped = [&](const auto& grid) { return inner ? withoutMargins(level, grid) : grid; };
  const PyramidSources within = cropped(sources);
  Origins origins(within.size());
  for (std::size_t s = 0; s < within.count(); ++s) {
    origins.values()[s] = Origin(within.values()[s]);
  }
  SeamOptions options = kCoarseSeams;
  Array3D<std::uint8_t> fixed;
  if (!level.target.kept.empty()) {
    fixed = cropped(level.target.kept);
    options.fixed = &fixed;
  }
  if (!level.source.usable.empty()) options.usable = &level.source.usable;
  const Array3D<std::uint8_t> air = level.airSamples();
  const Array3D<std::uint8_t> airWithin = air.empty() ? air : cropped(air);
  if (!air.empty()) options.air = &airWithin;
  refineSeamsAround(source, cropped(clamped(target, kSeamTruncation)), level.target.periodic,
                    options, origins, progress.part(0, 0.6));
  if (alignPieces(source, origins, 1, options, progress) > 0) {
    Array3D<float> shown(origins.size());
    for (std::size_t s = 0; s < shown.count(); ++s) {
      shown.values()[s] = source[origins.values()[s].cell()];
    }
    refineSeamsAround(source, shown, level.target.periodic, options, origins,
                      progress.part(0.7, 1));
  }
  const Vec3i first = inner ? level.target.margin.before : Vec3i{0, 0, 0};
  for (std::size_t s = 0; s < origins.count(); ++s) {
    sources[origins.ijk(s) + first] = origins.values()[s].cell();
  }
  pinSources(level, sources);
}

void cutJoints(const PyramidLevel& level, const Array3D<float>& target, int reach,
               PyramidSources& sources, const Progress& progress,
               const Array3D<std::uint8_t>* fixed) {
  const Array3D<std::uint8_t> air = level.airSamples();
  SeamOptions options = kCoarseSeams;
  options.fixed = fixed;
  options.passes = 1;
  options.reach = reach;
  if (!air.empty()) options.air = &air;
  Origins origins(sources.size());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    origins.values()[s] = Origin(sources.values()[s]);
  }
  refineSeams(clamped(level.source.values, kSeamTruncation), clamped(target, kSeamTruncation),
              origins, options, progress);
  for (std::size_t s = 0; s < sources.count(); ++s) {
    sources.values()[s] = origins.values()[s].cell();
  }
}

}  // namespace exemplar
