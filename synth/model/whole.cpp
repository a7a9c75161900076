// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/whole.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <optional>

#include "synth/model/catalog.h"
#include "synth/model/region.h"
#include "synth/model/search.h"

namespace exemplar {
namespace {

/// How far a region reaches that is taken back, in cells: the first tries are small.
constexpr std::array<int, 7> kReach{2, 3, 4, 6, 9, 16, 24};
/// At last everything is taken back, unless that is more labels than the exact solver could hold.
constexpr int kEverywhere = 1 << 20;
constexpr std::int64_t kMostLabelsAtOnce = 2'000'000;
/// How far around it cells that are not labeled yet are looked at too.
constexpr int kMargin = 3;
/// Conflicts that the exact solver may meet in a region before a larger one, which is freer, is
/// tried: regions that are solved at all mostly are within a few thousand.
constexpr std::int64_t kRegionConflicts = 5000;
/// A search remembers for each cell which decisions mattered: for more cells than this the exact
/// solver, which learns from conflicts, is sooner done.
constexpr std::size_t kMostSearched = 4000;
constexpr std::int64_t kSearchConflicts = 300;
/// Blocks seldom make more than what they began with of a flat picture whose lines all go on:
/// there the whole is worth a second or two.
constexpr std::int64_t kCellsAtFirstFlat = 2'000'000;
/// What labeling a cell takes, and where it goes well at most, in steps of `Catalog::steps`; for
/// how many cells repairs may take as much at once; and the share of the cells labeled so far for
/// which they may, too.
constexpr std::int64_t kStepsPerCell = 5, kMostStepsPerCell = 10, kCellsAtFirst = 100'000,
                       kShare = 4;
/// So many repairs near each other in a row before the next one begins with a larger region.
constexpr int kRepairsInPlace = 3;

class WholePass {
 public:
  WholePass(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
            ModelStatistics& statistics, const Progress& progress, std::optional<int> patience,
            bool plain)
      : problem_(problem),
        network_(problem.network()),
        base_(base),
        chooser_(chooser),
        statistics_(statistics),
        progress_(progress),
        patience_(patience),
        plain_(plain),
        catalog_(network_) {
    for (int c = 0; c < network_.cells; ++c) catalog_.setDomain(c, base[c]);
  }

  Labeling run();

 private:
  /// What repairs may still take where `cell` is the next to be labeled.
  std::int64_t workLeft(int cell) const {
    if (!patience_) return RegionEffort::kNoLimit;
    const std::int64_t cells = cell;
    const std::int64_t atFirst = problem_.options().size.z == 1 ? kCellsAtFirstFlat : kCellsAtFirst;
    const std::int64_t beyond = catalog_.steps() - kMostStepsPerCell * cells;
    const std::int64_t spent =
        (region_ ? region_->counts().work : 0) + std::max<std::int64_t>(0, beyond);
    return *patience_ * kStepsPerCell * (atFirst + cell / kShare) - spent;
  }
  Outcome repair(int cell);
  Outcome repairWithin(int cell, int reach);

