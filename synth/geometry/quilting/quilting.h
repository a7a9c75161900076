// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/axes.h"
#include "core/progress.h"
#include "synth/geometry/synthesize.h"

namespace exemplar {

struct QuiltingOptions {
  Vec3i size{0, 0, 0};  ///< of the result, samples; each component >= 1
  std::uint64_t seed = 0;
  /// 1..8; by default the coarsest has at most 40 samples along the longest side of the example,
  /// and results of the example's own size that are made of its halves have a single level.
  std::optional<int> levels;
  double truncation = 4;           ///< distances count up to here, in voxels of the level; > 0
  std::optional<Axes> stationary;  ///< found from the example by default
  /// Along which parts stay where they are, if the result is as long there as the example.
  Axes inPlace;
  /// Along which axes the result continues at its opposite side, so that copies of it tile space.
  /// Only what repeats can (`suitsQuilting`).
  Axes periodic;
  /// Of the patches that repair seams: samples a side, 3..15; along a thinner axis its whole
  /// thickness.
  int patch = 7;
  int rounds = 1;  ///< matches and votes of a repair, 1..100
};

/// Geometry synthesis from large pieces of one example, joined by minimum cuts: most of the result
/// is verbatim.
///
/// A result of the example's own size is the example cut in two and its halves exchanged, where an
/// axis allows it (`exchangedHalves`); that needs no coarser levels. Else the coarsest level starts
/// from large blocks of the example, each where it agrees best with those before, so that all parts
/// get their turn, and a result of the example's own size is no copy of it (`quilt`). On each level
/// the borders of the copied pieces move to where both sides agree best (`refineSeams`), and pieces
/// to where they line up (`alignPieces`). On the finest, where a border shows all the same,
/// overlapping patches are matched and vote on what belongs there (`repairSeams`).
///
/// At the end what has broken off is cleared away (`dropBrokenPieces`), and steps across borders
/// are evened out (`evenSeams`). So each sample has the sign of the example at its origin; its
/// value is the example's to the bit away from the borders of copied pieces, and nearly a distance
/// beside them.
///
/// Sides of the example's box that lie wholly outside the solid (a free-standing object with air
/// around it) stay outside in the result; elsewhere the result is a window into something larger.
///
/// Cost: about O(samples near seams) for each level's cuts, besides the start; memory about 120
/// bytes a sample of the result. The same bytes at any number of threads. Throws `InputError` for
/// options out of range and for a result that cannot be periodic, `Cancelled` when cancelled.
SynthesisResult synthesizeByQuilting(const DistanceField& example, const QuiltingOptions& options,
                                     const Progress& progress = {});

/// Whether large pieces will do: not for more of a ground that slopes, whose pieces would meet in
/// cliffs, nor for a periodic result of what does not repeat. `synthesizeByVoting` takes those.
/// O(samples), and for periodic results a search for the repetition on the coarsest level. Throws
/// `InputError` for options out of range.
bool suitsQuilting(const DistanceField& example, const QuiltingOptions& options);

}  // namespace exemplar
