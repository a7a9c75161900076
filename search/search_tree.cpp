// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/search_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"

namespace exemplar {

// A path's cells in order: the whole block, its 8 octants, their 64, ... The children of cell t are
// cells 8t + 1 to 8t + 8, and level l (from 0) starts at (8^l - 1) / 7.
struct SearchTree::Path {
  // For blocks of 2^levels samples of scale `finest` a side, in arrays of `size`.
  Path(int levels, int finest, const Vec3i& size) {
    std::vector<Vec3i> firsts{{0, 0, 0}};
    for (int level = 0; level <= levels; ++level) {
      const int scale = finest + levels - level;
      starts.push_back(static_cast<std::uint32_t>(offsets.size()));
      std::vector<Vec3i> next;
      for (const Vec3i& p : firsts) {
        offsets.push_back(static_cast<std::uint32_t>(
            (static_cast<std::size_t>(p.z) * size.y + p.y) * size.x + p.x));
        const int half = (1 << scale) / 2;
        for (int c = 0; c < 8; ++c)
          next.push_back({p.x + (c & 1) * half, p.y + (c >> 1 & 1) * half, p.z + (c >> 2) * half});
      }
      firsts = std::move(next);
    }
    starts.push_back(static_cast<std::uint32_t>(offsets.size()));
  }
  int levels() const { return static_cast<int>(starts.size()) - 2; }
  std::uint32_t cells() const { return starts.back(); }
  int levelOf(std::uint32_t cell) const {
    return (static_cast<int>(std::bit_width(7 * std::uint64_t{cell} + 1)) - 1) / 3;
  }

  std::vector<std::uint32_t> offsets;  // of each cell's first sample from the block's
  std::vector<std::uint32_t> starts;   // of each level, and the end
};

struct SearchTree::Deviations {
  std::once_flag once;
  std::vector<double> byScale;
};

// Sorts the blocks by their paths and makes a node wherever paths part.
class TreeBuilder {
 public:
  TreeBuilder(SearchTree& tree, const Progress& progress)
      : tree_(tree), progress_(progress), source_(tree.pyramid_->averages(0)), path_(*tree.path_) {}

  void build() {
    nameBlocks();
    const Vec3i positions = blockPositions(source_.size(), cube(tree_.blockSize_));
    auto& order = tree_.order_;
    order.reserve(static_cast<std::size_t>(volume(positions)));
    forEachCell(positions, [&](const Vec3i& p) {
      order.push_back(static_cast<std::uint32_t>(source_.index(p)));
    });
    scratch_.resize(order.size());
    // The root holds all blocks and shares no cell.
    tree_.nodes_.push_back({0, static_cast<std::uint32_t>(order.size()), 0, 0, 0, 0});
    // Nodes are finished in the order in which they were made: no recursion.
    for (std::size_t n = 0; n < tree_.nodes_.size(); ++n) {
      progress_.check();
      finish(n);
    }
  }

  static Vec3i cube(int side) { return {side, side, side}; }

 private:
  // Gives equal blocks equal names, by naming cubes of 1, 2, 4, ... samples from the names of their
  // eight parts (Karp, Miller, Rosenberg 1972): the lowest index at which such a cube is found.
  // Exact.
  void nameBlocks() {
    const Vec3i size = source_.size();
    names_.resize(source_.count());
    for (std::size_t i = 0; i < names_.size(); ++i) names_[i] = source_.data()[i];
    std::vector<std::uint32_t> table;
    for (int side = 2; side <= tree_.blockSize_; side *= 2) {
      const std::size_t h = side / 2, hy = h * size.x, hz = hy * size.y;
      const std::array<std::size_t, 8> parts{0, h, hy, hy + h, hz, hz + h, hz + hy, hz + hy + h};
      const Vec3i positions = size - cube(side - 1);
      table.assign(std::bit_ceil(static_cast<std::size_t>(volume(positions)) * 2), kFree);
      std::vector<std::uint32_t> named(names_.size());
      for (int k = 0; k < positions.z; ++k)
        for (int j = 0; j < positions.y; ++j) {
          progress_.check();
          for (int i = 0; i < positions.x; ++i) {
            const std::size_t at = source_.index(i, j, k);
            std::uint64_t hash = 0;
            for (std::size_t p : parts)
              hash = (hash ^ names_[at + p]) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
            std::size_t slot = hash & (table.size() - 1);
            while (table[slot] != kFree && !std::ranges::all_of(parts, [&](std::size_t p) {
                     return names_[table[slot] + p] == names_[at + p];
                   }))
              slot = (slot + 1) & (table.size() - 1);
            if (table[slot] == kFree) table[slot] = static_cast<std::uint32_t>(at);
            named[at] = table[slot];
          }
        }
      names_ = std::move(named);
    }
  }

