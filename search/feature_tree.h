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

/// Puts `c` where its gap belongs among the `count` before it.
inline void insertByGap(const std::uint32_t* gaps, int* order, int& count, int c) {
  int i = count++;
  for (; i > 0 && gaps[order[i - 1]] > gaps[c]; --i) order[i] = order[i - 1];
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
///   `leaves(count)`: so many leaves are about to be looked at;
///   `add(entry, gap)`: an entry that is left;
///   `flush()`: now is the time to work on those that were added since `node`.
///
/// Leaves are seldom in a cache. So all of a node are asked for first, then their means are looked
/// at, and the details of those that are left are asked for before the first of them is looked at.
template <class Visitor>
void searchTree(const FeatureTree& tree, const kernels::QueryFeatures& query, Visitor& visitor) {
  constexpr int kWide = FeatureTree::kWide;
  const kernels::Kernels& k = kernels::kernels();
  struct Open {
    std::uint32_t gap, node, lowest;
    int level;
  };
  // Fifteen children wait at each of at most eight levels while the sixteenth is worked on.
  Open stack[kWide * 9];
  int open = 0;
  stack[open++] = {0, 0, 0, tree.levels() - 1};
  while (open > 0) {
    const Open at = stack[--open];
    if (at.gap > visitor.bound() || visitor.hopeless(at.lowest)) continue;
    if (!visitor.node()) return;
    const FeatureTree::Node& node = tree.node(at.level, at.node);
    alignas(64) std::uint32_t gaps[kWide];
    std::uint32_t within = k.boxGaps(node.boxes, query, visitor.bound(), gaps);
    within &= tree.children(at.level, at.node);
    const std::uint32_t first = at.node * kWide;
    int order[kWide], count = 0;
    for (; within != 0; within &= within - 1) {
      const int c = std::countr_zero(within);
      if (visitor.hopeless(node.lowest[c]) ||
          !visitor.may(at.level, first + static_cast<std::uint32_t>(c), gaps[c]))
        continue;
      if (at.level == 0)
        order[count++] = c;
      else
        insertByGap(gaps, order, count, c);
    }
    if (at.level > 0) {
      while (count > 0) {  // the nearest on top
        const auto c = static_cast<std::uint32_t>(order[--count]);
        prefetch(tree.node(at.level - 1, first + c));
        stack[open++] = {gaps[c], first + c, node.lowest[c], at.level - 1};
      }
      continue;
    }
    struct Left {
      std::uint32_t leaf, within;
      alignas(64) std::uint32_t gaps[kWide];
    };
    Left left[kWide];
    int leftCount = 0;
    for (int o = 0; o < count; ++o)
      prefetch(tree.leaf(first + static_cast<std::uint32_t>(order[o])).means);
    visitor.leaves(count);
    for (int o = 0; o < count; ++o) {
      Left& here = left[leftCount];
      here.leaf = first + static_cast<std::uint32_t>(order[o]);
      here.within = k.meanGaps(tree.leaf(here.leaf).means, query, visitor.bound(), here.gaps) &
                    tree.entriesOf(here.leaf);
      if (here.within == 0) continue;
      prefetch(tree.details(here.leaf));
      prefetch(tree.leaf(here.leaf).entry);
      ++leftCount;
    }
    for (int l = 0; l < leftCount; ++l) {
      Left& here = left[l];
      here.within &= k.detailGaps(tree.details(here.leaf), query, visitor.bound(), here.gaps);
      for (; here.within != 0; here.within &= here.within - 1) {
        const int c = std::countr_zero(here.within);
        const std::uint32_t entry = tree.leaf(here.leaf).entry[c];
        if (!visitor.hopeless(entry)) visitor.add(entry, here.gaps[c]);
      }
    }
    visitor.flush();
  }
}

}  // namespace exemplar
