// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "measure/occupancy.h"

namespace exemplar {

struct LandmarkOptions {
  /// How many windows of the example are asked whether they are landmarks, at random, and how many
  /// landmarks are looked for at most; >= 1.
  int candidates = 160, landmarks = 40;
  std::uint64_t seed = 0;
};

/// How often a result shows what its example has only once: a tower, a chimney, the one crack in a
/// wall.
///
/// A landmark is a window of 11³ cells at the example's surface that no other place of the example
/// looks like: an IoU of their solids (or their air, where that is less) of `kLandmarkAlike` or
/// more, further off than half a window. It occurs in a result where that looks like it as much;
/// occurrences within half a window of a better one are the same one. Volumes are halved until the
/// example is at most 72 cells long, so that a landmark is about a sixth of it or more.
struct Landmarks {
  std::vector<int> occurrences;  ///< of each landmark, in the result
  /// Their number in a result of this size that is no reason for doubt: one, or two where the
  /// result has at least one and a half times as many cells.
  int allowed = 1;

  bool any() const { return !occurrences.empty(); }
  int most() const;         ///< occurrences of the commonest; 0 where there is no landmark
  double mean() const;      ///< occurrences
  double repeated() const;  ///< the share of landmarks that occur more often than is allowed, 0..1
};

inline constexpr double kLandmarkAlike = 0.7;

/// Without a landmark where the example is thinner than a window, or is alike everywhere. O(cells x
/// landmarks), in parallel; the same at any number of threads. Throws `Cancelled`.
Landmarks countLandmarks(const Occupancy& example, const Occupancy& result,
                         const LandmarkOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
