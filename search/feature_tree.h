// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/huge_pages.h"
#include "search/kernels.h"

namespace exemplar {

/// A 16-ary tree over points, or boxes, with 32 features each, as whole numbers from 0 to 32767.
///
/// The first eight features ("means") shape the tree: its nodes are boxes in their space, and so
/// its leaves come with little memory touched. The other 24 ("details") are looked at only in
/// leaves where the means leave something.
class FeatureTree {
 public:
  static constexpr int kMeans = kernels::kMeans;
  static constexpr int kFeatures = kernels::kMeans + kernels::kDetails;
  static constexpr int kWide = kernels::kWide;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct alignas(64) Node {
    kernels::MeanBoxes boxes;
    std::uint32_t lowest[kWide];  ///< entry below each child
  };
  struct alignas(64) Leaf {
    kernels::MeanPoints means;
    std::uint32_t entry[kWide];  ///< rising; kNone beyond the last
  };

  /// Writes the ranges that an entry's features take: kFeatures of each.
  using Ranges = std::function<void(std::uint32_t entry, std::int16_t* low, std::int16_t* high)>;

  FeatureTree() = default;
  /// `ranges` is called from several threads. Every number may be off by `margin`. Deterministic.
  FeatureTree(const std::vector<std::uint32_t>& entries, const Ranges& ranges, int margin);

  bool empty() const { return entryCount_ == 0; }
  int levels() const { return static_cast<int>(levels_.size()); }
  /// Level 0 are the parents of leaves; the last level is the root. Child c of node n is node, or
  /// leaf, 16 n + c of the level below.
  const Node& node(int level, std::size_t n) const { return levels_[level][n]; }
  const Leaf& leaf(std::size_t n) const { return leaves_[n]; }
  const kernels::DetailPoints& details(std::size_t n) const { return details_[n]; }
  std::size_t leaves() const { return leaves_.size(); }
  std::size_t nodes(int level) const { return levels_[level].size(); }
  /// The bits of the children that node `n` of a level has, and of the entries of leaf `n`.
  std::uint32_t children(int level, std::size_t n) const {
    return there(n, level == 0 ? leaves_.size() : levels_[level - 1].size());
  }
  std::uint32_t entriesOf(std::size_t leaf) const { return there(leaf, entryCount_); }
  std::size_t bytes() const;

 private:
  static std::uint32_t there(std::size_t n, std::size_t count) {
    const std::size_t left = count - n * kWide;
    return left >= kWide ? 0xffff : (std::uint32_t{1} << left) - 1;
  }

  std::size_t entryCount_ = 0;
  HugeVector<Leaf> leaves_;
  HugeVector<kernels::DetailPoints> details_;
  std::vector<HugeVector<Node>> levels_;
};

/// Asks for the memory of `what`, all of it.
template <class T>
void prefetch(const T& what) {
  const char* at = reinterpret_cast<const char*>(&what);
  for (std::size_t byte = 0; byte < sizeof(T); byte += 64) __builtin_prefetch(at + byte);
}

/// Puts `c` where its gap belongs among the `count` before it, after those with the same gap.
inline void insertByGap(const std::uint32_t* gaps, int* order, int& count, int c) {
  int i = count++;
  for (; i > 0 && gaps[order[i - 1]] > gaps[c]; --i) order[i] = order[i - 1];
  order[i] = c;
}
/// The same, but of equal gaps the lower entry comes first: where many blocks are equally near (at
/// distance 0), the lowest makes all others hopeless.
inline void insertByGap(const std::uint32_t* gaps, const std::uint32_t* lowest, int* order,
                        int& count, int c) {
  const auto before = [&](int a, int b) {
    return gaps[a] != gaps[b] ? gaps[a] < gaps[b] : lowest[a] < lowest[b];
  };
  int i = count++;
  for (; i > 0 && before(c, order[i - 1]); --i) order[i] = order[i - 1];
  order[i] = c;
}

/// The entry that the nearest children lead to: probably near. For a first limit.
inline std::uint32_t likelyEntry(const FeatureTree& tree, const kernels::QueryFeatures& query) {
  constexpr std::uint32_t any = kernels::kLargestBound;
  const kernels::Kernels& k = kernels::kernels();
  alignas(64) std::uint32_t gaps[FeatureTree::kWide];
  const auto nearest = [&](std::uint32_t there) {
    int best = std::countr_zero(there);
    for (; there != 0; there &= there - 1)
      if (const int c = std::countr_zero(there); gaps[c] < gaps[best]) best = c;
    return static_cast<std::uint32_t>(best);
  };
  std::uint32_t n = 0;
  for (int level = tree.levels() - 1; level >= 0; --level) {
    k.boxGaps(tree.node(level, n).boxes, query, any, gaps);
    n = n * FeatureTree::kWide + nearest(tree.children(level, n));
  }
  k.meanGaps(tree.leaf(n).means, query, any, gaps);
  k.detailGaps(tree.details(n), query, any, gaps);
  return tree.leaf(n).entry[nearest(tree.entriesOf(n))];
}

/// Searches a tree depth-first, the nearest children first, for all entries whose sum of squared
/// gaps to the query is within the visitor's bound, which may fall while the search goes on. The
/// visitor answers
///   `bound()`: the largest sum that is of interest;
///   `hopeless(lowest)`: whether entries from this one on are of no interest;
///   `may(level, child, gap)`: whether a child may hold any that are;
///   `node()`: a node is about to be looked at; false ends the search;
///   `leaves(count)`: `count` leaves are about to be looked at;
///   `add(entry, gap)`: an entry that is left;
///   `flush()`: now is the time to work on those that were added since the last time.
///
/// What a tree holds is seldom in a cache, so memory is asked for a step before it is needed: while
/// the leaves below one node come, those of the node before have their means looked at, those left
/// before that their details, and what these left is worked on.
template <class Visitor>
class FeatureTreeSearch {
 public:
  FeatureTreeSearch(const FeatureTree& tree, const kernels::QueryFeatures& query, Visitor& visitor)
      : tree_(tree), query_(query), visitor_(visitor) {}

