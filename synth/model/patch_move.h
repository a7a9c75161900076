// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "synth/model/choose.h"
#include "synth/model/patch_sources.h"
#include "synth/model/problem.h"
#include "synth/model/region.h"

namespace exemplar {

/// A patch of an example put into a consistent labeling so that it stays consistent.
///
/// At one alignment of example and result each cell has two candidates, the label in place and the
/// example's. Both labelings are consistent, so a pair of neighbors is at fault only where the
/// choice changes between them: the hard constraints of an expansion move (Boykov, Veksler, Zabih:
/// "Fast approximate energy minimization via graph cuts", PAMI 23(11), 2001; for shifts of an
/// example: Pritch, Kav-Venaki, Peleg, "Shift-map image editing", ICCV 2009) are implications, "if
/// this cell takes the example's label, so must its neighbor". From the core of the patch they are
/// followed to the border of a box; an object whose cells air cannot border on comes, or goes, as
/// a whole. Mostly nothing is at fault then, and nothing had to be searched. What is, is a
/// conflict: the cells around it are a `Region`, set free and labeled by search, the label in place
/// first, then the example's. Where that does not succeed nothing changes.
///
/// Deterministic. One thread at a time; threads may make moves in one labeling at once where their
/// windows are further apart than the network's neighbors. Memory: a region and the window.
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
  /// All in steps from the center.
  struct Patch {
    CellBox core;   ///< takes the source's labels where there are any
    CellBox grown;  ///< how far implications are followed; within the window, and holds the core
    int rim = 1;    ///< how far around a conflict cells are set free at first, >= 0
    int widestRim = 0;       ///< and at most, where a narrower rim cannot be closed
    int mostConflicts = 60;  ///< more are not worked on
    int mostChanged = 2000;  ///< cells; more is not one patch
    int mostInRim = 1000;    ///< cells
    /// Wrong choices in the search for the rims' labels: those found at all are found soon.
    int rimConflicts = 20;
    int mostImplied = 2000;  ///< cells beyond the core that implications may come to
  };
  struct Before {
    std::int32_t cell;
    Label label;
  };

  /// `base` holds the labels that the request leaves each cell. All must outlive the move.
  PatchMove(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
            std::span<const PatchSource> sources);

  enum class Outcome {
    Made,      ///< `labels` is changed, and consistent
    Nothing,   ///< nothing would change, or too much
    Conflict,  ///< it cannot be put in, or not found out how
  };
  /// Puts a patch in. `before` has what the cells that change held, in the order in which they
  /// did; a cell may change twice.
  Outcome make(const Window& window, const Alignment& alignment, const Patch& patch,
               const Random& random, std::span<Label> labels, std::vector<Before>& before,
               const std::function<bool()>& worth, const Progress& progress = {});
  /// What closing rims has taken since the object was made, as `Region::Counts::work`.
  std::int64_t work() const { return region_.counts().work; }

 private:
  struct Member {
    std::int32_t cell;
    Label label;  // the source's
    Vec3i step;   // from the center
    int frameStep;
  };
  /// The neighbor along a slot, and what a cell of each label allows there.
  struct Step {
    Vec3i by;
    int frames;
    const LabelWord* support;
  };

  struct Conflict {
    Vec3i step;
    int frameStep;
    std::uint32_t group;
  };

  void add(std::int32_t cell, const Vec3i& step, int frameStep);
  std::size_t local(const Vec3i& step, int frameStep) const;
  bool inGrown(const Vec3i& step) const;
  bool tooMuch() const {
    return changed_ > patch_.mostChanged || implied_ > patch_.mostImplied ||
           static_cast<int>(conflicts_.size()) > patch_.mostConflicts;
  }
  void stepTo(std::int32_t cell, Vec3i& step, int& frameStep) const;
  void follow(const Member& member);
  void across(std::int32_t to, int relation, Label label, const Vec3i& step, int frameStep);
  void beginMembers();
  void addCore();
  bool addSoundCore();
  void findMembers();
  void groupConflicts();
  void findRim(std::span<const Conflict> conflicts, int rim);
  bool closeRims(const Random& random, std::vector<Before>& before, const Progress& progress);
  bool closeRim(const Random& random, std::vector<Before>& before, const Progress& progress);
  Label sourceLabel(const Vec3i& step, int frameStep) const;

  const ModelProblem& problem_;
  const LabelNetwork& network_;
  const LabelSets& base_;
  const LabelChooser& chooser_;
  std::span<const PatchSource> sources_;
  Region region_;
  bool images_;  // whether cells stand for several positions
  int words_;
  std::vector<const LabelWord*> support_;  // of each relation
  std::vector<Step> steps_;                // along each slot
  Vec3i furthest_;                         // along each axis
  bool numbered_;                          // whether cells are numbered as positions are

  Window window_;
  Alignment alignment_;
  Patch patch_;
  std::span<Label> labels_;
  int changed_ = 0, implied_ = 0;
  CellBox sound_;                 // of the core, takes the source's labels whole; empty: not so
  std::vector<Before> fromCore_;  // the cells of that which change, and the source's labels
  std::vector<Member> border_, members_;  // of that those near its border; the others
  std::vector<Conflict> conflicts_;
  std::vector<std::uint32_t> member_, stamp_;  // of each place in the window
  std::uint32_t now_ = 0;
  std::vector<std::uint64_t> marked_, heights_;
  std::vector<std::int32_t> rim_;
};

}  // namespace exemplar
