// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/blocks.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "synth/model/catalog.h"
#include "synth/model/exact.h"
#include "synth/model/search.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kAcceptStream = 0x4C424C32;  // whether a modified block is kept

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

class BlockPass {
 public:
  BlockPass(const ModelProblem& problem, const LabelSets& base, const LabelChooser& chooser,
            std::vector<Label> start, ModelStatistics& statistics, const Progress& progress)
      : problem_(problem),
        network_(problem.network()),
        base_(base),
        chooser_(chooser),
        labels_(std::move(start)),
        statistics_(statistics),
        progress_(progress),
        parts_([this] { return NetworkPart(network_); }),
        accept_(problem.options().seed, kAcceptStream) {}

  Labelling run();

 private:
  struct Outcome {
    bool changed = false;
    int exact = 0, contradictions = 0;
  };

  void findBlocks();
  void findLevels();
  bool accepted(int block, int round, const std::vector<Label>& fresh) const;
  Outcome modify(int block, int round, std::vector<Label>& fresh);
  void modifyLevel(const std::vector<int>& blocks, int round);

  const ModelProblem& problem_;
  const LabelNetwork& network_;
  const LabelSets& base_;
  const LabelChooser& chooser_;
  std::vector<Label> labels_;
  ModelStatistics& statistics_;
  const Progress& progress_;
  tbb::enumerable_thread_specific<NetworkPart> parts_;
  Random accept_;

  std::vector<std::vector<std::int32_t>> blocks_;  // cells, ascending
  std::vector<std::vector<int>> levels_;           // blocks that do not touch each other
};

void BlockPass::findBlocks() {
  const ModelOptions& o = problem_.options();
  const auto xs = beginnings(o.size.x, o.block.x, o.periodic[0]);
  const auto ys = beginnings(o.size.y, o.block.y, o.periodic[1]);
  const auto zs = beginnings(o.size.z, o.block.z, o.periodic[2]);
  const int span = std::max({o.block.x, o.block.y, o.block.z});
  const auto ts = beginnings(o.frames, span, o.loop);
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
          order.push_back({color, static_cast<int>(order.size()), {xs[a], ys[b], zs[c]}, ts[d]});
        }
      }
    }
  }
  std::sort(order.begin(), order.end(), [](const At& a, const At& b) {
    return std::pair(a.color, a.order) < std::pair(b.color, b.order);
  });
  const Vec3i size = min(o.block, o.size);
  const int frames = std::min(span, o.frames);
  blocks_.resize(order.size());
  parallelFor(0, order.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const At& at = order[b];
      std::vector<std::int32_t>& cells = blocks_[b];
      cells.reserve(static_cast<std::size_t>(volume(size)) * frames);
      for (int i = 0; i < size.x; ++i) {
        for (int j = 0; j < size.y; ++j) {
          for (int k = 0; k < size.z; ++k) {
            for (int t = 0; t < frames; ++t) {
              Vec3i p = at.corner + Vec3i{i, j, k};
              int frame = at.frame + t;
              bool inside = true;
              for (int axis = 0; axis < 3; ++axis) {
                if (p[axis] < o.size[axis]) continue;
                inside = inside && o.periodic[axis];
                p[axis] -= o.size[axis];
              }
              if (frame >= o.frames) {
                inside = inside && o.loop;
                frame -= o.frames;
              }
              const int c = inside ? problem_.cell(problem_.position(p, frame)) : -1;
              if (c >= 0) cells.push_back(c);
            }
          }
        }
      }
      if (!std::is_sorted(cells.begin(), cells.end())) std::sort(cells.begin(), cells.end());
      cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    }
  });
  std::erase_if(blocks_, [](const auto& cells) { return cells.empty(); });
}

/// A block comes a level after the last earlier block that changes a cell of it or beside it.
void BlockPass::findLevels() {
  std::vector<int> changedAt(network_.cells, -1);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    int level = 0;
    for (const std::int32_t c : blocks_[b]) {
      level = std::max(level, changedAt[c] + 1);
      network_.forEachNeighbor(c, [&](int n, int) { level = std::max(level, changedAt[n] + 1); });
    }
    for (const std::int32_t c : blocks_[b]) changedAt[c] = level;
    if (level >= static_cast<int>(levels_.size())) levels_.resize(level + 1);
    levels_[level].push_back(static_cast<int>(b));
  }
}

/// Metropolis: whether a block's new labels are kept (Merrell 2007, section 4.2).
bool BlockPass::accepted(int block, int round, const std::vector<Label>& fresh) const {
  if (!problem_.options().metropolis) return true;
  double gain = 0;  // log of f(new) / f(old); labels of weight 0 do not occur
  for (std::size_t c = 0; c < fresh.size(); ++c) {
    const std::int32_t cell = blocks_[block][c];
    gain +=
        std::log(problem_.weight(cell, fresh[c])) - std::log(problem_.weight(cell, labels_[cell]));
  }
  return accept_.uniform(static_cast<std::uint64_t>(block), static_cast<std::uint32_t>(round)) <
         std::exp(gain);
}

