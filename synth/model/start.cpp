// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/start.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace exemplar {
namespace {

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
constexpr std::int64_t kMostTileLabels = 60'000;
/// Of `ExactSolver::steps`.
constexpr std::int64_t kSteps = 20'000;
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

std::optional<std::vector<Label>> layTile(const ModelProblem& problem, const Tile& tile,
                                          Region& region, const RegionChoice& choice,
                                          ModelStatistics& statistics, const Progress& progress) {
  const RegionEffort effort{.passes = 0,
                            .searches = 1,
                            .searchConflicts = 200,
                            .exactConflicts = problem.options().budget,
                            .exactSteps = kSteps};
  const Outcome outcome = region.relabel(effort, choice, progress);
  statistics.exact += region.counts().exact;
  if (outcome != Outcome::Complete) return std::nullopt;
  std::vector<Label> labels(static_cast<std::size_t>(problem.network().cells));
  tile.forEach([&](int c, int key) { labels[c] = region.label(tile.cellOf(key)); });
  if (!consistent(problem.network(), labels)) return std::nullopt;
  return labels;
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
    if (!tile.findCells(base, kMostTileLabels, progress)) continue;
    tile.findNeighbors();
    // The tile is a region that nothing surrounds.
    std::vector<std::int32_t> all(static_cast<std::size_t>(tile.network().cells));
    std::iota(all.begin(), all.end(), 0);
    Region region(tile.network(), tile.domains());
    if (!region.takeBack(all, std::span<const Label>{}, progress)) continue;
    RegionChoice choice{chooser.numbersFor(LabelChooser::Purpose::Start).fork(number)};
    choice.choose = [&](const Random& random, int c, std::span<const LabelWord> set, int draw) {
      if (plain) return chooser.mostFrequent(tile.members()[c], set);
      return chooser.choose(random, tile.members()[c], set, draw);
    };
    if (auto labels = layTile(problem, tile, region, choice, statistics, progress)) return labels;
  }
  return std::nullopt;
}

}  // namespace exemplar
