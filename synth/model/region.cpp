// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/region.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>

#include "synth/model/exact.h"
#include "synth/model/search.h"

namespace exemplar {

Region::Region(const LabelNetwork& network, const LabelSets& base)
    : network_(network), base_(base), part_(network) {
  placed_ = [this](int cell) -> int {
    const int i = part_.local(cell);
    if (i >= 0) return deciding_ && catalog_->decided(i) ? catalog_->firstLabel(i) : -1;
    if (!around_) return labels_[cell];
    return around_->decided(cell) ? around_->firstLabel(cell) : -1;
  };
}

bool Region::takeBack(std::span<const std::int32_t> cells, std::span<const Label> labels,
                      const Progress& progress) {
  labels_ = labels;
  around_ = nullptr;
  part_.select(cells);
  order_.resize(cells.size());
  std::iota(order_.begin(), order_.end(), 0);
  return begin([&](int i, std::span<LabelWord> set) { part_.restrictByLabels(i, set, labels); },
               progress);
}

bool Region::takeBack(std::span<const std::int32_t> cells, std::span<const std::int32_t> ahead,
                      const Catalog& around, const Progress& progress) {
  labels_ = {};
  around_ = &around;
  merged_.clear();
  std::merge(cells.begin(), cells.end(), ahead.begin(), ahead.end(), std::back_inserter(merged_));
  part_.select(merged_);
  order_.clear();
  for (const std::int32_t c : cells) order_.push_back(part_.local(c));
  const auto setOf = [&](int far) { return around.domain(far); };
  return begin([&](int i, std::span<LabelWord> set) { part_.restrictByOutside(i, set, setOf); },
               progress);
}

/// Finds out which labels are possible; `restrict(i, set)` takes away what has no support around.
template <class Restrict>
bool Region::begin(const Restrict& restrict, const Progress& progress) {
  deciding_ = spoiled_ = false;
  catalog_.emplace(part_.network());
  sets_ = LabelSets(network_.labels, static_cast<std::size_t>(count()));
  for (int i = 0; i < count(); ++i) {
    const auto all = base_[cells()[i]];
    std::copy(all.begin(), all.end(), sets_[i].begin());
    restrict(i, sets_[i]);
    if (labelsIn(sets_[i]) == 0) return false;
    catalog_->setDomain(i, sets_[i]);
  }
  if (!catalog_->propagateAll(progress)) return false;
  rememberSets();
  return true;
}

void Region::rememberSets() {
  for (int i = 0; i < count(); ++i) {
    const auto left = catalog_->domain(i);
    std::copy(left.begin(), left.end(), sets_[i].begin());
  }
}

void Region::restore() {
  if (spoiled_) {
    for (int i = 0; i < count(); ++i) catalog_->setDomain(i, sets_[i]);
  }
  deciding_ = spoiled_ = false;
}

bool Region::demand(std::span<const std::int32_t> which, std::span<const LabelWord> labels) {
  restore();
  catalog_->mark();
  bool sound = true;
  for (std::size_t n = 0; n < which.size() && sound; ++n) {
    sound = catalog_->restrict(which[n], labels);
  }
  if (!sound || !catalog_->propagate()) {
    catalog_->undoTo(0);
    return false;
  }
  catalog_->commit();
  rememberSets();
  return true;
}

bool Region::accept(const RegionChoice& choice) {
  for (const std::int32_t i : order_) found_[i] = static_cast<Label>(catalog_->firstLabel(i));
  return !choice.fits || choice.fits();
}

Outcome Region::relabel(const RegionEffort& effort, const RegionChoice& choice,
                        const Progress& progress) {
  found_.resize(static_cast<std::size_t>(count()));
  std::uint64_t attempt = 0;
  const auto chooseFrom = [&](const Random& random) -> ChooseLabel {
    return [&choice, random, this](int i, std::span<const LabelWord> labels, int draw) {
      return choice.choose(random, cells()[i], labels, draw);
    };
  };
  for (int pass = 0; pass < effort.passes; ++pass) {
    const Random random = choice.random.fork(attempt++);
    restore();
    deciding_ = spoiled_ = true;
    if (!labelInOrder(*catalog_, order_, chooseFrom(random), counts_.contradictions, progress)) {
      ++counts_.contradictions;
      continue;
    }
    if (accept(choice)) return Outcome::Complete;
  }
  for (int search = 0; search < effort.searches; ++search) {
    const Random random = choice.random.fork(attempt++);
    restore();
    deciding_ = spoiled_ = true;
    const Outcome outcome =
        searchLabels(*catalog_, order_, chooseFrom(random), effort.searchConflicts, progress);
    if (outcome == Outcome::Impossible) return outcome;
    if (outcome == Outcome::Complete && accept(choice)) return outcome;
  }
  if (effort.exactConflicts == 0) return Outcome::Unfinished;
  return solveExactly(effort, choice, choice.random.fork(attempt), progress);
}

Outcome Region::solveExactly(const RegionEffort& effort, const RegionChoice& choice,
                             const Random& random, const Progress& progress) {
  restore();
  ++counts_.exact;
  ExactSolver exact(part_.network(), sets_, progress);
  for (int i = 0; i < count(); ++i) {
    const int cell = cells()[i];
    exact.prefer(i, choice.prefer ? choice.prefer(cell, sets_[i])
                                  : choice.choose(random, cell, sets_[i], 0));
  }
  const Outcome outcome = exact.solve({}, effort.exactConflicts, progress);
  if (outcome != Outcome::Complete) return outcome;
  for (int i = 0; i < count(); ++i) found_[i] = static_cast<Label>(exact.label(i));
  return !choice.fits || choice.fits() ? Outcome::Complete : Outcome::Unfinished;
}

void Region::keep(std::span<Label> labels) {
  assert(order_.size() == found_.size());
  before_.resize(found_.size());
  for (int i = 0; i < count(); ++i) {
    before_[i] = labels[cells()[i]];
    labels[cells()[i]] = found_[i];
  }
}

void Region::undo(std::span<Label> labels) const {
  for (int i = 0; i < count(); ++i) labels[cells()[i]] = before_[i];
}

bool Region::keep(Catalog& sets, int last) const {
  sets.mark();
  std::vector<LabelWord> one(static_cast<std::size_t>(network_.words()));
  for (int i = 0; i < count(); ++i) {
    const int cell = cells()[i];
    if (cell > last) {
      sets.setDomain(cell, base_[cell]);
      continue;
    }
    std::fill(one.begin(), one.end(), 0);
    addLabel(one, found_[i]);
    sets.setDomain(cell, one);
  }
  for (const std::int32_t cell : cells()) {
    sets.touch(cell);
    network_.forEachNeighbor(cell, [&](int n, int) { sets.touch(n); });
  }
  if (!sets.propagate()) {
    sets.undoTo(0);
    return false;
  }
  sets.commit();
  return true;
}

}  // namespace exemplar