  std::uint8_t value(std::uint32_t position, std::uint32_t cell, int level) const {
    return tree_.pyramid_->averages(path_.levels() - level).data()[position + path_.offsets[cell]];
  }

  void finish(std::size_t n) {
    // A copy: adding children moves the nodes.
    SearchTree::Node node = tree_.nodes_[n];
    const auto begin = tree_.order_.begin() + node.begin, end = begin + node.count;
    node.lowest = *std::min_element(begin, end);
    if (std::all_of(begin, end, [&](std::uint32_t p) { return names_[p] == names_[*begin]; })) {
      node.prefix = path_.cells();
      tree_.nodes_[n] = node;
      return;
    }
    const auto agree = [&](std::uint32_t cell, int level) {
      const std::uint8_t first = value(*begin, cell, level);
      return std::all_of(begin, end,
                         [&](std::uint32_t p) { return value(p, cell, level) == first; });
    };
    int level = path_.levelOf(node.prefix);
    while (agree(node.prefix, level)) level = path_.levelOf(++node.prefix);

    std::array<std::uint32_t, 257> starts{};
    for (auto p = begin; p != end; ++p) ++starts[value(*p, node.prefix, level) + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::array<std::uint32_t, 256> next;
    std::copy_n(starts.begin(), 256, next.begin());
    for (auto p = begin; p != end; ++p) scratch_[next[value(*p, node.prefix, level)]++] = *p;
    std::copy_n(scratch_.begin(), node.count, begin);

    node.firstChild = static_cast<std::uint32_t>(tree_.nodes_.size());
    for (int v = 0; v < 256; ++v)
      if (const std::uint32_t count = starts[v + 1] - starts[v]) {
        tree_.nodes_.push_back({node.begin + starts[v], count, 0, 0, node.prefix + 1, 0});
        ++node.children;
      }
    tree_.nodes_[n] = node;
  }

  static constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

  SearchTree& tree_;
  const Progress& progress_;
  const Array3D<std::uint8_t>& source_;
  const SearchTree::Path& path_;
  std::vector<std::uint32_t> names_, scratch_;
};

SearchTree::SearchTree(Array3D<std::uint8_t> source, int blockSize, const Progress& progress)
    : blockSize_(blockSize) {
  progress.report("building the search tree", 0);
  blockLevels(blockSize);
  const auto blocks = volume(blockPositions(source.size(), TreeBuilder::cube(blockSize)));
  requireMemory(static_cast<double>(source.count()) * 30 + static_cast<double>(blocks) * 45,
                "the search tree of " + std::to_string(blocks) + " blocks",
                "use a smaller example or resolution");
  pyramid_ = std::make_shared<const SlidingPyramid>(std::move(source), blockSize);
  const auto [low, high] = std::ranges::minmax(pyramid_->averages(0).values());
  low_ = low;
  high_ = high;
  path_ = std::make_shared<const Path>(blockLevels(blockSize), 0, pyramid_->averages(0).size());
  deviations_ = std::make_shared<Deviations>();
  TreeBuilder(*this, progress).build();
}

SearchTree SearchTree::dropLeaves(int levels) const {
  if (levels < 0 || (blockSize_ >> levels) < 1)
    throw InputError("a search tree for blocks of " + std::to_string(blockSize_) +
                     " samples has no " + std::to_string(levels) + " levels to drop");
  SearchTree tree;
  tree.blockSize_ = blockSize_ >> levels;
  tree.dropped_ = dropped_ + levels;
  tree.pyramid_ = pyramid_;
  tree.order_ = order_;
  tree.low_ = low_;  // averages lie between the samples they are made of
  tree.high_ = high_;
  tree.path_ = std::make_shared<const Path>(blockLevels(tree.blockSize_), tree.dropped_,
                                            pyramid_->averages(0).size());
  tree.deviations_ = std::make_shared<Deviations>();
  const std::uint32_t cells = tree.path_->cells();
  tree.nodes_.push_back(nodes_[0]);
  for (std::size_t n = 0; n < tree.nodes_.size(); ++n) {
    Node node = tree.nodes_[n];
    if (node.prefix >= cells) {
      node.prefix = cells;
      node.children = 0;
    }
    const std::uint32_t first = node.firstChild;
    node.firstChild = static_cast<std::uint32_t>(tree.nodes_.size());
    for (std::uint32_t c = 0; c < node.children; ++c) tree.nodes_.push_back(nodes_[first + c]);
    tree.nodes_[n] = node;
  }
  return tree;
}

std::int64_t SearchTree::bytes() const {
  return static_cast<std::int64_t>(nodes_.size() * sizeof(Node) +
                                   order_.size() * sizeof(std::uint32_t));
}

// One search. Sums of squared differences are integers scaled by 2^15, so that the bounds of whole
// cells up to 32³ are exact and every bound is safe without thought about rounding.
class TreeSearch {
 public:
  TreeSearch(const SearchTree& tree, const BlockQuery<std::uint8_t>& query,
             const TreeSearchOptions& options)
      : tree_(tree), options_(options), path_(*tree.path_), low_(tree.low_), high_(tree.high_) {
    known_ = knownSamples(query);
    describe(query);
  }

