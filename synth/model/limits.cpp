// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/limits.h"

#include <algorithm>
#include <utility>

#include "synth/model/catalog.h"
#include "synth/model/search.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kLimitStream = 0x4C424C33;  // where a limit is worked on
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
  std::vector<std::int32_t> piece(problem_.positions(), -1);
  std::vector<std::int64_t> sizes, stack;
  const auto inSet = [&](std::int64_t at) {
    const int c = problem_.cell(at);
    return c >= 0 && set[problem_.labelAt(at, labels[c])];
  };
  for (std::int64_t first = 0; first < problem_.positions(); ++first) {
    if (piece[first] >= 0 || !inSet(first)) continue;
    const int number = static_cast<int>(sizes.size());
    sizes.push_back(0);
    piece[first] = number;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::int64_t at = stack.back();
      stack.pop_back();
      ++sizes[number];
      const Vec3i p = problem_.cellAt(at);
      for (int side = 0; side < 6; ++side) {
        Vec3i q = p;
        const int axis = side / 2;
        q[axis] += side % 2 ? 1 : -1;
        if (o.periodic[axis]) q[axis] = (q[axis] + o.size[axis]) % o.size[axis];
        if (q[axis] < 0 || q[axis] >= o.size[axis]) continue;
        const std::int64_t there = problem_.position(q, problem_.frameAt(at));
        if (piece[there] >= 0 || !inSet(there)) continue;
        piece[there] = number;
        stack.push_back(there);
      }
    }
  }
  std::vector<std::int32_t> cells;
  if (sizes.size() < 2) return cells;
  const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  for (std::int64_t at = 0; at < problem_.positions(); ++at) {
    if (piece[at] >= 0 && piece[at] != largest) cells.push_back(problem_.cell(at));
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

/// The cells within `reach` of a cell, ascending.
std::vector<std::int32_t> cellsAround(const ModelProblem& problem, int cell, int reach) {
  const ModelOptions& o = problem.options();
  const std::int64_t at = problem.positionOf(cell);
  const Vec3i p = problem.cellAt(at);
  const Vec3i low = max(p - Vec3i{reach, reach, reach}, Vec3i{0, 0, 0});
  const Vec3i high = min(p + Vec3i{reach, reach, reach}, o.size - Vec3i{1, 1, 1});
  std::vector<std::int32_t> cells;
  for (int i = low.x; i <= high.x; ++i) {
    for (int j = low.y; j <= high.y; ++j) {
      for (int k = low.z; k <= high.z; ++k) {
        for (int t = 0; t < o.frames; ++t) {
          if (std::abs(t - problem.frameAt(at)) > reach) continue;
          const int c = problem.cell(problem.position({i, j, k}, t));
          if (c >= 0) cells.push_back(c);
        }
      }
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

std::int64_t limitsMissed(const ModelProblem& problem, const std::vector<Label>& labels) {
  return Limits(problem).look(labels).missed;
}

Labelling meetLimits(const ModelProblem& problem, const LabelSets& base,
                     const LabelChooser& chooser, std::vector<Label> labels,
                     ModelStatistics& statistics, const Progress& progress) {
  const LabelNetwork& network = problem.network();
  const Limits limits(problem);
  const Random random(problem.options().seed, kLimitStream);
  Limits::Broken broken = limits.look(labels);
  if (broken.missed == 0) return {ModelStatus::Complete, std::move(labels)};

  NetworkPart part(network);
  const std::int64_t first = broken.missed;
  int withoutGain = 0;
  for (std::int64_t tries = 0;
       tries < problem.options().budget && withoutGain < kMostTriesWithoutGain; ++tries) {
    if (progress.cancelled()) return {ModelStatus::Cancelled, {}};
    progress.report("meeting limits", 1 - static_cast<double>(broken.missed) / first);
    ++withoutGain;
    const std::uint64_t number = static_cast<std::uint64_t>(tries);
    const int target =
        broken.cells.empty()
            ? static_cast<int>(random.below(static_cast<std::uint32_t>(network.cells), number))
            : broken.cells[random.below(static_cast<std::uint32_t>(broken.cells.size()), number)];
    const int reach = 2 + static_cast<int>(random.below(6, number, 1));
    const auto cells = cellsAround(problem, target, reach);
    part.select(cells);
    const int count = static_cast<int>(cells.size());
    Catalog catalog(part.network());
    LabelSets domains(network.labels, count);
    for (int c = 0; c < count; ++c) {
      std::copy(base[cells[c]].begin(), base[cells[c]].end(), domains[c].begin());
      part.restrictByLabels(c, domains[c], labels);
      catalog.setDomain(c, domains[c]);
    }
    if (!catalog.propagateAll()) continue;

    // Put one of the labels in, or keep them out: of the whole region half of the time, else of
    // the one cell.
    LabelSets wanted(network.labels, 1);
    for (int b = 0; b < network.labels; ++b) {
      if ((*broken.set)[b] == broken.tooFew) addLabel(wanted[0], b);
    }
    const bool everywhere = !broken.tooFew && random.below(2, number, 2) == 0;
    catalog.mark();
    bool sound = true;
    for (int c = 0; c < count && sound; ++c) {
      if (!everywhere && cells[c] != target) continue;
      sound = catalog.restrict(c, wanted[0]);
    }
    if (!sound || !catalog.propagate()) continue;
    catalog.commit();

    std::vector<std::int32_t> order(count);
    for (int c = 0; c < count; ++c) order[c] = c;
    const std::uint32_t draws = 0x80000000u + static_cast<std::uint32_t>(tries) * 256u;
    const auto choose = [&](int c, std::span<const LabelWord> set, int draw) {
      return chooser.choose(cells[c], set, draws + static_cast<std::uint32_t>(draw));
    };
    if (!labelInOrder(catalog, order, choose, statistics.contradictions)) continue;
    ++statistics.repairs;
    std::vector<Label> changed = labels;
    for (int c = 0; c < count; ++c) changed[cells[c]] = static_cast<Label>(catalog.firstLabel(c));
    Limits::Broken now = limits.look(changed);
    if (now.missed > broken.missed) continue;
    if (now.missed < broken.missed) withoutGain = 0;
    labels = std::move(changed);
    broken = std::move(now);
    if (broken.missed == 0) return {ModelStatus::Complete, std::move(labels)};
  }
  return {ModelStatus::Unfinished, {}};
}

}  // namespace exemplar
