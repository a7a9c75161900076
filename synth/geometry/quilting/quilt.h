// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>

#include "core/progress.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/quilting/repetition.h"

namespace exemplar {

/// A copy of the example that is moved by this much is a copy still, samples.
inline constexpr int kCopyReach = 2;
/// The least distance (1 - IoU) of a result of the example's own size to the example, wherever it
/// is laid within `kCopyReach`.
inline constexpr double kNovelty = 0.15;

struct QuiltOptions {
  std::uint64_t seed = 0;
  /// Side of a block, of the example's; along axes along which the result is longer than one and a
  /// half examples, the second. > 0, at most 1. Larger ones are more alike and less varied.
  double block = 0.5, longBlock = 0.9;
  /// How far around a block it is compared with others, of the example's; no further than what a
  /// block leaves of it.
  double overlap = 0.125;
  /// A block is drawn among those that cost at most this much more than the cheapest, as a share.
  double slack = 0.1;
  double use = 0.3;      ///< price of a source used once more than its share, in voxels; >= 0
  double variety = 0.5;  ///< price of an offset that all of the result has, in voxels; >= 0
  /// `variety` rises until a result of the example's own size is as new as this; 0..1.
  double novelty = kNovelty;
  /// Moves joints to where both sides agree best, before that distance is taken; or nothing.
  std::function<void(PyramidSources&, const Progress&)> cut;
  /// How far from its proportional place along an axis a block may come from, samples; negative:
  /// any distance.
  Vec3i window{-1, -1, -1};
  /// The steps after which the example nearly repeats, samples of the level. Blocks stay aligned:
  /// their offsets are such steps, and they are whole numbers of periods long where those lie along
  /// an axis.
  Repetition repetition;
};

/// A level's start: large blocks of one part of the example (Efros, Freeman: "Image quilting for
/// texture synthesis and transfer", SIGGRAPH 2001, doi:10.1145/383259.383296, section 2, in three
/// dimensions, at a coarse level). Blocks lie in a running bond, rows at random phases, so that no
/// two joints line up. One after another each is taken from where it agrees best with those placed
/// before and with the frame of air around the level, plus a price for how often that part of the
/// example and that offset were used already. So every part gets its turn, and a result of the
/// example's own size is no copy of it. Joints are straight still: `refineSeams` finds better ones.
///
/// The level has a single part of which all is usable. Along periodic axes, along which the
/// repetition must have a period, blocks meet those at the other side. O(blocks x places x 4096);
/// the same bytes at any number of threads. Throws `Cancelled`.
PyramidSources quilt(const PyramidLevel& level, const QuiltOptions& options,
                     const Progress& progress = {});

/// 1 - IoU between the solid of a target (with or without frame) and the level's source, in place
/// or moved by up to `reach` samples along each axis, whichever is least; 1 where sizes differ.
double distanceToSource(const PyramidLevel& level, const PyramidSources& sources, int reach);

}  // namespace exemplar