BlockPass::Outcome BlockPass::modify(int block, int round, std::vector<Label>& fresh) {
  Outcome outcome;
  const auto& cells = blocks_[block];
  const int count = static_cast<int>(cells.size());
  NetworkPart& part = parts_.local();
  part.select(cells);
  LabelSets domains(network_.labels, count);
  for (int c = 0; c < count; ++c) {
    std::copy(base_[cells[c]].begin(), base_[cells[c]].end(), domains[c].begin());
    part.restrictByLabels(c, domains[c], labels_);
  }
  Catalog catalog(part.network());
  for (int c = 0; c < count; ++c) catalog.setDomain(c, domains[c]);
  if (!catalog.propagateAll()) return outcome;  // cannot be: the old labels fit
  for (int c = 0; c < count; ++c) {
    std::copy(catalog.domain(c).begin(), catalog.domain(c).end(), domains[c].begin());
  }

  std::vector<std::int32_t> order(count);
  for (int c = 0; c < count; ++c) order[c] = c;
  // Numbers of draws: the blocks that cover a cell in a round are fewer than 32.
  const std::uint32_t first =
      (static_cast<std::uint32_t>(round) << 24) + (static_cast<std::uint32_t>(block % 32) << 19);
  const LabelChooser::Placed placed = [&](int cell) {
    const int c = part.local(cell);
    if (c < 0) return static_cast<int>(labels_[cell]);
    return catalog.decided(c) ? catalog.firstLabel(c) : -1;
  };
  const auto choose = [&](int c, std::span<const LabelWord> set, int draw) {
    return chooser_.choose(cells[c], set, first + static_cast<std::uint32_t>(draw), placed);
  };
  fresh.resize(count);
  const auto take = [&] {
    for (int c = 0; c < count; ++c) fresh[c] = static_cast<Label>(catalog.firstLabel(c));
    outcome.changed = accepted(block, round, fresh);
  };
  std::int64_t contradictions = 0;
  if (labelInOrder(catalog, order, choose, contradictions)) {
    take();
    outcome.contradictions = static_cast<int>(contradictions);
    return outcome;
  }
  outcome.contradictions = static_cast<int>(contradictions) + 1;
  const auto later = [&](int c, std::span<const LabelWord> set, int draw) {
    return choose(c, set, 4096 + draw);
  };
  for (int c = 0; c < count; ++c) catalog.setDomain(c, domains[c]);
  if (searchLabels(catalog, order, later, 100) == SearchOutcome::Solved) {
    take();
    return outcome;
  }
  ++outcome.exact;
  ExactSolver exact(part.network(), domains);
  for (int c = 0; c < count; ++c) exact.prefer(c, choose(c, domains[c], 8191));
  constexpr std::int64_t kConflicts = 5000;  // the old labels will do as well
  if (exact.solve({}, std::min(kConflicts, problem_.options().budget), progress_) ==
      ExactSolver::Outcome::Solved) {
    for (int c = 0; c < count; ++c) fresh[c] = static_cast<Label>(exact.label(c));
    outcome.changed = accepted(block, round, fresh);
  }
  return outcome;
}

void BlockPass::modifyLevel(const std::vector<int>& blocks, int round) {
  std::vector<Outcome> outcomes(blocks.size());
  parallelFor(0, blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<Label> fresh;
    for (std::size_t i = begin; i < end && !progress_.cancelled(); ++i) {
      outcomes[i] = modify(blocks[i], round, fresh);
      if (!outcomes[i].changed) continue;
      const auto& cells = blocks_[blocks[i]];
      for (std::size_t c = 0; c < cells.size(); ++c) labels_[cells[c]] = fresh[c];
    }
  });
  for (const Outcome& o : outcomes) {
    ++statistics_.blocks;
    statistics_.blocksKept += !o.changed;
    statistics_.exact += o.exact;
    statistics_.contradictions += o.contradictions;
  }
}

Labelling BlockPass::run() {
  findBlocks();
  findLevels();
  const double steps = static_cast<double>(levels_.size()) * problem_.options().rounds;
  double done = 0;
  for (int round = 0; round < problem_.options().rounds; ++round) {
    for (const auto& level : levels_) {
      progress_.report("labelling blocks", done++ / steps);
      modifyLevel(level, round);
      if (progress_.cancelled()) return {ModelStatus::Cancelled, {}};
    }
  }
  return {ModelStatus::Complete, std::move(labels_)};
}

}  // namespace

Labelling labelInBlocks(const ModelProblem& problem, const LabelSets& base,
                        const LabelChooser& chooser, std::vector<Label> start,
                        ModelStatistics& statistics, const Progress& progress) {
  return BlockPass(problem, base, chooser, std::move(start), statistics, progress).run();
}

}  // namespace exemplar
