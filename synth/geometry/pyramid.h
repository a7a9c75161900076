// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "core/origin.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Along which axes a result goes on at its opposite side.
struct PeriodicAxes {
  bool x = false, y = false, z = false;
  bool operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool any() const { return x || y || z; }
  bool operator==(const PeriodicAxes&) const = default;
};

/// An example as it is copied from: turned by quarter turns about z.
struct SourcePart {
  DistanceField field;  ///< turned
  int example = 0;      ///< its number
  int turns = 0;        ///< quarter turns anticlockwise, 0..3
  /// Samples that may be copied, where not 0; empty: all.
  Array3D<std::uint8_t> usable;

  /// The sample of the example as it came that a sample of `field` is.
  Vec3i unturned(const Vec3i& cell) const;
};

/// `field` turned by quarter turns about z, anticlockwise; samples change places only.
DistanceField turnedField(const DistanceField& field, int turns);

/// What a pyramid is made for.
struct PyramidOptions {
  Vec3i size{0, 0, 0};    ///< of the result, samples
  int patch = 7;          ///< samples a side
  int stride = 2;         ///< that patches at this distance shall cover the target
  double truncation = 4;  ///< voxels of the level
  PeriodicAxes periodic;
  /// Samples of the result that are given: the first part's at the same place. Of the result's
  /// size, where not 0; or none. They lie inside that part.
  const Array3D<std::uint8_t>* kept = nullptr;
  /// What the solid should be near to: of the result's size, in voxels; or none.
  const Array3D<float>* guide = nullptr;
};

/// One level of the pyramid: all parts, shrunk, in voxels of the level, side by side along x with
/// a layer of solid between them. Sides on which all parts end in air, along axes that are not
/// periodic, are framed by air. The target has the same frame, or along periodic axes a margin that
/// repeats what lies at the other side, and some samples more at its end.
struct PyramidLevel {
  Array3D<float> source;
  Array3D<std::uint8_t> usable;   ///< samples of `source` that may be copied; empty: all
  Array3D<std::uint8_t> allowed;  ///< patches of `source` that may be matched; empty: all
  std::vector<Vec3i> first;       ///< of each part: its first sample, behind the frame
  std::vector<Vec3i> partSize;    ///< without the frame
  Vec3i patch;
  Vec3i targetSize;     ///< of the result at this level, without frame and margins
  Vec3i before, after;  ///< the target's frame or margin
  Vec3i low, high;      ///< the source's frame
  PeriodicAxes periodic;
  Array3D<std::uint8_t> kept;               ///< of the target, with frame and margins; empty: none
  Array3D<float> guideSource, guideTarget;  ///< a second channel; empty: none

  Vec3i framedTarget() const { return targetSize + before + after; }
  /// The part that a sample of `source` belongs to.
  std::size_t partOf(const Vec3i& cell) const;
  /// Where the target takes nothing solid, of its size: in its frame of air, and the outermost
  /// layer of the result inside of it. Empty where there is no frame.
  Array3D<std::uint8_t> airSamples() const;
  /// The offset that leaves the first part where it is.
  Vec3i inPlace() const { return first[0] - before; }
  /// The source of a kept sample of the target.
  Vec3i keptSource(const Vec3i& p) const { return p + inPlace(); }
};

/// Where each sample of a level's target comes from in its source.
using PyramidSources = Array3D<Vec3i>;

/// The level at which 2^l samples become one. Where no patch of the source would be allowed,
/// patches are smaller; where not even that helps, all are allowed.
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

/// The inner part of a target or of its sources, and one with its margins back.
template <class T>
Array3D<T> withoutMargins(const PyramidLevel& level, const Array3D<T>& framed) {
  Array3D<T> inner(level.targetSize);
  for (std::size_t s = 0; s < inner.count(); ++s) {
    inner.values()[s] = framed[inner.ijk(s) + level.before];
  }
  return inner;
}

/// `grid` moved round by `shift`: sample p goes to p + shift, modulo the size.
template <class T>
Array3D<T> rolled(const Array3D<T>& grid, const Vec3i& shift) {
  Array3D<T> moved(grid.size());
  const Vec3i n = grid.size();
  for (std::size_t s = 0; s < grid.count(); ++s) {
    Vec3i p = grid.ijk(s) + shift;
    for (int axis = 0; axis < 3; ++axis) p[axis] = (p[axis] % n[axis] + n[axis]) % n[axis];
    moved[p] = grid.values()[s];
  }
  return moved;
}

}  // namespace exemplar
