// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "core/axes.h"
#include "core/cells.h"
#include "core/progress.h"
#include "sdf/distance_field.h"
#include "synth/geometry/pyramid/source_part.h"

namespace exemplar {

/// What a pyramid is made for.
struct PyramidOptions {
  Vec3i size{0, 0, 0};    ///< of the result, samples
  int patch = 7;          ///< samples a side
  int stride = 2;         ///< patches this far apart must cover the target, samples
  double truncation = 4;  ///< voxels of the level
  Axes periodic;
  /// Samples of the result that are given: of the result's size, where not 0, or none. Where v,
  /// the sample is the first part's at its place less `keptOffsets[v - 1]`, or at its place where
  /// there are no offsets. They lie inside that part.
  const Array3D<std::uint8_t>* kept = nullptr;
  std::span<const Vec3i> keptOffsets;
  /// What the solid should be near to: of the result's size, in voxels; or none.
  const Array3D<float>* guide = nullptr;
};

/// Throws `InputError` where no result of these options can be made from the examples: of different
/// voxel sizes, too long, or too many of them; a size, patch or truncation out of range; more
/// memory than the machine has. `turned`: parts are turned, too. `levels`: as an engine's option.
void checkPyramid(std::span<const DistanceField* const> examples, bool turned,
                  const PyramidOptions& options, std::optional<int> levels);

/// What level `l` of `levels` reports to, of the work on all of them: each has about eight times as
/// much as the next coarser one, and the coarsest is first.
Progress levelProgress(const Progress& progress, int l, int levels);

/// Layers of samples before and after a box, along each axis.
struct Margin {
  Vec3i before{0, 0, 0}, after{0, 0, 0};

  bool any() const { return before != Vec3i{0, 0, 0} || after != Vec3i{0, 0, 0}; }
};

/// What a level copies from: all parts, shrunk, side by side along x with a layer of solid between
/// them.
struct LevelSource {
  Array3D<float> values;            ///< in voxels of the level
  Array3D<std::uint8_t> usable;     ///< samples that may be copied; empty: all
  Array3D<std::uint8_t> matchable;  ///< patches that may be matched, by first sample; empty: all
  std::vector<CellBox> parts;       ///< without their frames
  /// The frame of air around each part: on sides on which all parts end in air, along axes that are
  /// not periodic.
  Margin air;

  /// The part that a sample belongs to.
  std::size_t partOf(const Vec3i& cell) const;
  /// A part with its frame.
  CellBox framed(std::size_t part) const {
    return {parts[part].begin - air.before, parts[part].end + air.after};
  }
};

/// What a level makes.
struct LevelTarget {
  Vec3i size;  ///< of the result at this level
  /// The source's frame of air, or along periodic axes a margin that repeats what lies at the other
  /// side; and at the end some samples more, so that patches cover all.
  Margin margin;
  Axes periodic;
  Array3D<std::uint8_t> kept;      ///< with the margin; empty: none
  std::vector<Vec3i> keptOffsets;  ///< samples of the level; empty: none is moved

  Vec3i framed() const { return size + margin.before + margin.after; }
  /// A sample, margins included, brought inside along periodic axes.
  Vec3i wrapped(Vec3i p) const;
};

/// A second channel by which patches are matched; empty: none.
struct LevelGuide {
  Array3D<float> source, target;

  bool any() const { return !target.empty(); }
};

/// One level of the pyramid.
struct PyramidLevel {
  LevelSource source;
  LevelTarget target;
  LevelGuide guide;
  Vec3i patch;  ///< samples

  /// Where the target takes nothing solid, of its size: in its frame of air, and the outermost
  /// layer of the result inside of it. Empty where there is no frame.
  Array3D<std::uint8_t> airSamples() const;
  /// The offset that leaves the first part where it is.
  Vec3i inPlace() const { return source.parts[0].begin - target.margin.before; }
  /// The source of a kept sample of the target.
  Vec3i keptSource(const Vec3i& p) const {
    const Vec3i there = p + inPlace();
    return target.keptOffsets.empty() ? there : there - target.keptOffsets[target.kept[p] - 1U];
  }
};

/// Where each sample of a level's target comes from in its source.
using PyramidSources = Array3D<Vec3i>;

/// The level at which 2^l samples become one. Where no patch of the source would be matchable,
/// patches are smaller; where not even that helps, all are.
PyramidLevel makeLevel(std::span<const SourcePart> parts, int l, const PyramidOptions& options);

/// Where the samples of `fine` come from if all pieces of `coarse` become twice as large.
PyramidSources refineSources(const PyramidLevel& coarse, const PyramidSources& from,
                             const PyramidLevel& fine);

/// What the sources show.
Array3D<float> gather(const PyramidLevel& level, const PyramidSources& sources);

/// Makes a target hold what it must: air in its frame, in its margins what lies at the other side,
/// and what is kept.
void pinTarget(const PyramidLevel& level, float air, Array3D<float>& target);
void pinSources(const PyramidLevel& level, PyramidSources& sources);

/// The inner part of a target or of its sources.
template <class T>
Array3D<T> withoutMargins(const PyramidLevel& level, const Array3D<T>& framed) {
  Array3D<T> inner(level.target.size);
  parallelForEachCell(inner.size(),
                      [&](const Vec3i& p) { inner[p] = framed[p + level.target.margin.before]; });
  return inner;
}

/// `grid` moved round by `shift`: sample p goes to p + shift, modulo the size.
template <class T>
Array3D<T> rolled(const Array3D<T>& grid, const Vec3i& shift) {
  Array3D<T> moved(grid.size());
  const Vec3i n = grid.size();
  parallelForEachCell(n, [&](const Vec3i& cell) {
    Vec3i p = cell + shift;
    for (int axis = 0; axis < 3; ++axis) p[axis] = (p[axis] % n[axis] + n[axis]) % n[axis];
    moved[p] = grid[cell];
  });
  return moved;
}

}  // namespace exemplar
