// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/outcome.h"
#include "core/progress.h"
#include "core/random.h"
#include "synth/model/catalog.h"
#include "synth/model/network.h"

namespace exemplar {

/// How hard a region is worked on. The ways are tried in this order until one succeeds; each
/// attempt starts again from the same sets, with its own random numbers.
struct RegionEffort {
  int passes = 1;    ///< in order, each label that fails taken away (`labelInOrder`)
  int searches = 1;  ///< with conflict-directed backjumping (`searchLabels`)
  std::int64_t searchConflicts = 100;  ///< in one search, >= 0
  std::int64_t exactConflicts = 5000;  ///< of the exact solver, >= 0; 0: it is not asked
  std::int64_t exactSteps = kNoLimit;  ///< `ExactSolver::steps`, >= 0
  /// What all attempts may take together (`Region::Counts::work`), >= 0: what would take more is
  /// not begun, or left.
  std::int64_t work = kNoLimit;

  static constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
};

/// How the cells of a region get their labels. `cell` is a cell of the whole network.
struct RegionChoice {
  using Choose = std::function<int(const Random& random, int cell,
                                   std::span<const LabelWord> labels, int draw)>;
  using Prefer = std::function<int(int cell, std::span<const LabelWord> labels)>;

  Random random;  ///< attempt number n of one `relabel` draws from fork n of these
  Choose choose;  ///< picks one of `labels`; `draw` is new at each call of an attempt
  Prefer prefer;  ///< what the exact solver tries first; empty: what `choose` picks
  /// Whether a labeling that was found will do; if not, the next way is tried. Empty: any will.
  std::function<bool()> fits;
};

/// Some cells of a labeled network, taken back and relabeled within what surrounds them: the
/// move with which contradictions are repaired (`labelWhole`), blocks modified (`labelInBlocks`;
/// thesis, Algorithm 3.4) and limits met (`meetLimits`).
///
///     Region region(network, base);
///     if (!region.takeBack(cells, labels)) return;      // nothing fits there
///     if (!region.demand(which, wanted)) return;        // put something in, or keep it out
///     if (region.relabel({}, choice) != Outcome::Complete) return;
///     region.keep(labels);                              // or do not: `labels` is as it was
///     if (worse(labels)) region.undo(labels);
///
/// Taking back cells asks which labels are possible: those of `base` that have support around the
/// region and, by propagation, within it. Nothing outside changes, so what was consistent with
/// `base` stays so. An example's piece is put in by a demand on each of its cells, and the cells
/// between it and the border of the region close the gap, or it is shown that they cannot.
///
/// Cost: `takeBack` is O(cells × slots) and one propagation of the region; a region holds 4 bytes
/// for each cell of the whole network and the network's support tables, so make one and use it
/// often. Deterministic. Threads may work on regions of one labeling at the same time, each with a
/// `Region` of its own, if no cell of one is a cell of another, a neighbor of one in the network,
/// or looked at by its `choose`: they read `labels` around their cells and write their own cells
/// only.
class Region {
 public:
  /// `base` holds the labels that the request leaves each cell, arc consistent unless the region
  /// will be the whole network. Both must outlive the region.
  Region(const LabelNetwork& network, const LabelSets& base);
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;

  /// Takes back `cells` (of the network, ascending) of a labeling, `labels`, one for each cell of
  /// the network, which must outlive the work on these cells. False where nothing can be there.
  /// Throws `Cancelled`, as all that takes a `Progress` here.
  bool takeBack(std::span<const std::int32_t> cells, std::span<const Label> labels,
                const Progress& progress = {});
  /// The same where not every cell around has a label: `around` holds the sets of those. The cells
  /// `ahead` (ascending, none of `cells`) are looked at too: they get no label, but must keep one.
  bool takeBack(std::span<const std::int32_t> cells, std::span<const std::int32_t> ahead,
                const Catalog& around, const Progress& progress = {});

  /// The cells taken back and those ahead, ascending.
  std::span<const std::int32_t> cells() const { return part_.cells(); }
  int count() const { return part_.network().cells; }
  /// The labels possible at the i-th of these cells, before any is labeled.
  std::span<const LabelWord> possible(int i) const { return sets_[i]; }

  /// Keeps only `labels` at the cells with the numbers `which` in `cells()`. False, and everything
  /// as it was, where then nothing can be there.
  bool demand(std::span<const std::int32_t> which, std::span<const LabelWord> labels);

  /// Labels the cells: Complete; Impossible where that is proved; else Unfinished.
  Outcome relabel(const RegionEffort& effort, const RegionChoice& choice,
                  const Progress& progress = {});
  /// After Complete, and while `RegionChoice::fits` is asked: the label found for cell number i.
  Label label(int i) const { return found_[i]; }
  /// The label in place at a cell of the network, or -1: what surrounds the region, and what
  /// the attempt under way has decided within it.
  const std::function<int(int cell)>& placed() const { return placed_; }

  /// Puts the labels found in place, in the labeling that the cells were taken from or a copy of
  /// it; `undo` brings back the ones that were there.
  void keep(std::span<Label> labels);
  void undo(std::span<Label> labels) const;
  /// Puts them in place up to cell `last` of the network, and sets the other cells of the region
  /// free. False, and `sets` as it was, where propagation from there empties a set.
  bool keep(Catalog& sets, int last) const;

  /// What all of that took since the region was made.
  struct Counts {
    std::int64_t contradictions = 0;  ///< cells that passes in order left without a label
    std::int64_t exact = 0;           ///< calls of the exact solver
    /// In sets propagated to neighbors (`Catalog::steps`), some 0.1 microseconds each, what the
    /// exact solver does converted to these: the same on every machine.
    std::int64_t work = 0;
  };
  const Counts& counts() const { return counts_; }

 private:
  template <class Restrict>
  bool begin(const Restrict& restrict, const Progress& progress);
  void restore();
  void rememberSets();
  Outcome solveExactly(const RegionEffort& effort, const RegionChoice& choice, const Random& random,
                       const Progress& progress);
  bool accept(const RegionChoice& choice);
  void countSteps();

  const LabelNetwork& network_;
  const LabelSets& base_;
  NetworkPart part_;
  std::span<const Label> labels_;    // around the region; or else
  const Catalog* around_ = nullptr;  // the sets there
  std::vector<std::int32_t> merged_, order_;
  std::optional<Catalog> catalog_;
  LabelSets sets_;         // arc consistent; where each attempt begins
  bool spoiled_ = false;   // whether the catalog holds anything else
  bool deciding_ = false;  // whether its decisions are the attempt's
  std::vector<Label> found_, before_;
  std::function<int(int)> placed_;
  Counts counts_;
  std::int64_t stepsCounted_ = 0;  // of the catalog's
};

}  // namespace exemplar
