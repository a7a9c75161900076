// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/model/network.h"

namespace exemplar {

/// The catalog C of possible assignments (thesis, section 3.3.2): for each cell of a network the
/// set of labels that it may still take, kept arc consistent: a label stays only while each
/// neighbor has a label that supports it (statement 3.6).
///
/// Sets are bits; a cell's set is propagated as the union of its labels' support rows, which ends
/// early where a neighbor loses nothing. So it finds the fixed point of AC-4 without counters, in a
/// bit a cell and label.
///
/// Changes can be taken back: `mark` and `undoTo`. With `keepReasons` each cell also knows which of
/// the decisions made so far have had a part in what its set has lost, so that a search can jump
/// back to one that matters (Prosser, "Hybrid algorithms for the constraint satisfaction problem",
/// Computational Intelligence 9(3), 1993). The network must outlive the catalog.
class Catalog {
 public:
  /// All sets empty: `setDomain` for each cell, then `propagateAll`.
  explicit Catalog(const LabelNetwork& network);
  /// All sets empty again, after the network's cells have changed (its tables must be the same):
  /// quicker than a new one.
  void restart();

  const LabelNetwork& network() const { return *network_; }
  std::span<const LabelWord> domain(int cell) const {
    return {domains_.data() + static_cast<std::size_t>(cell) * words_,
            static_cast<std::size_t>(words_)};
  }
  bool empty(int cell) const;
  /// Whether exactly one label is left.
  bool decided(int cell) const;
  /// The smallest label left; there must be one.
  int firstLabel(int cell) const;

  /// Replaces a cell's set, without propagating: `touch` it and its neighbors.
  void setDomain(int cell, std::span<const LabelWord> labels);
  /// Has the next `propagate` take from a cell's neighbors what it does not support.
  void touch(int cell) { push(cell, kNoSlot); }
  /// Touches every cell and propagates. Throws `Cancelled`, as `propagate` does.
  bool propagateAll(const Progress& progress = {});

  /// Keeps only the labels that are in `labels`; false where none is left.
  bool restrict(int cell, std::span<const LabelWord> labels);
  bool assign(int cell, int label);
  bool remove(int cell, int label);
  /// Restores arc consistency; false where a cell has lost its last label: `contradiction` names
  /// it, and sets that were on the way are as propagation left them: undo, or set them again.
  bool propagate(const Progress& progress = {});
  int contradiction() const { return contradiction_; }

  /// A point to come back to. Nothing is kept before the first mark.
  int mark();
  void undoTo(int mark);
  /// Forgets all marks, and with them the way back.
  void commit();

  /// From now on remembers reasons: sets of up to `decisions` numbers.
  void keepReasons(int decisions);
  int reasonWords() const { return reasonWords_; }
  std::span<std::uint64_t> reason(int cell) {
    return {reasons_.data() + static_cast<std::size_t>(cell) * reasonWords_,
            static_cast<std::size_t>(reasonWords_)};
  }
  /// The cell whose set emptied the contradiction's, or the same cell.
  int contradictionFrom() const { return contradictionFrom_; }

  /// Sets propagated to neighbors so far: a measure of work.
  std::int64_t steps() const { return steps_; }

 private:
  static constexpr std::uint8_t kNoSlot = 255, kIdle = 254;
  static constexpr std::size_t kRemembered = 64;

  void push(int cell, std::uint8_t from);
  void growQueue();
  void save(int cell);
  void forgetQueue();
  template <int W>
  bool run(const Progress& progress);
  template <int W>
  bool update(int cell, int from, const LabelWord* set, const LabelWord* table, int slot);
  /// What a set supports along each slot, from the sets met before where it is one of these.
  const LabelWord* rememberedSupport(const LabelWord* set);
  std::size_t rememberedWords() const {
    return static_cast<std::size_t>(words_) * (1 + static_cast<std::size_t>(network_->slots));
  }
  bool holdsOnly(int cell, const LabelWord* set) const;

  const LabelNetwork* network_;
  int words_;
  std::vector<LabelWord> domains_;   // one set more than cells: the empty one of no cell
  std::vector<std::int32_t> queue_;  // a ring
  std::size_t head_ = 0, waiting_ = 0, ringMask_ = 0;
  std::vector<std::uint8_t> queuedFrom_;  // kIdle, or the slot towards the one cell it changed for
  std::vector<const LabelWord*> tables_;
  std::vector<LabelWord> supported_;  // scratch
  // While all cells are propagated many hold the same few sets: by hash, a set and what it
  // supports.
  bool all_ = false;
  std::vector<LabelWord> remembered_;

  struct Saved {
    std::int32_t cell;
    std::int32_t stampBefore;
  };
  std::vector<Saved> trail_;
  std::vector<LabelWord> trailWords_;
  std::vector<std::int32_t> savedAt_;  // per cell: the mark for which its set is on the trail
  struct Mark {
    std::size_t trail;
    std::int32_t stamp;
  };
  std::vector<Mark> marks_;
  std::int32_t lastStamp_ = 0;

  int reasonWords_ = 0;
  std::vector<std::uint64_t> reasons_, trailReasons_;
  int contradiction_ = -1, contradictionFrom_ = -1;
  std::int64_t steps_ = 0;
};

}  // namespace exemplar
