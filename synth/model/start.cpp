// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/start.h"

#include <array>
#include <numeric>
#include <utility>

#include "synth/model/region.h"

namespace exemplar {
namespace {

constexpr std::array<std::pair<int, int>, 9> kPeriods{
    {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 1}, {1, 3}, {3, 2}, {2, 3}, {3, 3}}};

/// The network of one tile: cells alike modulo the period are one cell, with the labels that suit
/// all of them.
struct Tile {
  LabelNetwork network;
  LabelSets domains;
  std::vector<std::int32_t> tileCell;  // of each cell of the whole network
  std::vector<std::int32_t> member;    // a cell of the whole network for each of the tile
};

Tile tileOf(const ModelProblem& problem, const LabelSets& base, int px, int py) {
  const ModelOptions& o = problem.options();
  const LabelNetwork& whole = problem.network();
  Tile tile;
  const int count = px * py * o.size.z * o.frames;
  std::vector<std::int32_t> number(count, -1);
  tile.tileCell.resize(whole.cells);
  for (int c = 0; c < whole.cells; ++c) {
    const std::int64_t at = problem.positionOf(c);
    const Vec3i p = problem.cellAt(at);
    const int key = ((p.x % px * py + p.y % py) * o.size.z + p.z) * o.frames + problem.frameAt(at);
    if (number[key] < 0) {
      number[key] = static_cast<int>(tile.member.size());
      tile.member.push_back(c);
    }
    tile.tileCell[c] = number[key];
  }

  tile.network.labels = whole.labels;
  tile.network.slots = whole.slots;
  tile.network.support = whole.support;
  tile.network.cells = static_cast<int>(tile.member.size());
  tile.network.neighbor.assign(static_cast<std::size_t>(tile.network.cells) * whole.slots,
                               tile.network.cells);
  tile.domains = LabelSets(whole.labels, tile.member.size());
  std::fill_n(tile.domains.data(), tile.member.size() * tile.domains.words(), ~LabelWord{0});
  for (int c = 0; c < whole.cells; ++c) {
    const int t = tile.tileCell[c];
    for (int w = 0; w < base.words(); ++w) tile.domains[t][w] &= base[c][w];
    const auto near = whole.neighbors(c);
    for (int s = 0; s < whole.slots; ++s) {
      if (near[s] == whole.cells) continue;
      tile.network.neighbor[static_cast<std::size_t>(t) * whole.slots + s] = tile.tileCell[near[s]];
    }
  }
  return tile;
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
                                                 const Progress& progress) {
  for (std::size_t period = 0; period < kPeriods.size(); ++period) {
    progress.report("finding a tile to begin with",
                    static_cast<double>(period) / static_cast<double>(kPeriods.size()));
    const auto& [px, py] = kPeriods[period];
    if (px > problem.options().size.x || py > problem.options().size.y) continue;
    const Tile tile = tileOf(problem, base, px, py);
    // The tile is a region that nothing surrounds.
    std::vector<std::int32_t> all(static_cast<std::size_t>(tile.network.cells));
    std::iota(all.begin(), all.end(), 0);
    Region region(tile.network, tile.domains);
    if (!region.takeBack(all, std::span<const Label>{}, progress)) continue;
    RegionChoice choice{chooser.numbersFor(LabelChooser::Purpose::Start).fork(period)};
    choice.choose = [&](const Random& random, int c, std::span<const LabelWord> set, int draw) {
      return chooser.choose(random, tile.member[c], set, draw);
    };
    const RegionEffort effort{.passes = 0,
                              .searches = 1,
                              .searchConflicts = 200,
                              .exactConflicts = problem.options().budget};
    const Outcome outcome = region.relabel(effort, choice, progress);
    statistics.exact += region.counts().exact;
    if (outcome != Outcome::Complete) continue;
    std::vector<Label> labels(static_cast<std::size_t>(problem.network().cells));
    for (int c = 0; c < problem.network().cells; ++c) labels[c] = region.label(tile.tileCell[c]);
    // Where a periodic side does not meet its opposite after whole tiles this tile will not do.
    if (consistent(problem.network(), labels)) return labels;
  }
  return std::nullopt;
}

}  // namespace exemplar