  void run() {
    open_[openCount_++] = {0, 0, 0, tree_.levels() - 1};
    while (openCount_ > 0) {
      const Open at = open_[--openCount_];
      if (at.gap > visitor_.bound() || visitor_.hopeless(at.lowest)) continue;
      if (!visitor_.node()) return;
      std::uint32_t gaps[kWide];
      int order[kWide];
      const int count = children(at, gaps, order);
      if (at.level > 0)
        descend(at, gaps, order, count);
      else
        step(at.node * kWide, order, count);
    }
    for (int stage = 0; stage < 3; ++stage) step(0, nullptr, 0);
  }

 private:
  static constexpr int kWide = FeatureTree::kWide;
  struct Open {
    std::uint32_t gap, node, lowest;
    int level;
  };
  struct Left {
    std::uint32_t leaf, within;
    alignas(64) std::uint32_t gaps[kWide];
  };

  // The children of a node that may hold something; above leaves' parents the nearest first.
  int children(const Open& at, std::uint32_t* gaps, int* order) {
    const FeatureTree::Node& node = tree_.node(at.level, at.node);
    std::uint32_t within = kernels_.boxGaps(node.boxes, query_, visitor_.bound(), gaps);
    within &= tree_.children(at.level, at.node);
    int count = 0;
    for (; within != 0; within &= within - 1) {
      const int c = std::countr_zero(within);
      if (visitor_.hopeless(node.lowest[c]) ||
          !visitor_.may(at.level, at.node * kWide + static_cast<std::uint32_t>(c), gaps[c]))
        continue;
      if (at.level == 0)
        order[count++] = c;
      else
        insertByGap(gaps, node.lowest, order, count, c);
    }
    return count;
  }

  void descend(const Open& at, const std::uint32_t* gaps, const int* order, int count) {
    const FeatureTree::Node& node = tree_.node(at.level, at.node);
    while (count > 0) {  // the nearest on top
      const auto c = static_cast<std::uint32_t>(order[--count]);
      const std::uint32_t child = at.node * kWide + c;
      prefetch(tree_.node(at.level - 1, child));
      open_[openCount_++] = {gaps[c], child, node.lowest[c], at.level - 1};
    }
  }

  // Takes leaves in, and everything that waits one step on.
  void step(std::uint32_t first, const int* order, int count) {
    for (int o = 0; o < count; ++o)
      prefetch(tree_.leaf(first + static_cast<std::uint32_t>(order[o])).means);
    visitor_.flush();
    lookAtDetails();
    lookAtMeans();
    leafCount_ = count;
    for (int o = 0; o < count; ++o) leaves_[o] = first + static_cast<std::uint32_t>(order[o]);
  }

  void lookAtMeans() {
    visitor_.leaves(leafCount_);
    for (int l = 0; l < leafCount_; ++l) {
      Left& here = left_[leftCount_];
      const FeatureTree::Leaf& leaf = tree_.leaf(leaves_[l]);
      here.leaf = leaves_[l];
      here.within = kernels_.meanGaps(leaf.means, query_, visitor_.bound(), here.gaps) &
                    tree_.entriesOf(here.leaf);
      if (here.within == 0) continue;
      prefetch(tree_.details(here.leaf));
      prefetch(leaf.entry);
      ++leftCount_;
    }
  }

  void lookAtDetails() {
    for (int l = 0; l < leftCount_; ++l) {
      Left& here = left_[l];
      here.within &=
          kernels_.detailGaps(tree_.details(here.leaf), query_, visitor_.bound(), here.gaps);
      for (; here.within != 0; here.within &= here.within - 1) {
        const int c = std::countr_zero(here.within);
        const std::uint32_t entry = tree_.leaf(here.leaf).entry[c];
        if (!visitor_.hopeless(entry)) visitor_.add(entry, here.gaps[c]);
      }
    }
    leftCount_ = 0;
  }

  const FeatureTree& tree_;
  const kernels::QueryFeatures& query_;
  Visitor& visitor_;
  const kernels::Kernels& kernels_ = kernels::kernels();
  // Fifteen children wait at each of at most eight levels while the sixteenth is worked on.
  Open open_[kWide * 9];
  int openCount_ = 0;
  std::uint32_t leaves_[kWide];
  int leafCount_ = 0;
  Left left_[kWide];
  int leftCount_ = 0;
};

}  // namespace exemplar
