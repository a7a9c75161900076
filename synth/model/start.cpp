// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/start.h"

#include <algorithm>
#include <array>
#include <compare>
#include <numeric>
#include <utility>

#include "synth/model/region.h"

namespace exemplar {
namespace {

/// A way to repeat cells along x and y: so many at either side stand for themselves, and what lies
/// between them repeats.
struct Pattern {
  int rim;
  Vec3i period;  // of x and y
};

/// Those that are tried: small ones first, and flat results, which cost little, with longer ones.
std::vector<Pattern> patterns(const Vec3i& size) {
  std::vector<Pattern> list;
  for (const auto& [x, y] : std::array<std::pair<int, int>, 9>{
           {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 1}, {1, 3}, {3, 2}, {2, 3}, {3, 3}}})
    list.push_back({0, {x, y, 1}});
  for (const int rim : {1, 2, 3, 4}) {
    for (const auto& [x, y] :
         std::array<std::pair<int, int>, 5>{{{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 3}}})
      list.push_back({rim, {x, y, 1}});
  }
  if (size.z > 1) return list;
  for (const int period : {4, 5, 6, 7, 8}) {
    for (const int rim : {0, 2}) list.push_back({rim, {period, period, 1}});
  }
  return list;
}

/// Larger tiles than this are not tried: labels in all cells.
constexpr std::int64_t kMostLabels = 60'000;
/// Of `ExactSolver::steps`.
constexpr std::int64_t kSteps = 20'000;
/// How far apart, along x or y, neighbors mostly are at most.
constexpr int kNear = 3;

/// An axis in classes: cells alike.
struct AxisClasses {
  std::vector<int> of;    // each index's class
  std::vector<int> some;  // indices, one at least for each class and the classes around it
  int count = 0;
};

AxisClasses classesAlong(int n, int rim, int period, bool periodic) {
  AxisClasses classes;
  if (periodic) rim = 0;
  const bool all = n <= 2 * rim + period;
  classes.count = all ? n : 2 * rim + period;
  std::vector<std::vector<int>> known;
  for (int i = 0; i < n; ++i) {
    const int middle = rim + (i - rim) % period;
    classes.of.push_back(all || i < rim ? i : i >= n - rim ? classes.count - (n - i) : middle);
  }
  for (int i = 0; i < n; ++i) {
    std::vector<int> around;
    for (int d = -kNear; d <= kNear; ++d) {
      const int j = periodic ? ((i + d) % n + n) % n : i + d;
      around.push_back(j < 0 || j >= n ? -1 : classes.of[j]);
    }
    if (std::find(known.begin(), known.end(), around) != known.end()) continue;
    known.push_back(std::move(around));
    classes.some.push_back(i);
  }
  return classes;
}

/// The network of one tile: cells alike are one cell, with the labels that suit all of them and
/// the neighbors of each.
class Tile {
 public:
  Tile(const ModelProblem& problem, const Pattern& pattern)
      : problem_(problem),
        x_(classesAlong(problem.options().size.x, pattern.rim, pattern.period.x,
                        problem.options().periodic.x)),
        y_(classesAlong(problem.options().size.y, pattern.rim, pattern.period.y,
                        problem.options().periodic.y)) {
    const ModelOptions& o = problem.options();
    number_.assign(static_cast<std::size_t>(x_.count) * y_.count * o.size.z * o.frames, -1);
  }

  /// Finds the tile's cells; false where one has no label, or there are too many in all.
  bool findCells(const LabelSets& base, const Progress& progress);
  void findNeighbors();

  const LabelNetwork& network() const { return network_; }
  const LabelSets& domains() const { return domains_; }
  /// A cell of the whole network for each of the tile.
  const std::vector<std::int32_t>& members() const { return members_; }
  /// Calls `visit(cell, tile cell)` for all cells of the whole network, ascending.
  template <class Visit>
  void forEach(const Visit& visit) const {
    const ModelOptions& o = problem_.options();
    const int column = o.size.z * o.frames;
    std::int64_t at = 0;
    for (int i = 0; i < o.size.x; ++i) {
      for (int j = 0; j < o.size.y; ++j) {
        const int first = (x_.of[i] * y_.count + y_.of[j]) * column;
        for (int k = 0; k < column; ++k, ++at) {
          const int c = problem_.cell(at);
          if (c >= 0 && problem_.positionOf(c) == at) visit(c, first + k);
        }
      }
    }
  }
  int cellOf(int key) const { return number_[key]; }

 private:
  int keyOf(int cell) const;

