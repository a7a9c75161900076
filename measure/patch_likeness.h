// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/figure_constants.h"
#include "core/progress.h"
#include "measure/occupancy.h"

namespace exemplar {

/// Which windows of a volume count.
enum class WindowBorder {
  /// Those whose center lies in the box; what they show of its outside is empty. As published.
  Padded,
  /// Those that lie wholly inside: a padded window leaning over a face of the box earns credit for
  /// the cut, which any two boxes of the same material share.
  Interior,
};

struct PatchLikenessOptions {
  WindowBorder border = WindowBorder::Padded;
  /// The step between the reference's windows: 1 (dense) or 5 (as published); cells, >= 1.
  int referenceStride = 1;
  /// The IoU that the best match of a window has to exceed; 0..1.
  double threshold = kLikenessThreshold;
  /// How many of the asked volume's windows are drawn, at random and without repetition; >= 1.
  int windows = 1000;
  /// How many of them (the first drawn) are followed to their very best match for `meanIou`, which
  /// distinguishes results that a threshold does not; of the others it is enough to know whether
  /// the best exceeds it. >= 0.
  int averaged = 250;
  std::uint64_t seed = 0;
};

/// What became of the windows of one volume among those of another.
struct PatchLikeness {
  double share = 0;          ///< of the windows, those whose best IoU exceeds the threshold; 0..1
  double meanIou = 0;        ///< the mean of the best IoU, without a threshold's jumps; 0..1
  std::int64_t windows = 0;  ///< how many were drawn
  std::int64_t references = 0;  ///< how many windows each was compared with
};

/// The share of the *surface windows* of `asked` that `reference` has too: blocks of 11³ cells
/// whose central 3³ cells are partly solid, partly empty, taken from `asked` at a stride of 5 cells
/// (of 1 where none falls on that lattice), and compared by intersection over union of their solid
/// cells.
///
/// With the result as `asked` and the example as `reference` this is LP, how much of the result is
/// as in the example: *LP-published* (Wu, Zheng: "Learning to generate 3D shapes from a single
/// example", ACM Transactions on Graphics 41(6), 2022, doi:10.1145/3550454.3555480, and its
/// program's evaluation) at reference stride 5, *LP-dense* at stride 1. With the roles swapped it
/// is *coverage*, how much of the example is in the result; the two together are a bidirectional
/// similarity (Rosenberger, Cohen-Or, Lischinski: "Layered shape synthesis", ACM Transactions on
/// Graphics 28(5), 2009, section 3.1).
///
/// A dense reference has a guard ring: its padded windows reach one cell further out than those of
/// `asked`, which is as far as a window's core can touch the box. So a copy of the example moved
/// anywhere within empty surroundings scores 1; at stride 5 the same copy scores little.
///
/// Without windows: where `asked` has no surface window its share is 1 if `reference` has
/// none either and 0 otherwise (an empty result is not alike); where only `reference` has none, 0.
///
/// Exact. A pair is passed over when its bound, from counts of solid cells in the window and in 27
/// parts of it, cannot beat the window's best so far. About 0.2 s a million reference windows on
/// two cores; the same bytes at any number of threads. Throws `Cancelled`.
PatchLikeness patchLikeness(const Occupancy& asked, const Occupancy& reference,
                            const PatchLikenessOptions& options = {},
                            const Progress& progress = {});

/// Whether a volume of this size has room for windows wholly inside it.
bool hasInteriorWindows(const Vec3i& size);

}  // namespace exemplar