  std::vector<double> boundsAlongPath(const Vec3i& position) {
    const auto index = static_cast<std::uint32_t>(tree_.pyramid_->averages(0).index(position));
    const auto holds = [&](const SearchTree::Node& node) {
      const auto first = tree_.order_.begin() + node.begin;
      return std::find(first, first + node.count, index) != first + node.count;
    };
    std::vector<double> bounds;
    Entry entry{0, 0, 0, 0};
    while (entry.cells < path_.cells()) {
      const SearchTree::Node& node = tree_.nodes_[entry.node];
      std::uint32_t next = entry.node;
      if (entry.cells >= node.prefix)
        for (next = node.firstChild; !holds(tree_.nodes_[next]);) ++next;
      queue_.clear();
      advance(entry, next);
      entry = queue_.front();
      bounds.push_back(known_ == 0 ? 0
                                   : std::ldexp(static_cast<double>(entry.bound), -kFraction) /
                                         static_cast<double>(known_));
    }
    return bounds;
  }

  BlockMatch run(TreeSearchStatistics& statistics) {
    const auto& nodes = tree_.nodes_;
    push({0, 0, 0, 0});
    while (!queue_.empty()) {
      std::ranges::pop_heap(queue_, later_);
      const Entry entry = queue_.back();
      queue_.pop_back();
      const SearchTree::Node& node = nodes[entry.node];
      if (entry.bound > std::min(best_, upper_)) break;
      if (entry.bound == best_ && node.lowest > bestPosition_) continue;
      ++statistics_.visitedNodes;
      if (entry.cells == path_.cells()) {
        const std::uint32_t position = lowestAllowed(node);
        if (std::pair(entry.bound, position) < std::pair(best_, bestPosition_) &&
            position != kNone) {
          best_ = entry.bound;
          bestPosition_ = position;
        }
      } else if (entry.cells < node.prefix) {
        advance(entry, entry.node);
      } else {
        for (std::uint32_t c = 0; c < node.children; ++c) advance(entry, node.firstChild + c);
      }
    }
    statistics = statistics_;
    BlockMatch match;
    if (bestPosition_ == kNone) return match;
    match.position = tree_.pyramid_->averages(0).ijk(bestPosition_);
    match.distance =
        known_ == 0 ? 0 : static_cast<double>(best_ >> kFraction) / static_cast<double>(known_);
    return match;
  }

