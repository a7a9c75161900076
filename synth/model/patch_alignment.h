// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/random.h"
#include "synth/model/block_counts.h"
#include "synth/model/patch_move.h"

namespace exemplar {

/// The random numbers of one move, one after the other.
class Draws {
 public:
  Draws(const Random& random, std::uint64_t move) : random_(&random), move_(move) {}
  /// 0..n-1, for n >= 1.
  int below(int n) {
    return static_cast<int>(random_->below(static_cast<std::uint32_t>(n), move_, draw_++));
  }
  int between(int least, int most) { return least + below(most - least + 1); }
  /// [0, 1).
  double uniform() { return random_->uniform(move_, draw_++); }

 private:
  const Random* random_;
  std::uint64_t move_;
  std::uint32_t draw_ = 0;
};

/// Finds places of an example that go on from what is in place: of some candidates the one that
/// agrees with most of the cells up to two columns around a core, and differs in the core. Half of
/// the candidates are anywhere in the example (beside a side of the result with a rule: as far
/// from the example's); the others have a block of 3 cells a side in common at the core's border,
/// a rare one if that can be had. O(candidates x cells around the core).
class PatchAlignments {
 public:
  /// All must outlive this. Without `counts` nothing is found by blocks.
  PatchAlignments(const ModelProblem& problem, std::span<const PatchSource> sources,
                  const BlockCounts* counts = nullptr);

  /// `grid` has the label of each position. None where all candidates are what is there, or none
  /// agrees with more than the share `least` of the cells around.
  std::optional<PatchMove::Alignment> find(Draws& draws, const PatchMove::Window& window,
                                           const CellBox& core, std::span<const Label> grid,
                                           double least) const;
  /// The share of the cells around a core that agree, 0..1; less than 0 where the core does, too.
  double agreement(const PatchMove::Window& window, const PatchMove::Alignment& alignment,
                   const CellBox& core, std::span<const Label> grid) const;

 private:
  PatchMove::Alignment anywhere(Draws& draws, const PatchMove::Window& window) const;
  std::optional<PatchMove::Alignment> byBlock(Draws& draws, const PatchMove::Window& window,
                                              const CellBox& core) const;
  bool within(Vec3i& p) const;

  const ModelProblem& problem_;
  std::span<const PatchSource> sources_;
  const BlockCounts* counts_;
};

}  // namespace exemplar
