// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/start.h"

#include <array>
#include <utility>

#include "synth/model/catalog.h"
#include "synth/model/exact.h"
#include "synth/model/search.h"

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
  for (const auto& [px, py] : kPeriods) {
    if (progress.cancelled()) break;
    if (px > problem.options().size.x || py > problem.options().size.y) continue;
    const Tile tile = tileOf(problem, base, px, py);
    Catalog catalog(tile.network);
    for (int c = 0; c < tile.network.cells; ++c) catalog.setDomain(c, tile.domains[c]);
    if (!catalog.propagateAll()) continue;
    LabelSets left(tile.network.labels, tile.network.cells);
    std::vector<std::int32_t> order(tile.network.cells);
    for (int c = 0; c < tile.network.cells; ++c) {
      std::copy(catalog.domain(c).begin(), catalog.domain(c).end(), left[c].begin());
      order[c] = c;
    }
    std::vector<Label> found(tile.network.cells);
    const auto choose = [&](int c, std::span<const LabelWord> labels, int draw) {
      return chooser.choose(tile.member[c], labels, 0x40000000u + static_cast<unsigned>(draw));
    };
    const SearchOutcome outcome = searchLabels(catalog, order, choose, 200);
    if (outcome == SearchOutcome::Impossible) continue;
    if (outcome == SearchOutcome::Solved) {
      for (int c = 0; c < tile.network.cells; ++c) {
        found[c] = static_cast<Label>(catalog.firstLabel(c));
      }
    } else {
      ++statistics.exact;
      ExactSolver exact(tile.network, left);
      for (int c = 0; c < tile.network.cells; ++c) exact.prefer(c, choose(c, left[c], 1 << 20));
      if (exact.solve({}, problem.options().budget, progress) != ExactSolver::Outcome::Solved) {
        continue;
      }
      for (int c = 0; c < tile.network.cells; ++c) found[c] = static_cast<Label>(exact.label(c));
    }
    std::vector<Label> labels(problem.network().cells);
    for (int c = 0; c < problem.network().cells; ++c) labels[c] = found[tile.tileCell[c]];
    // Where a periodic side meets its opposite out of step the tile does not do.
    if (consistent(problem.network(), labels)) return labels;
  }
  return std::nullopt;
}

}  // namespace exemplar