  const ModelProblem& problem_;
  const LabelNetwork& network_;
  const LabelSets& base_;
  const LabelChooser& chooser_;
  ModelStatistics& statistics_;
  const Progress& progress_;
  std::optional<int> patience_;
  bool plain_;
  Catalog catalog_;
  std::optional<Region> region_;  // made for the first repair
  std::uint64_t repairs_ = 0;
  int lastRepaired_ = -1, lastReach_ = 0, again_ = 0;
};

/// Relabels the cells within `reach` of one, in the whole catalog too. Of these and of cells
/// around them those after `cell` are not labeled yet: they are set free again. Complete;
/// Unfinished where that did not succeed; Impossible where the region was everything and it is
/// proved that nothing fits.
Outcome WholePass::repairWithin(int cell, int reach) {
  Region& region = *region_;
  const std::vector<std::int32_t> inner = problem_.cellsAround(cell, reach);
  const std::vector<std::int32_t> wide = problem_.cellsAround(cell, reach + kMargin);
  std::vector<std::int32_t> ahead;
  std::set_difference(std::upper_bound(wide.begin(), wide.end(), cell), wide.end(), inner.begin(),
                      inner.end(), std::back_inserter(ahead));
  const bool everything = inner.size() + ahead.size() == static_cast<std::size_t>(network_.cells);
  const Outcome failed = everything ? Outcome::Impossible : Outcome::Unfinished;
  const std::int64_t exactBefore = region.counts().exact;
  if (!region.takeBack(inner, ahead, catalog_, progress_)) return failed;

  const std::int64_t budget = problem_.options().budget;
  RegionEffort effort;
  effort.passes = 0;
  effort.searches = inner.size() <= kMostSearched ? 2 : 0;
  effort.searchConflicts =
      std::min(kSearchConflicts, 50 + static_cast<std::int64_t>(inner.size()) / 4);
  effort.exactConflicts = everything ? budget : std::min(budget, kRegionConflicts);
  effort.work = workLeft(cell);
  RegionChoice choice{chooser_.numbersFor(LabelChooser::Purpose::Repairs).fork(repairs_++)};
  choice.choose = [&](const Random& random, int c, std::span<const LabelWord> set, int draw) {
    return chooser_.choose(random, c, set, draw, region.placed());
  };
  // What was there first, and what is most frequent ahead: the solution then changes little, is
  // found soon, and what is ahead is chosen at random later.
  choice.prefer = [&](int c, std::span<const LabelWord> set) {
    return c < cell ? catalog_.firstLabel(c) : chooser_.mostFrequent(c, set);
  };
  choice.fits = [&] { return region.keep(catalog_, cell); };
  const Outcome outcome = region.relabel(effort, choice, progress_);
  statistics_.exact += region.counts().exact - exactBefore;
  return outcome == Outcome::Impossible ? failed : outcome;
}

Outcome WholePass::repair(int cell) {
  if (!region_) region_.emplace(network_, base_);
  // Where the last repairs were near, too, regions of that size do not help.
  std::size_t first = 0;
  const Vec3i here = problem_.cellAt(problem_.positionOf(cell));
  if (lastRepaired_ >= 0) {
    const Vec3i there = problem_.cellAt(problem_.positionOf(lastRepaired_));
    const Vec3i d = here - there;
    const bool near = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) <= kReach[lastReach_];
    again_ = near ? again_ + 1 : 0;
    if (again_ >= kRepairsInPlace) {
      first = std::min<std::size_t>(lastReach_ + 1, kReach.size() - 2);
      again_ = 0;
    }
  }
  for (std::size_t r = first; r < kReach.size(); ++r) {
    if (workLeft(cell) <= 0) return Outcome::Unfinished;
    ++statistics_.repairs;
    const Outcome outcome = repairWithin(cell, kReach[r]);
    if (outcome != Outcome::Unfinished) {
      lastRepaired_ = cell;
      lastReach_ = static_cast<int>(r);
      return outcome;
    }
  }
  if (workLeft(cell) <= 0) return Outcome::Unfinished;
  std::int64_t labels = 0;
  for (int c = 0; c < network_.cells; ++c) labels += labelsIn(base_[c]);
  if (labels > kMostLabelsAtOnce) return Outcome::Unfinished;
  ++statistics_.repairs;
  return repairWithin(cell, kEverywhere);
}

Labeling WholePass::run() {
  Labeling result;
  const LabelChooser::Placed placed = [this](int cell) {
    return catalog_.decided(cell) ? catalog_.firstLabel(cell) : -1;
  };
  for (int c = 0; c < network_.cells; ++c) {
    result.share = static_cast<double>(c) / network_.cells;
    if (c % 1024 == 0) progress_.report("labeling", result.share);
    if (catalog_.decided(c)) continue;
    const auto choose = [&](int cell, std::span<const LabelWord> set, int draw) {
      if (plain_) return chooser_.mostFrequent(cell, set);
      return chooser_.choose(chooser_.numbersForPass(), cell, set, draw, placed);
    };
    const std::int32_t one[1] = {c};
    if (labelInOrder(catalog_, one, choose, statistics_.contradictions, progress_)) {
      if (c % 64 != 0 || workLeft(c) > 0) continue;
      return result;
    }
    const Outcome outcome = repair(c);
    if (outcome != Outcome::Complete) {
      result.outcome = outcome;
      return result;
    }
  }
  result.outcome = Outcome::Complete;
  result.labels.resize(network_.cells);
  for (int c = 0; c < network_.cells; ++c) {
    result.labels[c] = static_cast<Label>(catalog_.firstLabel(c));
  }
  return result;
}

}  // namespace

Labeling labelWhole(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                    ModelStatistics& statistics, const Progress& progress,
                    std::optional<int> patience, bool plain) {
  return WholePass(problem, base, chooser, statistics, progress, patience, plain).run();
}

}  // namespace exemplar
