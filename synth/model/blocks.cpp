// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/blocks.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/random.h"
#include "synth/model/region.h"

namespace exemplar {
namespace {

/// Where blocks begin along an axis: every half block, until one reaches the end.
std::vector<int> beginnings(int n, int block, bool periodic) {
  std::vector<int> list{0};
  if (block >= n) return list;
  const int half = std::max(1, block / 2);
  while (periodic ? list.back() + half < n : list.back() + block < n) {
    list.push_back(list.back() + half);
  }
  return list;
}

/// Whether a block, by its number among the beginnings along each axis, is one of those that begin
/// at a whole block everywhere, or between two everywhere: together they take each cell twice, and
/// the sides of one kind lie within the other. The last one along an axis belongs to both.
bool alternate(const std::array<std::pair<std::size_t, std::size_t>, 4>& numbers) {
  bool whole = true, between = true;
  for (const auto& [number, count] : numbers) {
    if (number + 1 == count) continue;
    whole = whole && number % 2 == 0;
    between = between && number % 2 == 1;
  }
  return whole || between;
}

class BlockPass {
 public:
  BlockPass(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
            std::vector<Label> start, bool sparse, ModelStatistics& statistics,
            const Progress& progress)
      : problem_(problem),
        sparse_(sparse),
        network_(problem.network()),
        base_(base),
        chooser_(chooser),
        labels_(std::move(start)),
        statistics_(statistics),
        progress_(progress),
        span_(std::max(
            {problem.options().block.x, problem.options().block.y, problem.options().block.z})),
        regions_([this] { return Region(network_, base_); }),
        accept_(problem.options().seed, stream::kBlockAccept) {}

  Labeling run();

 private:
  struct Block {
    Vec3i corner;
    int frame;
  };
  struct Change {
    bool made = false;
    std::int64_t exact = 0, contradictions = 0;
  };

  void findBlocks();
  void findLevels();
  /// The cells of a block grown by so many, ascending. They are not kept: each cell is in eight
  /// blocks.
  std::vector<std::int32_t> cellsOf(const Block& block, int grown = 0) const;
  bool accepted(const Region& region, int block, int round) const;
  Change modify(int block, int round);
  void modifyLevel(const std::vector<int>& blocks, int round);

  const ModelProblem& problem_;
  bool sparse_;
  const LabelNetwork& network_;
  const LabelSets& base_;
  const LabelChooser& chooser_;
  std::vector<Label> labels_;
  ModelStatistics& statistics_;
  const Progress& progress_;
  int span_;  // of a block, frames
  tbb::enumerable_thread_specific<Region> regions_;
  Random accept_;

