// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/whole.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include "synth/model/catalog.h"
#include "synth/model/exact.h"
#include "synth/model/search.h"

namespace exemplar {
namespace {

/// How far a region reaches that is taken back, in cells: the first tries are small.
constexpr std::array<int, 7> kReach{2, 3, 4, 6, 9, 16, 24};
/// From here on the exact solver may take a second.
constexpr int kLarge = 9;
/// At last everything is taken back, unless that is more labels than the exact solver could hold.
constexpr int kEverywhere = 1 << 20;
constexpr std::int64_t kMostLabelsAtOnce = 4'000'000;
/// How far around it cells that are not labelled yet are looked at too.
constexpr int kMargin = 3;
/// Conflicts that the exact solver may meet in a region before a larger one, which is freer, is
/// tried: regions that are solved at all mostly are within a few thousand.
constexpr std::int64_t kRegionConflicts = 5000;
/// A search remembers for each cell which decisions mattered: for more cells than this the exact
/// solver, which learns from conflicts, is sooner done.
constexpr std::size_t kMostSearched = 12000;
/// So many repairs near each other in a row before the next one begins with a larger region.
constexpr int kRepairsInPlace = 3;

class WholePass {
 public:
  WholePass(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
            ModelStatistics& statistics, const Progress& progress, std::optional<int> patience)
      : problem_(problem),
        network_(problem.network()),
        base_(base),
        chooser_(chooser),
        statistics_(statistics),
        progress_(progress),
        patience_(patience),
        catalog_(network_),
        draws_(0) {
    for (int c = 0; c < network_.cells; ++c) catalog_.setDomain(c, base[c]);
  }

  Labelling run();

 private:
  ModelStatus repair(int cell);
  ModelStatus repairWithin(int cell, int reach);
  void selectRegion(int cell, int reach);
  bool adopt(const std::vector<Label>& labels, int cell);
  int mostFrequent(std::span<const LabelWord> labels) const;

  const ModelProblem& problem_;
  const LabelNetwork& network_;
  const LabelSets& base_;
  const LabelChooser& chooser_;
  ModelStatistics& statistics_;
  const Progress& progress_;
  std::optional<int> patience_;
  int large_ = 0;  // large regions in a row that came to nothing
  Catalog catalog_;
  std::uint32_t draws_;

