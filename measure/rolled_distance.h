// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/progress.h"
#include "measure/occupancy.h"

/// How far a result is from its example however that is moved: what moving cannot cheat.
namespace exemplar {

struct RolledDistanceOptions {
  /// All quarter turns of the example about z, and their mirror images, are tried, too.
  bool turned = false;
  /// Up to this many cells of the example all shifts are compared cell by cell. Of a larger one
  /// they are compared at fewer, larger cells; the sixteen best are then moved cell by cell for as
  /// long as that makes them better. >= 1.
  std::int64_t cells = std::int64_t{1} << 21;
};

/// 1 - IoU of a result's solid with that of its example, *rolled*: moved by the shift, of all, at
/// which the two agree best, what leaves the example's box on one side coming in on the other.
///
/// 0 for a copy, for a moved copy, for an example cut once (or once along each axis) whose parts
/// were exchanged, and for a tiling with the example at any phase.
///
/// A result larger than the example is cut into windows of the example's size, as few as cover it,
/// evenly spaced from face to face; each takes its own shift, and the solid of all is counted
/// together. One that is smaller along an axis is compared with the part of the rolled example that
/// it covers.
struct RolledDistance {
  double distance = 0;  ///< of all windows together; 0..1
  double least = 0;     ///< of the window that is most like the example; 0..1
  int windows = 1;
  Vec3i shift{};  ///< of the window that is most like it
};

/// Two FFTs of the example's size for each window (eight times that where turned): about 0.1 s at
/// 128³. 0 where both are empty. The same bytes at any number of threads. Throws `Cancelled`.
RolledDistance rolledDistance(const Occupancy& example, const Occupancy& result,
                              const RolledDistanceOptions& options = {},
                              const Progress& progress = {});

/// *Div* after the best roll: the mean of `rolledDistance` over all pairs of results (one a seed,
/// all of one size). Seeds that differ only in how the example was moved have 0, where `diversity`
/// is fooled by a voxel. 0 for fewer than two results. Throws `InputError` where sizes differ, and
/// `Cancelled`.
double rolledDiversity(std::span<const Occupancy> results,
                       const RolledDistanceOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