  std::vector<Block> blocks_;
  std::vector<std::vector<int>> levels_;  // blocks that do not touch each other
};

void BlockPass::findBlocks() {
  const ModelOptions& o = problem_.options();
  const auto xs = beginnings(o.size.x, o.block.x, o.periodic.x);
  const auto ys = beginnings(o.size.y, o.block.y, o.periodic.y);
  const auto zs = beginnings(o.size.z, o.block.z, o.periodic.z);
  const auto ts = beginnings(o.frames, span_, o.loop);
  // Every third block along an axis first, then the ones next to these: few levels.
  struct At {
    int color, order;
    Vec3i corner;
    int frame;
  };
  std::vector<At> order;
  for (std::size_t a = 0; a < xs.size(); ++a) {
    for (std::size_t b = 0; b < ys.size(); ++b) {
      for (std::size_t c = 0; c < zs.size(); ++c) {
        for (std::size_t d = 0; d < ts.size(); ++d) {
          const int color = static_cast<int>(((a % 3 * 3 + b % 3) * 3 + c % 3) * 3 + d % 3);
          const bool taken =
              !sparse_ ||
              alternate({{{a, xs.size()}, {b, ys.size()}, {c, zs.size()}, {d, ts.size()}}});
          if (!taken) continue;
          order.push_back({color, static_cast<int>(order.size()), {xs[a], ys[b], zs[c]}, ts[d]});
        }
      }
    }
  }
  std::sort(order.begin(), order.end(), [](const At& a, const At& b) {
    return std::pair(a.color, a.order) < std::pair(b.color, b.order);
  });
  for (const At& at : order) blocks_.push_back({at.corner, at.frame});
}

std::vector<std::int32_t> BlockPass::cellsOf(const Block& block, int grown) const {
  const ModelOptions& o = problem_.options();
  const CellBox box{block.corner, block.corner + min(o.block, o.size)};
  return problem_.cellsIn(box.grown(grown), block.frame, block.frame + span_);
}

/// A block comes a level after the last earlier block that changes a cell of it, beside it, or that
/// it looks at.
void BlockPass::findLevels() {
  const bool seesDiagonals = problem_.options().choice == LabelChoice::Resemblance;
  std::vector<int> changedAt(network_.cells, -1);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (b % 256 == 0) progress_.check();
    int level = 0;
    const auto after = [&](int c) { level = std::max(level, changedAt[c] + 1); };
    const std::vector<std::int32_t> cells = cellsOf(blocks_[b]);
    if (cells.empty()) continue;
    for (const std::int32_t c : cells) {
      after(c);
      network_.forEachNeighbor(c, [&](int n, int) { after(n); });
      // A cell that has images looks around the first of them.
      if (!seesDiagonals || !problem_.options().symmetry.any()) continue;
      for (const std::int32_t seen : problem_.cellsAround(c, 1)) after(seen);
    }
    if (seesDiagonals) {
      for (const std::int32_t c : cellsOf(blocks_[b], 1)) after(c);
    }
    for (const std::int32_t c : cells) changedAt[c] = level;
    if (level >= static_cast<int>(levels_.size())) levels_.resize(level + 1);
    levels_[level].push_back(static_cast<int>(b));
  }
}

/// Metropolis: whether a block's new labels are kept (Merrell 2007, section 4.2).
bool BlockPass::accepted(const Region& region, int block, int round) const {
  if (!problem_.options().metropolis) return true;
  double gain = 0;  // log of f(new) / f(old); labels of weight 0 do not occur
  for (int i = 0; i < region.count(); ++i) {
    const std::int32_t cell = region.cells()[i];
    gain += std::log(problem_.weight(cell, region.label(i))) -
            std::log(problem_.weight(cell, labels_[cell]));
  }
  return accept_.uniform(static_cast<std::uint64_t>(block), static_cast<std::uint32_t>(round)) <
         std::exp(gain);
}

/// Relabels a block; `labels_` changes where that succeeds and is accepted.
BlockPass::Change BlockPass::modify(int block, int round) {
  Change change;
  Region& region = regions_.local();
  const Region::Counts before = region.counts();
  if (!region.takeBack(cellsOf(blocks_[block]), labels_, progress_))
    return change;  // cannot be: the old fit
  const std::uint64_t number = static_cast<std::uint64_t>(round) * blocks_.size() + block;
  RegionChoice choice{chooser_.numbersFor(LabelChooser::Purpose::Blocks).fork(number)};
  choice.choose = [&](const Random& random, int c, std::span<const LabelWord> set, int draw) {
    return chooser_.choose(random, c, set, draw, region.placed());
  };
  // Not more than this: the old labels will do as well. The exact solver, which takes a hundred
  // times as long as a pass, would set few more of them free.
  const RegionEffort effort{.passes = 1, .searches = 1, .searchConflicts = 30, .exactConflicts = 0};
  if (region.relabel(effort, choice, progress_) == Outcome::Complete &&
      accepted(region, block, round)) {
    region.keep(labels_);
    change.made = true;
  }
  change.exact = region.counts().exact - before.exact;
  change.contradictions = region.counts().contradictions - before.contradictions;
  return change;
}

void BlockPass::modifyLevel(const std::vector<int>& blocks, int round) {
  std::vector<Change> changes(blocks.size());
  parallelFor(0, blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) changes[i] = modify(blocks[i], round);
  });
  for (const Change& change : changes) {
    ++statistics_.blocks;
    statistics_.blocksKept += !change.made;
    statistics_.exact += change.exact;
    statistics_.contradictions += change.contradictions;
  }
}

Labeling BlockPass::run() {
  findBlocks();
  findLevels();
  const double steps = static_cast<double>(levels_.size()) * problem_.options().rounds;
  double done = 0;
  for (int round = 0; round < problem_.options().rounds; ++round) {
    for (const auto& level : levels_) {
      progress_.report("labeling blocks", done++ / steps);
      modifyLevel(level, round);
    }
  }
  return {Outcome::Complete, std::move(labels_)};
}

}  // namespace

Labeling labelInBlocks(const ModelProblem& problem, const LabelSets& base,
                       const LabelChooser& chooser, std::vector<Label> start, bool sparse,
                       ModelStatistics& statistics, const Progress& progress) {
  return BlockPass(problem, base, chooser, std::move(start), sparse, statistics, progress).run();
}

}  // namespace exemplar