 private:
  static constexpr int kFraction = 15;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::int64_t kInfinite = std::numeric_limits<std::int64_t>::max();

  // What the query says about one cell of the path.
  struct Cell {
    std::int64_t sum = 0;    // of its known samples
    std::int32_t known = 0;  // how many there are
    double deviation = 0;    // of its samples, where all are known
    double farthest = 0;     // largest possible sum of squared differences, where not all are known
  };
  struct Entry {
    std::int64_t bound;  // no block below has a smaller sum
    std::int64_t sum;    // of the contributions of the finest cells compared so far
    std::uint32_t node;
    std::uint32_t
        cells;  // compared so far; in the middle of a group of eight its part is not in `sum`
  };

  void describe(const BlockQuery<std::uint8_t>& query) {
    cells_.resize(path_.cells());
    const int side = tree_.blockSize_, levels = path_.levels();
    std::vector<double> squares(options_.pruning == QueuePruning::None ? 0 : cells_.size());
    // The finest cells, in path order.
    for (std::uint32_t t = path_.starts[levels]; t < path_.cells(); ++t) {
      const std::uint32_t c = t - path_.starts[levels];
      Vec3i p{};
      for (int bit = 0; bit < levels; ++bit) {
        p.x |= static_cast<int>(c >> (3 * bit) & 1) << bit;
        p.y |= static_cast<int>(c >> (3 * bit + 1) & 1) << bit;
        p.z |= static_cast<int>(c >> (3 * bit + 2) & 1) << bit;
      }
      const std::size_t at = (static_cast<std::size_t>(p.z) * side + p.y) * side + p.x;
      if (!query.known.empty() && query.known.data()[at] == 0) continue;
      const int q = query.samples.data()[at];
      const int far = std::max(std::abs(q - low_), std::abs(q - high_));
      cells_[t] = {q, 1, 0, static_cast<double>(far * far)};
      if (!squares.empty()) squares[t] = static_cast<double>(q * q);
    }
    for (std::uint32_t t = path_.starts[levels]; t-- > 0;)
      for (std::uint32_t c = 8 * t + 1; c <= 8 * t + 8; ++c) {
        cells_[t].sum += cells_[c].sum;
        cells_[t].known += cells_[c].known;
        cells_[t].farthest += cells_[c].farthest;
        if (!squares.empty()) squares[t] += squares[c];
      }
    for (std::uint32_t t = 0; t < squares.size(); ++t)
      if (const double n = cells_[t].known; n > 0) {
        const double mean = static_cast<double>(cells_[t].sum) / n;
        cells_[t].deviation = std::sqrt(std::max(0.0, squares[t] / n - mean * mean)) + 1e-6;
      }
    if (options_.pruning == QueuePruning::Measured) {
      std::call_once(tree_.deviations_->once, [&] {
        tree_.deviations_->byScale = tree_.pyramid_->cellDeviations(tree_.dropped_);
      });
    }
  }

