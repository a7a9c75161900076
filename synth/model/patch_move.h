// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/cells.h"
#include "synth/model/patch_sources.h"
#include "synth/model/problem.h"

namespace exemplar {

/// A piece of an example put into a consistent labeling so that it stays consistent, found without
/// search: the smallest set of cells that holds a core, and across whose border every label of the
/// example may stand beside the label in place.
///
/// Putting in a source at one alignment is a binary choice for each cell, the label in place or the
/// source's. Both labelings are consistent, so a pair of neighbors is at fault only where the choice
/// changes between them: the hard constraints of an expansion move (Boykov, Veksler, Zabih: "Fast
/// approximate energy minimization via graph cuts", PAMI 23(11), 2001; for shifts of an example:
/// Pritch, Kav-Venaki, Peleg, "Shift-map image editing", ICCV 2009) are implications, "if this cell
/// takes the source's label, so does its neighbor". What follows from the core is their least
/// solution. An object whose cells cannot stand beside air comes, or goes, as a whole.
///
/// Deterministic. One thread at a time; memory is that of the window.
class PatchMove {
 public:
  /// Where cells may change: the columns up to `reach` from `center`, at all heights and frames.
  struct Window {
    Vec3i center;
    int frame = 0;
    int reach = 8;  ///< cells, >= 1; along periodic axes at most (size - 1) / 2
  };
  /// The source's cell that comes to the window's center.
  struct Alignment {
    int source = 0;
    Vec3i cell;
    int frame = 0;
  };
  struct Member {
    std::int32_t cell;  ///< of the network
    Label label;        ///< the source's
    Vec3i step;         ///< from the window's center
    int frameStep;
  };

  /// `base` holds the labels that the request leaves each cell. All must outlive the move.
  PatchMove(const ModelProblem& problem, const LabelSets& base,
            std::span<const PatchSource> sources);

  /// Finds the set for the cells of `core` (steps from the center) that the grid and the source
  /// have. False where it leaves the window or the source, needs a label that the request forbids,
  /// or changes more than `most` cells or none. O(cells of the set × slots).
  bool close(const Window& window, const Alignment& alignment, const CellBox& core,
             const CellBox& grown, std::span<const Label> labels, int most);

  /// The set; some of its cells may have the source's label already.
  std::span<const Member> members() const { return members_; }
  std::span<const Member> conflicts() const { return conflicts_; }

 private:
  enum class Added { Yes, No, Impossible };
  Added add(std::int32_t cell, const Vec3i& step, int frameStep);
  std::size_t local(const Vec3i& step, int frameStep) const;
  bool follow(std::size_t member);
  bool reach(std::int32_t to, int relation, Label label, const Vec3i& step, int frameStep);

  const ModelProblem& problem_;
  const LabelNetwork& network_;
  const LabelSets& base_;
  std::span<const PatchSource> sources_;
  bool images_;  // whether cells stand for several positions
  Window window_;
  Alignment alignment_;
  std::span<const Label> labels_;
  int changed_ = 0, most_ = 0;
  CellBox grown_;
  std::vector<Member> members_, conflicts_;
  std::vector<std::uint32_t> member_;  // of each place in the window: stamp and number
  std::vector<std::uint32_t> stamp_;
  std::uint32_t now_ = 0;
};

}  // namespace exemplar
