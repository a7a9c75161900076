// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/repeat_example.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "synth/model/start.h"

namespace exemplar {
namespace {

/// Gaps between one copy and the next, and how many of the outermost columns are free as well, at
/// last all: there, too, what the copy shows is tried first.
struct Spacing {
  int gap, free;
};
constexpr std::array<Spacing, 5> kSpacings{{{1, 0}, {3, 1}, {4, 2}, {4, 3}, {4, 1000}}};
/// Larger tiles than this are not tried: labels in all cells, and cells.
constexpr std::int64_t kMostTileLabels = 200'000;
constexpr int kMostTileCells = 8'000;
/// Of `Region::Counts::work`: where one spacing takes more, only the last is tried after it.
constexpr std::int64_t kMostWork = 1'000'000;

/// One copy and the gap after it, as a tile.
class Repeat {
 public:
  Repeat(const ModelProblem& problem, const LabelGrid& example, const Spacing& spacing)
      : problem_(problem),
        example_(example),
        free_(spacing.free),
        period_{example.size().x + spacing.gap, example.size().y + spacing.gap, 1},
        tile_(problem, {0, period_}) {}

  std::optional<std::vector<Label>> find(const LabelSets& base, const LabelChooser& chooser,
                                         std::uint64_t number, ModelStatistics& statistics,
                                         const Progress& progress);
  std::int64_t work() const { return work_; }  // of that

 private:
  /// What the copy shows at a cell of the tile, and how far that is from the copy's sides.
  std::pair<std::optional<Label>, int> shownAt(int cell) const;
  void demandCopy(Region& region, const Progress& progress) const;

  const ModelProblem& problem_;
  const LabelGrid& example_;
  const int free_;
  const Vec3i period_;
  Tile tile_;
  std::int64_t work_ = 0;
};

std::pair<std::optional<Label>, int> Repeat::shownAt(int cell) const {
  Vec3i p = problem_.cellAt(problem_.positionOf(tile_.members()[cell]));
  p.x %= period_.x;
  p.y %= period_.y;
  const Vec3i n = example_.size();
  if (p.x >= n.x || p.y >= n.y || p.z >= n.z) return {std::nullopt, 0};
  return {example_.cells[p], std::min({p.x, p.y, n.x - 1 - p.x, n.y - 1 - p.y})};
}

/// Demands the example's labels from the middle outward, but for those that exclude each other in a
/// tile.
void Repeat::demandCopy(Region& region, const Progress& progress) const {
  struct Wanted {
    int inward;
    std::int32_t number;
    Label label;
  };
  std::vector<Wanted> wanted;
  for (int i = 0; i < region.count(); ++i) {
    const auto [label, inward] = shownAt(region.cells()[i]);
    if (label && inward >= free_) wanted.push_back({inward, i, *label});
  }
  std::ranges::stable_sort(wanted, std::ranges::greater{}, &Wanted::inward);
  std::vector<LabelWord> set(static_cast<std::size_t>(problem_.network().words()));
  for (const Wanted& w : wanted) {
    if (w.number % 64 == 0) progress.check();
    if (!containsLabel(region.possible(w.number), w.label)) continue;
    std::ranges::fill(set, 0);
    set[w.label / 64] = LabelWord{1} << (w.label % 64);
    region.demand({&w.number, 1}, set);
  }
}

std::optional<std::vector<Label>> Repeat::find(const LabelSets& base, const LabelChooser& chooser,
                                               std::uint64_t number, ModelStatistics& statistics,
                                               const Progress& progress) {
  if (!tile_.findCells(base, kMostTileLabels, progress) ||
      static_cast<int>(tile_.members().size()) > kMostTileCells)
    return std::nullopt;
  tile_.findNeighbors();
  std::vector<std::int32_t> all(static_cast<std::size_t>(tile_.network().cells));
  std::iota(all.begin(), all.end(), 0);
  Region region(tile_.network(), tile_.domains());
  if (!region.takeBack(all, std::span<const Label>{}, progress)) return std::nullopt;
  demandCopy(region, progress);
  RegionChoice choice{chooser.numbersFor(LabelChooser::Purpose::Start).fork(number)};
  choice.choose = [&](const Random&, int c, std::span<const LabelWord> set, int) {
    if (const auto label = shownAt(c).first; label && containsLabel(set, *label))
      return static_cast<int>(*label);
    return chooser.mostFrequent(tile_.members()[c], set);
  };
  auto labels = layTile(problem_, tile_, region, choice, statistics, progress);
  work_ = region.counts().work;
  return labels;
}

}  // namespace

std::optional<std::vector<Label>> repeatExample(const ModelProblem& problem, const LabelSets& base,
                                                const LabelChooser& chooser,
                                                const LabelGrid& example,
                                                ModelStatistics& statistics,
                                                const Progress& progress) {
  const ModelOptions& o = problem.options();
  if (o.frames > 1 || o.symmetry.any() || !o.mask.empty() || !o.pins.empty()) return std::nullopt;
  for (std::size_t i = 0; i < kSpacings.size(); ++i) {
    const Spacing& s = kSpacings[i];
    progress.report("repeating the example", double(i) / kSpacings.size());
    if (example.size().x + s.gap >= o.size.x || example.size().y + s.gap >= o.size.y) break;
    Repeat repeat(problem, example, s);
    // Not the numbers of tiles that are tried to begin with.
    if (auto labels = repeat.find(base, chooser, (1 << 17) + i, statistics, progress))
      return labels;
    if (repeat.work() > kMostWork && i + 2 < kSpacings.size()) i = kSpacings.size() - 2;
  }
  return std::nullopt;
}

}  // namespace exemplar
