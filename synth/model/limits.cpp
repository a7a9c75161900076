// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/limits.h"

#include <algorithm>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/random.h"
#include "synth/model/region.h"

namespace exemplar {
namespace {

constexpr int kMostTriesWithoutGain = 2000;

std::vector<bool> membership(const std::vector<Label>& set, int labels) {
  std::vector<bool> member(labels, false);
  for (const Label b : set) member[b] = true;
  return member;
}

/// The limits of a request over the positions of its grid; a cell that has images counts for each.
class Limits {
 public:
  explicit Limits(const ModelProblem& problem) : problem_(problem) {
    const int labels = problem.network().labels;
    for (const CountLimit& c : problem.options().counts)
      counted_.push_back(membership(c.labels, labels));
    for (const auto& set : problem.options().connected) joined_.push_back(membership(set, labels));
  }

  struct Broken {
    std::int64_t missed = 0;
    bool tooFew = false;  ///< the first broken limit asks for more of `set`, not fewer
    const std::vector<bool>* set = nullptr;
    std::vector<std::int32_t> cells;  ///< where to change something; empty: anywhere
  };
  Broken look(const std::vector<Label>& labels) const;

 private:
  /// The cells of a set that lie outside its largest piece.
  std::vector<std::int32_t> strays(const std::vector<bool>& set,
                                   const std::vector<Label>& labels) const;

  const ModelProblem& problem_;
  std::vector<std::vector<bool>> counted_, joined_;
};

std::vector<std::int32_t> Limits::strays(const std::vector<bool>& set,
                                         const std::vector<Label>& labels) const {
  // Pieces are joined through faces of the whole grid, images included.
  const ModelOptions& o = problem_.options();
  const auto inSet = [&](std::int64_t at) {
    const int c = problem_.cell(at);
    return c >= 0 && set[problem_.labelAt(at, labels[c])];
  };
  DisjointSets pieces(static_cast<std::size_t>(problem_.positions()));
  std::vector<std::int64_t> members;
  for (std::int64_t at = 0; at < problem_.positions(); ++at) {
    if (!inSet(at)) continue;
    members.push_back(at);
    const Vec3i p = problem_.cellAt(at);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i q = p;
      ++q[axis];
      if (q[axis] == o.size[axis] && o.periodic[axis]) q[axis] = 0;
      if (q[axis] == o.size[axis]) continue;
      const std::int64_t there = problem_.position(q, problem_.frameAt(at));
      if (inSet(there)) {
        pieces.join(static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(there));
      }
    }
  }
  const auto pieceOf = [&](std::int64_t at) { return pieces.find(static_cast<std::uint32_t>(at)); };
  std::vector<std::int64_t> size(static_cast<std::size_t>(problem_.positions()), 0);
  for (const std::int64_t at : members) ++size[pieceOf(at)];
  const auto largest = std::max_element(size.begin(), size.end()) - size.begin();
  std::vector<std::int32_t> cells;
  for (const std::int64_t at : members) {
    if (pieceOf(at) != largest) cells.push_back(problem_.cell(at));
  }
  return cells;
}

Limits::Broken Limits::look(const std::vector<Label>& labels) const {
  Broken broken;
  for (std::size_t i = 0; i < counted_.size(); ++i) {
    const CountLimit& limit = problem_.options().counts[i];
    std::vector<std::int32_t> cells;
    for (std::int64_t at = 0; at < problem_.positions(); ++at) {
      const int c = problem_.cell(at);
      if (c >= 0 && counted_[i][problem_.labelAt(at, labels[c])]) cells.push_back(c);
    }
    const std::int64_t count = static_cast<std::int64_t>(cells.size());
    const std::int64_t more = std::max<std::int64_t>(0, limit.least - count);
    const std::int64_t fewer =
        limit.most ? std::max<std::int64_t>(0, count - *limit.most) : std::int64_t{0};
    if (more + fewer > 0 && broken.set == nullptr) {
      broken.set = &counted_[i];
      broken.tooFew = more > 0;
      if (fewer > 0) broken.cells = std::move(cells);
    }
    broken.missed += more + fewer;
  }
  for (const auto& set : joined_) {
    std::vector<std::int32_t> cells = strays(set, labels);
    broken.missed += static_cast<std::int64_t>(cells.size());
    if (!cells.empty() && broken.set == nullptr) {
      broken.set = &set;
      broken.cells = std::move(cells);
    }
  }
  return broken;
}

}  // namespace

std::int64_t limitsMissed(const ModelProblem& problem, const std::vector<Label>& labels) {
  return Limits(problem).look(labels).missed;
}