  std::unique_ptr<NetworkPart> part_;
  std::vector<std::int32_t> region_;  // cells looked at, ascending
  std::vector<std::int32_t> inner_;   // of these, the ones to label, as numbers of the part
  int lastRepaired_ = -1, lastReach_ = 0, again_ = 0;
};

void WholePass::selectRegion(int cell, int reach) {
  const ModelOptions& o = problem_.options();
  const std::int64_t at = problem_.positionOf(cell);
  const Vec3i center = problem_.cellAt(at);
  const int frame = problem_.frameAt(at);
  const int wide = reach + kMargin;
  region_.clear();
  std::vector<std::int32_t> inside;
  const auto distance = [&](int offset, int n, bool periodic) {
    const int d = std::abs(offset);
    return periodic ? std::min(d, n - d) : d;
  };
  // Each coordinate within reach, on the other side of a periodic axis too.
  const auto range = [&](int c, int n, bool periodic) {
    std::vector<int> list;
    for (int i = 0; i < n; ++i) {
      if (distance(i - c, n, periodic) <= wide) list.push_back(i);
    }
    return list;
  };
  const auto xs = range(center.x, o.size.x, o.periodic[0]);
  const auto ys = range(center.y, o.size.y, o.periodic[1]);
  const auto zs = range(center.z, o.size.z, o.periodic[2]);
  const auto ts = range(frame, o.frames, o.loop);
  for (const int x : xs) {
    for (const int y : ys) {
      for (const int z : zs) {
        for (const int t : ts) {
          const int c = problem_.cell(problem_.position({x, y, z}, t));
          if (c < 0) continue;
          const int d = std::max({distance(x - center.x, o.size.x, o.periodic[0]),
                                  distance(y - center.y, o.size.y, o.periodic[1]),
                                  distance(z - center.z, o.size.z, o.periodic[2]),
                                  distance(t - frame, o.frames, o.loop)});
          if (d <= reach) {
            inside.push_back(c);
            region_.push_back(c);
          } else if (c > cell) {
            region_.push_back(c);
          }
        }
      }
    }
  }
  // Images of one cell come several times.
  for (auto* list : {&inside, &region_}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  if (!part_) part_ = std::make_unique<NetworkPart>(network_);
  part_->select(region_);
  inner_.clear();
  for (const std::int32_t c : inside) inner_.push_back(part_->local(c));
}

/// Puts a region's new labels in place, for the cells up to `cell`, and sets free the others.
bool WholePass::adopt(const std::vector<Label>& labels, int cell) {
  catalog_.mark();
  std::vector<LabelWord> one(network_.words());
  for (const std::int32_t c : region_) {
    if (c > cell) {
      catalog_.setDomain(c, base_[c]);
    } else {
      std::fill(one.begin(), one.end(), 0);
      addLabel(one, labels[part_->local(c)]);
      catalog_.setDomain(c, one);
    }
  }
  for (const std::int32_t c : region_) {
    catalog_.touch(c);
    network_.forEachNeighbor(c, [&](int n, int) { catalog_.touch(n); });
  }
  if (!catalog_.propagate()) {
    catalog_.undoTo(0);
    return false;
  }
  catalog_.commit();
  return true;
}

int WholePass::mostFrequent(std::span<const LabelWord> labels) const {
  int best = -1;
  const auto& frequency = problem_.adjacency().frequency;
  forEachLabel(labels, [&](int b) {
    if (best < 0 || frequency[b] > frequency[best]) best = b;
  });
  return best;
}

ModelStatus WholePass::repairWithin(int cell, int reach) {
  selectRegion(cell, reach);
  const int count = static_cast<int>(region_.size());
  LabelSets domains(network_.labels, count);
  for (int c = 0; c < count; ++c) {
    std::copy(base_[region_[c]].begin(), base_[region_[c]].end(), domains[c].begin());
    part_->restrictByOutside(c, domains[c], [&](int far) { return catalog_.domain(far); });
  }
  const bool everything = count == network_.cells;
  Catalog local(part_->network());
  for (int c = 0; c < count; ++c) local.setDomain(c, domains[c]);
  if (!local.propagateAll()) return everything ? ModelStatus::Impossible : ModelStatus::Unfinished;
  for (int c = 0; c < count; ++c) {
    std::copy(local.domain(c).begin(), local.domain(c).end(), domains[c].begin());
  }

  std::vector<Label> labels(count, 0);
  const LabelChooser::Placed placed = [&](int far) {
    const int c = part_->local(far);
    if (c >= 0) return local.decided(c) ? local.firstLabel(c) : -1;
    return catalog_.decided(far) ? catalog_.firstLabel(far) : -1;
  };
  const int attempts = inner_.size() <= kMostSearched ? 2 : 0;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    draws_ += 64;
    const std::uint32_t first = draws_;
    const auto choose = [&](int c, std::span<const LabelWord> set, int draw) {
      return chooser_.choose(region_[c], set, first + static_cast<std::uint32_t>(draw), placed);
    };
    if (attempt > 0) {
      for (int c = 0; c < count; ++c) local.setDomain(c, domains[c]);
    }
    const SearchOutcome outcome =
        searchLabels(local, inner_, choose, 50 + static_cast<std::int64_t>(inner_.size()) / 4);
    if (outcome == SearchOutcome::Impossible) {
      return everything ? ModelStatus::Impossible : ModelStatus::Unfinished;
    }
    if (outcome == SearchOutcome::GaveUp) continue;
    for (const std::int32_t c : inner_) labels[c] = static_cast<Label>(local.firstLabel(c));
    if (adopt(labels, cell)) return ModelStatus::Complete;
  }

  ++statistics_.exact;
  ExactSolver exact(part_->network(), domains);
  // What stands there first, and what is most frequent ahead: the solution then changes little, is
  // found soon, and what is ahead is chosen at random later.
  for (int c = 0; c < count; ++c) {
    exact.prefer(c, region_[c] < cell ? catalog_.firstLabel(region_[c]) : mostFrequent(domains[c]));
  }
  const std::int64_t budget = problem_.options().budget;
  const auto outcome =
      exact.solve({}, everything ? budget : std::min(budget, kRegionConflicts), progress_);
  if (outcome == ExactSolver::Outcome::Solved) {
    for (int c = 0; c < count; ++c) labels[c] = static_cast<Label>(exact.label(c));
    if (adopt(labels, cell)) return ModelStatus::Complete;
  }
  if (outcome == ExactSolver::Outcome::Impossible && everything) return ModelStatus::Impossible;
  return ModelStatus::Unfinished;
}

ModelStatus WholePass::repair(int cell) {
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
    ++statistics_.repairs;
    const ModelStatus status = repairWithin(cell, kReach[r]);
    if (progress_.cancelled()) return ModelStatus::Cancelled;
    if (status == ModelStatus::Unfinished && kReach[r] >= kLarge && patience_ &&
        ++large_ > *patience_) {
      return status;
    }
    if (status != ModelStatus::Unfinished) {
      large_ = 0;
      lastRepaired_ = cell;
      lastReach_ = static_cast<int>(r);
      return status;
    }
  }
  std::int64_t labels = 0;
  for (int c = 0; c < network_.cells; ++c) labels += labelsIn(base_[c]);
  if (labels > kMostLabelsAtOnce) return ModelStatus::Unfinished;
  ++statistics_.repairs;
  const ModelStatus status = repairWithin(cell, kEverywhere);
  return progress_.cancelled() ? ModelStatus::Cancelled : status;
}

Labelling WholePass::run() {
  Labelling result;
  const LabelChooser::Placed placed = [this](int cell) {
    return catalog_.decided(cell) ? catalog_.firstLabel(cell) : -1;
  };
  for (int c = 0; c < network_.cells; ++c) {
    if (c % 4096 == 0) {
      progress_.report("labelling", static_cast<double>(c) / network_.cells);
      if (progress_.cancelled()) {
        result.status = ModelStatus::Cancelled;
        return result;
      }
    }
    if (catalog_.decided(c)) continue;
    const std::uint32_t first = draws_;
    const auto choose = [&](int cell, std::span<const LabelWord> set, int draw) {
      return chooser_.choose(cell, set, first + static_cast<std::uint32_t>(draw), placed);
    };
    const std::int32_t one[1] = {c};
    if (labelInOrder(catalog_, one, choose, statistics_.contradictions)) continue;
    const ModelStatus status = repair(c);
    if (status != ModelStatus::Complete) {
      result.status = status;
      return result;
    }
  }
  result.status = ModelStatus::Complete;
  result.labels.resize(network_.cells);
  for (int c = 0; c < network_.cells; ++c) {
    result.labels[c] = static_cast<Label>(catalog_.firstLabel(c));
  }
  return result;
}

}  // namespace

Labelling labelWhole(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, ModelStatistics& statistics,
                     const Progress& progress, std::optional<int> patience) {
  return WholePass(problem, base, chooser, statistics, progress, patience).run();
}

}  // namespace exemplar
