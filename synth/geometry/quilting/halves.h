// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>

#include "core/axes.h"
#include "core/figure_constants.h"
#include "core/progress.h"
#include "synth/geometry/pyramid/pyramid.h"
#include "synth/geometry/quilting/quilt.h"

namespace exemplar {

struct HalvesOptions {
  std::uint64_t seed = 0;
  /// Only halves along these axes are exchanged.
  Axes stationary = Axes::every();
  /// Side of the windows of the example that should stay whole, samples, >= 2: those by which
  /// likeness is measured.
  int window = kLikenessWindow;
  /// The larger part is divided across another axis, and its parts exchanged, too, where there is
  /// one: no part is then more than about two fifths of the result, and no cyclic move of the
  /// example explains more than one of them. Costs two thirds of a joint more.
  bool divide = false;
  double novelty = kNovelty;  ///< plans are tried until one is as new as this; 0..1
  /// Moves joints to where both sides agree best, before that distance is taken; or nothing.
  std::function<void(PyramidSources&, const Progress&)> cut;
};

/// A start of the example's own size with a single joint: the example cut in two across an axis,
/// and its halves exchanged. So each part is in it once, and nearly all of it whole. What ends the
/// example now meets in the middle, overlapping by a window less a sample or a little more, where
/// both sides fit better; that costs no part, for both halves extend as far beyond the place where
/// they were cut.
///
/// Of ground (solid all over its lowest layer, air all over its highest) the halves are lifted or
/// lowered so that they meet at one height, as far as the box has room.
///
/// Seeds that follow each other take turns in axes and cut far from each other's places; axes
/// across which halves would fit much worse are passed over. What is not new enough is cut nearer
/// to the middle, and then across two axes; the farthest is taken.
///
/// Axes count along which the example's box cuts through it on both sides, and that are four
/// windows long. Empty where no axis is such, or where sizes differ. The level has a single part,
/// all of it usable, and no axis is periodic. O(samples) besides `cut`; the same bytes at any
/// number of threads. Throws `Cancelled`.
PyramidSources exchangedHalves(const PyramidLevel& level, const HalvesOptions& options,
                               const Progress& progress = {});

}  // namespace exemplar