  // No block whose cell `t` has this average can have a smaller sum over the cell's known samples.
  std::int64_t contribution(std::uint32_t t, int level, int average) const {
    const Cell& cell = cells_[t];
    if (cell.known == 0) return 0;
    const int scale = path_.levels() - level;  // above the finest
    SumRange range = cellSums(average, scale + tree_.dropped_, tree_.dropped_);
    const std::int64_t unknown = (std::int64_t{1} << (3 * scale)) - cell.known;
    if (unknown > 0) {
      // The unknown samples may take any share that their number and the source's values leave
      // open.
      range.low =
          std::max<std::int64_t>(range.low - unknown * high_, std::int64_t{cell.known} * low_);
      range.high =
          std::min<std::int64_t>(range.high - unknown * low_, std::int64_t{cell.known} * high_);
    }
    const std::int64_t gap =
        std::max({std::int64_t{0}, cell.sum - range.high, range.low - cell.sum});
    if (unknown == 0) {
      const int shift = kFraction - 3 * scale;
      return shift >= 0 ? gap * gap << shift : gap * gap >> -shift;
    }
    const std::int64_t square = gap * gap, n = cell.known;
    return (square / n << kFraction) + (square % n << kFraction) / n;
  }

  std::uint8_t average(std::uint32_t position, std::uint32_t t, int level) const {
    return tree_.pyramid_->averages(path_.levels() - level + tree_.dropped_)
        .data()[position + path_.offsets[t]];
  }

  // Compares more cells of `node`, which is the entry's node or a child of it, up to where its
  // blocks part or the level ends, and queues the outcome.
  void advance(const Entry& from, std::uint32_t index) {
    const SearchTree::Node& node = tree_.nodes_[index];
    const std::uint32_t position = tree_.order_[node.begin];
    Entry entry{from.bound, from.sum, index, from.cells};
    const int level = path_.levelOf(from.cells);
    const std::uint32_t end = std::min(node.prefix, path_.starts[level + 1]);
    if (level == 0) {
      entry.sum = contribution(0, 0, average(position, 0, 0));
      ++statistics_.comparedCells;
      entry.cells = 1;
      entry.bound = std::max(entry.bound, entry.sum);
    } else {
      // From the beginning of the group that `from` may be in the middle of.
      for (std::uint32_t parent = (from.cells - 1) / 8; 8 * parent + 1 < end; ++parent) {
        const std::uint32_t first = 8 * parent + 1, last = std::min(first + 8, end);
        std::int64_t parts = 0;
        for (std::uint32_t t = first; t < last; ++t)
          parts += contribution(t, level, average(position, t, level));
        statistics_.comparedCells += last - first;
        const std::int64_t change =
            parts - contribution(parent, level - 1, average(position, parent, level - 1));
        // Each state of the sum is a lower bound; the largest holds. (Rounded averages can make a
        // finer one smaller.) A part of a group counts where it already exceeds the whole of the
        // parent.
        entry.bound = std::max(entry.bound, entry.sum + std::max<std::int64_t>(change, 0));
        if (last == first + 8) entry.sum += change;
        if (entry.bound > std::min(best_, upper_)) return;
      }
      entry.cells = end;
    }
    // The last sum is the distance itself, and no bound exceeds it.
    if (entry.cells == path_.cells()) entry.bound = entry.sum;
    if (options_.pruning != QueuePruning::None && options_.positionStride == 1 &&
        entry.cells == path_.starts[level + 1])
      prune(position, level);
    push(entry);
  }

  // Lowers the upper bound by equation 3: some block below has at most this distance.
  void prune(std::uint32_t position, int level) {
    const int scale = path_.levels() - level;
    const double n = static_cast<double>(std::int64_t{1} << (3 * scale));
    const double lipschitz = lipschitzEpsilon(1 << scale, options_.lipschitz);
    double total = 0;
    for (std::uint32_t t = path_.starts[level]; t < path_.starts[level + 1]; ++t) {
      const Cell& cell = cells_[t];
      if (cell.known == 0) continue;
      if (cell.known < static_cast<std::int32_t>(n)) {
        total += cell.farthest;
        continue;
      }
      const SumRange range =
          cellSums(average(position, t, level), scale + tree_.dropped_, tree_.dropped_);
      const auto far = static_cast<double>(std::max(cell.sum - range.low, range.high - cell.sum));
      double epsilon = lipschitz;
      if (options_.pruning == QueuePruning::Measured) {
        const double s =
            scale == 0 ? 0 : cell.deviation + tree_.deviations_->byScale[scale + tree_.dropped_];
        epsilon = s * s;
      }
      total += std::min(cell.farthest, far * far / n + epsilon * n);
    }
    const auto bound =
        static_cast<std::int64_t>(std::ceil(std::ldexp(total * (1 + 1e-9), kFraction))) + 1;
    upper_ = std::min(upper_, bound);
  }