std::optional<std::string> impossibleLimit(const ModelProblem& problem, const LabelSets& base) {
  const std::vector<CountLimit>& counts = problem.options().counts;
  if (counts.empty()) return std::nullopt;
  const int labels = problem.network().labels;
  std::vector<std::vector<bool>> sets;
  for (const CountLimit& c : counts) sets.push_back(membership(c.labels, labels));
  std::vector<std::int64_t> may(counts.size(), 0), must(counts.size(), 0);
  std::int64_t positions = 0;
  for (std::int64_t at = 0; at < problem.positions(); ++at) {
    const int c = problem.cell(at);
    if (c < 0) continue;
    ++positions;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      bool some = false, all = true;
      forEachLabel(base[c], [&](int b) {
        const bool counted = sets[i][problem.labelAt(at, static_cast<Label>(b))];
        some = some || counted;
        all = all && counted;
      });
      may[i] += some;
      must[i] += all;
    }
  }
  const auto named = [](std::size_t i) { return "`count` number " + std::to_string(i + 1); };
  std::int64_t together = 0;
  std::vector<bool> taken(static_cast<std::size_t>(labels), false);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].least > may[i]) {
      return named(i) + " asks for " + std::to_string(counts[i].least) + " cells or more, and of " +
             std::to_string(positions) + " only " + std::to_string(may[i]) + " can have its labels";
    }
    if (counts[i].most && *counts[i].most < must[i]) {
      return named(i) + " asks for " + std::to_string(*counts[i].most) + " cells or fewer, and " +
             std::to_string(must[i]) + " must have its labels";
    }
    bool apart = true;
    for (int b = 0; b < labels; ++b) apart = apart && !(sets[i][b] && taken[b]);
    if (!apart) continue;
    for (int b = 0; b < labels; ++b) taken[b] = taken[b] || sets[i][b];
    together += counts[i].least;
    if (together > positions) {
      return named(i) + " and those before it ask for " + std::to_string(together) +
             " cells together, and there are " + std::to_string(positions);
    }
  }
  return std::nullopt;
}

Labeling meetLimits(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
                    std::vector<Label> labels, ModelStatistics& statistics,
                    const Progress& progress) {
  const LabelNetwork& network = problem.network();
  const Limits limits(problem);
  Limits::Broken broken = limits.look(labels);
  if (broken.missed == 0) return {Outcome::Complete, std::move(labels)};

  const Random places(problem.options().seed, stream::kLimits);
  Region region(network, base);
  const RegionEffort effort{
      .passes = 1, .searches = 1, .searchConflicts = 100, .exactConflicts = 0};
  LabelSets wanted(network.labels, 1);
  std::vector<std::int32_t> which;
  const std::int64_t first = broken.missed;
  int withoutGain = 0;
  for (std::int64_t tries = 0;
       tries < problem.options().budget && withoutGain < kMostTriesWithoutGain; ++tries) {
    progress.report("meeting limits", 1 - static_cast<double>(broken.missed) / double(first));
    ++withoutGain;
    const std::uint64_t number = static_cast<std::uint64_t>(tries);
    const int target =
        broken.cells.empty()
            ? static_cast<int>(places.below(static_cast<std::uint32_t>(network.cells), number))
            : broken.cells[places.below(static_cast<std::uint32_t>(broken.cells.size()), number)];
    const int reach = 2 + static_cast<int>(places.below(6, number, 1));
    if (!region.takeBack(problem.cellsAround(target, reach), labels, progress)) continue;

    // Put one of the labels in, or keep them out: of the whole region half of the time, else of
    // the one cell.
    std::fill_n(wanted.data(), wanted.words(), LabelWord{0});
    for (int b = 0; b < network.labels; ++b) {
      if ((*broken.set)[b] == broken.tooFew) addLabel(wanted[0], b);
    }
    const bool everywhere = !broken.tooFew && places.below(2, number, 2) == 0;
    which.clear();
    for (int i = 0; i < region.count(); ++i) {
      if (everywhere || region.cells()[i] == target) which.push_back(i);
    }
    if (!region.demand(which, wanted[0])) continue;

    RegionChoice choice{chooser.numbersFor(LabelChooser::Purpose::Limits).fork(number)};
    choice.choose = [&](const Random& random, int c, std::span<const LabelWord> set, int draw) {
      return chooser.choose(random, c, set, draw, region.placed());
    };
    if (region.relabel(effort, choice, progress) != Outcome::Complete) continue;
    ++statistics.repairs;
    region.keep(labels);
    Limits::Broken now = limits.look(labels);
    if (now.missed > broken.missed) {
      region.undo(labels);
      continue;
    }
    if (now.missed < broken.missed) withoutGain = 0;
    broken = std::move(now);
    if (broken.missed == 0) break;
  }
  statistics.contradictions += region.counts().contradictions;
  if (broken.missed > 0) return {Outcome::Unfinished, {}};
  return {Outcome::Complete, std::move(labels)};
}

}  // namespace exemplar
