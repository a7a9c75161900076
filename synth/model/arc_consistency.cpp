// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/arc_consistency.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>
#include <numeric>
#include <vector>

#include "core/parallel.h"
#include "synth/model/catalog.h"
#include "synth/model/tile.h"

namespace exemplar {
namespace {

constexpr int kPiece = 8192;  // cells propagated by themselves

bool propagatePieces(const LabelNetwork& network, LabelSets& base, const Progress& progress) {
  const int pieces = (network.cells + kPiece - 1) / kPiece;
  std::atomic<bool> possible{true};
  tbb::enumerable_thread_specific<NetworkPart> parts([&] { return NetworkPart(network); });
  parallelFor(0, static_cast<std::size_t>(pieces), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> cells;
    for (std::size_t piece = begin; piece < end && possible; ++piece) {
      const int first = static_cast<int>(piece) * kPiece;
      cells.resize(std::min(kPiece, network.cells - first));
      std::iota(cells.begin(), cells.end(), first);
      NetworkPart& part = parts.local();
      part.select(cells);
      Catalog catalog(part.network());
      for (std::size_t c = 0; c < cells.size(); ++c)
        catalog.setDomain(static_cast<int>(c), base[cells[c]]);
      if (!catalog.propagateAll(progress)) {
        possible = false;
        continue;
      }
      for (std::size_t c = 0; c < cells.size(); ++c)
        std::ranges::copy(catalog.domain(static_cast<int>(c)), base[cells[c]].begin());
    }
  });
  return possible;
}

/// Propagates the sets of cells that have changed, column by column, to and fro.
class Sweeps {
 public:
  Sweeps(const LabelNetwork& network, LabelSets& base, int column)
      : network_(network),
        base_(base),
        column_(column),
        waits_(static_cast<std::size_t>(network.cells), 0),
        columnWaits_(static_cast<std::size_t>(network.cells / column + 1), 0),
        missing_(static_cast<std::size_t>(base.words())) {}

  /// Takes from the set at the far end of a link what `cell` does not support; false where nothing
  /// is left.
  bool across(int cell, int far, int relation) {
    if (!keepSupported(base_[far], base_[cell], network_.support[relation])) return true;
    if (!waits_[far]) {
      waits_[far] = 1;
      if (far / column_ == settling_) {
        queue_.push_back(far);
      } else {
        columnWaits_[far / column_] = 1;
      }
    }
    return labelsIn(base_[far]) > 0;
  }
  /// False where a set is emptied.
  bool run(const Progress& progress) {
    const int count = static_cast<int>(columnWaits_.size());
    bool any = true;
    for (bool forward = true; any; forward = !forward) {
      any = false;
      for (int i = 0; i < count; ++i) {
        if (i % 4096 == 0) progress.check();
        const int g = forward ? i : count - 1 - i;
        if (!columnWaits_[g]) continue;
        any = true;
        columnWaits_[g] = 0;
        if (!settle(g)) return false;
      }
    }
    return true;
  }

 private:
  bool settle(int column) {
    queue_.clear();
    settling_ = column;
    const int first = column * column_, last = std::min(first + column_, network_.cells);
    for (int c = first; c < last; ++c)
      if (waits_[c]) queue_.push_back(c);
    bool possible = true;
    for (std::size_t at = 0; at < queue_.size() && possible; ++at) {
      const int c = queue_[at];
      waits_[c] = 0;
      network_.forEachNeighbor(
          c, [&](int n, int relation) { possible = possible && across(c, n, relation); });
    }
    settling_ = -1;
    return possible;
  }

  /// Keeps in `set` what `far` supports through `table`; false where that is all of it, which is
  /// mostly found out after one or two rows.
  bool keepSupported(std::span<LabelWord> set, std::span<const LabelWord> far,
                     const LabelSets& table) {
    std::ranges::copy(set, missing_.begin());
    for (std::size_t v = 0; v < far.size(); ++v) {
      for (LabelWord rest = far[v]; rest; rest &= rest - 1) {
        const auto row = table[v * 64 + static_cast<std::size_t>(std::countr_zero(rest))];
        LabelWord any = 0;
        for (std::size_t w = 0; w < set.size(); ++w) any |= missing_[w] &= ~row[w];
        if (any == 0) return false;
      }
    }
    for (std::size_t w = 0; w < set.size(); ++w) set[w] &= ~missing_[w];
    return true;
  }

  const LabelNetwork& network_;
  LabelSets& base_;
  const int column_;
  int settling_ = -1;  // the column whose cells go on the queue
  std::vector<std::uint8_t> waits_, columnWaits_;
  std::vector<std::int32_t> queue_;
  std::vector<LabelWord> missing_;
};

/// Columns along each side that stand for themselves where sets are found for a large result.
constexpr int kRim = 48;

}  // namespace

bool makeConsistentByTile(const ModelProblem& problem, LabelSets& base, const Progress& progress) {
  Tile tile(problem, {kRim, {1, 1, 1}});
  if (!tile.findCells(base, std::numeric_limits<std::int64_t>::max(), progress)) return false;
  tile.findNeighbors();
  const LabelNetwork& network = tile.network();
  Catalog catalog(network);
  for (int c = 0; c < network.cells; ++c) catalog.setDomain(c, tile.domains()[c]);
  if (!catalog.propagateAll(progress)) return false;
  tile.forEach([&](int cell, int key) {
    std::ranges::copy(catalog.domain(tile.cellOf(key)), base[cell].begin());
  });
  return true;
}

bool makeArcConsistent(const LabelNetwork& network, LabelSets& base, int column,
                       const Progress& progress) {
  if (!propagatePieces(network, base, progress)) return false;
  if (network.cells <= kPiece) return true;
  Sweeps sweeps(network, base, column);
  // Within pieces nothing is at fault.
  for (int c = 0; c < network.cells; ++c) {
    if (c % kPiece == 0) progress.check();
    bool possible = true;
    network.forEachNeighbor(c, [&](int n, int relation) {
      if (n / kPiece != c / kPiece) possible = possible && sweeps.across(c, n, relation);
    });
    if (!possible) return false;
  }
  return sweeps.run(progress);
}

}  // namespace exemplar