  const ModelProblem& problem_;
  AxisClasses x_, y_;
  LabelNetwork network_;
  LabelSets domains_;
  std::vector<std::int32_t> number_;  // by class along x, y, then z and frame
  std::vector<std::int32_t> members_;
};

int Tile::keyOf(int cell) const {
  const ModelOptions& o = problem_.options();
  const std::int64_t at = problem_.positionOf(cell);
  const Vec3i p = problem_.cellAt(at);
  return ((x_.of[p.x] * y_.count + y_.of[p.y]) * o.size.z + p.z) * o.frames + problem_.frameAt(at);
}

bool Tile::findCells(const LabelSets& base, const Progress& progress) {
  progress.check();
  const std::size_t words = static_cast<std::size_t>(base.words());
  std::vector<LabelWord> sets(number_.size() * words, ~LabelWord{0});
  forEach([&](int c, int key) {
    if (number_[key] < 0) {
      number_[key] = static_cast<int>(members_.size());
      members_.push_back(c);
    }
    const LabelWord* from = base[c].data();
    LabelWord* to = sets.data() + static_cast<std::size_t>(key) * words;
    for (std::size_t w = 0; w < words; ++w) to[w] &= from[w];
  });
  domains_ = LabelSets(problem_.network().labels, members_.size());
  std::int64_t labels = 0;
  for (std::size_t key = 0; key < number_.size(); ++key) {
    if (number_[key] < 0) continue;
    const auto set = domains_[number_[key]];
    std::copy_n(sets.begin() + static_cast<std::ptrdiff_t>(key * words), words, set.begin());
    const int count = labelsIn(set);
    if (count == 0) return false;
    labels += count;
  }
  return labels <= kMostLabels;
}

void Tile::findNeighbors() {
  const ModelOptions& o = problem_.options();
  const LabelNetwork& whole = problem_.network();
  network_.labels = whole.labels;
  network_.slots = whole.slots;
  network_.support = whole.support;
  network_.cells = static_cast<int>(members_.size());
  network_.neighbor.assign(static_cast<std::size_t>(network_.cells) * whole.slots, network_.cells);

  struct Pair {
    std::int32_t relation, near, far;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  const auto look = [&](int c) {
    const int t = cellOf(keyOf(c));
    whole.forEachNeighbor(c, [&](int n, int relation) {
      pairs.push_back({relation, t, cellOf(keyOf(n))});
    });
  };
  if (o.mask.empty() && !o.symmetry.any()) {
    // Cells whose surroundings are of the same classes have the same neighbors.
    for (const int i : x_.some) {
      for (const int j : y_.some) {
        const std::int64_t first = problem_.position({i, j, 0});
        for (int k = 0; k < o.size.z * o.frames; ++k) look(problem_.cell(first + k));
      }
    }
  } else {
    for (int c = 0; c < whole.cells; ++c) look(c);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

  // A slot holds one neighbor, and is seen from there as the slot opposite. Where a class meets
  // several, each is a link; links have relations of their own, the same tables once more.
  std::vector<int> count(static_cast<std::size_t>(network_.cells) * whole.slots, 0);
  const auto slot = [&](int cell, int relation) {
    return static_cast<std::size_t>(cell) * whole.slots + relation;
  };
  for (const Pair& p : pairs) {
    if (p.relation < whole.slots) ++count[slot(p.near, p.relation)];
  }
  const int copies = static_cast<int>(network_.support.size());
  for (int r = 0; r < whole.slots; ++r) network_.support.push_back(whole.support[r]);
  std::vector<std::vector<LabelNetwork::Link>> links(network_.cells);
  for (const Pair& p : pairs) {
    if (p.relation >= whole.slots) {
      links[p.near].push_back({p.far, p.relation});
    } else if (count[slot(p.near, p.relation)] == 1 && count[slot(p.far, p.relation ^ 1)] == 1) {
      network_.neighbor[slot(p.near, p.relation)] = p.far;
    } else {
      links[p.near].push_back({p.far, copies + p.relation});
    }
  }
  network_.linkBegin.push_back(0);
  for (const auto& list : links) {
    network_.links.insert(network_.links.end(), list.begin(), list.end());
    network_.linkBegin.push_back(static_cast<std::int32_t>(network_.links.size()));
  }
}

}  // namespace

bool consistent(const LabelNetwork& network, const std::vector<Label>& labels) {
  for (int c = 0; c < network.cells; ++c) {
    bool sound = true;
    network.forEachNeighbor(c, [&](int n, int relation) {
      sound = sound && containsLabel(network.support[relation][labels[c]], labels[n]);
    });
    if (!sound) return false;
  }
  return true;
}

std::optional<std::vector<Label>> findTiledStart(const ModelProblem& problem, const LabelSets& base,
                                                 const LabelChooser& chooser,
                                                 ModelStatistics& statistics,
                                                 const Progress& progress, bool plain) {
  const std::vector<Pattern> list = patterns(problem.options().size);
  for (std::size_t number = 0; number < list.size(); ++number) {
    progress.report("finding a tile to begin with",
                    static_cast<double>(number) / static_cast<double>(list.size()));
    const Pattern& pattern = list[number];
    if (pattern.period.x > problem.options().size.x || pattern.period.y > problem.options().size.y)
      continue;
    Tile tile(problem, pattern);
    if (!tile.findCells(base, progress)) continue;
    tile.findNeighbors();
    // The tile is a region that nothing surrounds.
    std::vector<std::int32_t> all(static_cast<std::size_t>(tile.network().cells));
    std::iota(all.begin(), all.end(), 0);
    Region region(tile.network(), tile.domains());
    if (!region.takeBack(all, std::span<const Label>{}, progress)) continue;
    RegionChoice choice{chooser.numbersFor(LabelChooser::Purpose::Start).fork(number)};
    choice.choose = [&](const Random& random, int c, std::span<const LabelWord> set, int draw) {
      if (plain) return mostFrequentLabel(problem.adjacency(), set);
      return chooser.choose(random, tile.members()[c], set, draw);
    };
    const RegionEffort effort{.passes = 0,
                              .searches = 1,
                              .searchConflicts = 200,
                              .exactConflicts = problem.options().budget,
                              .exactSteps = kSteps};
    const Outcome outcome = region.relabel(effort, choice, progress);
    statistics.exact += region.counts().exact;
    if (outcome != Outcome::Complete) continue;
    std::vector<Label> labels(static_cast<std::size_t>(problem.network().cells));
    tile.forEach([&](int c, int key) { labels[c] = region.label(tile.cellOf(key)); });
    // Where a periodic side does not meet its opposite after whole tiles this tile will not do.
    if (consistent(problem.network(), labels)) return labels;
  }
  return std::nullopt;
}

}  // namespace exemplar