  void push(const Entry& entry) {
    if (entry.bound > upper_) {
      ++statistics_.prunedEntries;
      return;
    }
    if (entry.bound > best_) return;
    queue_.push_back(entry);
    std::ranges::push_heap(queue_, later_);
    if (options_.pruning != QueuePruning::None && queue_.size() > keep_) {
      const std::size_t before = queue_.size();
      std::erase_if(queue_, [&](const Entry& e) { return e.bound > upper_; });
      std::ranges::make_heap(queue_, later_);
      statistics_.prunedEntries += static_cast<std::int64_t>(before - queue_.size());
      keep_ = std::max<std::size_t>(1024, 2 * queue_.size());
    }
    statistics_.largestQueue =
        std::max(statistics_.largestQueue, static_cast<std::int64_t>(queue_.size()));
  }

  std::uint32_t lowestAllowed(const SearchTree::Node& node) const {
    const int stride = options_.positionStride;
    if (stride == 1) return node.lowest;
    std::uint32_t lowest = kNone;
    for (std::uint32_t o = node.begin; o < node.begin + node.count; ++o) {
      const Vec3i p = tree_.pyramid_->averages(0).ijk(tree_.order_[o]);
      if (p.x % stride == 0 && p.y % stride == 0 && p.z % stride == 0)
        lowest = std::min(lowest, tree_.order_[o]);
    }
    return lowest;
  }

  const SearchTree& tree_;
  const TreeSearchOptions& options_;
  const SearchTree::Path& path_;
  std::vector<Cell> cells_;
  std::int64_t known_ = 0;
  int low_, high_;  // of the source's values

  // Smallest bound first; among equals the lowest position, so that ties end early.
  struct Later {
    const std::vector<SearchTree::Node>* nodes;
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.bound != b.bound) return a.bound > b.bound;
      return (*nodes)[a.node].lowest > (*nodes)[b.node].lowest;
    }
  };
  Later later_{&tree_.nodes_};
  std::vector<Entry> queue_;
  std::size_t keep_ = 1024;
  std::int64_t best_ = kInfinite, upper_ = kInfinite;
  std::uint32_t bestPosition_ = kNone;
  TreeSearchStatistics statistics_;
};

namespace {

void check(const SearchTree& tree, const BlockQuery<std::uint8_t>& query,
           const TreeSearchOptions& options) {
  if (query.samples.size() != TreeBuilder::cube(tree.blockSize()))
    throw InputError("a search tree for blocks of " + std::to_string(tree.blockSize()) +
                     "³ samples was asked for a block of another size");
  if (options.positionStride < 1)
    throw InputError("the stride of a search's positions must be at least 1");
  if (options.pruning == QueuePruning::Lipschitz && !(options.lipschitz > 0))
    throw InputError("the Lipschitz constant of a search must be above 0");
}

}  // namespace

BlockMatch SearchTree::findBest(const BlockQuery<std::uint8_t>& query,
                                const TreeSearchOptions& options,
                                TreeSearchStatistics* statistics) const {
  check(*this, query, options);
  TreeSearchStatistics ignored;
  return TreeSearch(*this, query, options).run(statistics ? *statistics : ignored);
}

std::vector<double> SearchTree::boundsAlongPath(const BlockQuery<std::uint8_t>& query,
                                                const Vec3i& position) const {
  const TreeSearchOptions options;
  check(*this, query, options);
  return TreeSearch(*this, query, options).boundsAlongPath(position);
}

}  // namespace exemplar
