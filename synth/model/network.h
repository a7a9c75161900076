// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "voxelize/adjacency.h"

namespace exemplar {

/// 64 labels' worth of a set of labels; label b is bit b % 64 of word b / 64.
using LabelWord = std::uint64_t;

inline int wordsForLabels(int labels) { return (labels + 63) / 64; }

/// Calls `visit(label)` for each label in a set, ascending.
template <class Visit>
void forEachLabel(std::span<const LabelWord> set, const Visit& visit) {
  for (std::size_t w = 0; w < set.size(); ++w) {
    for (LabelWord rest = set[w]; rest; rest &= rest - 1) {
      visit(static_cast<int>(w * 64 + std::countr_zero(rest)));
    }
  }
}
inline int labelsIn(std::span<const LabelWord> set) {
  int count = 0;
  for (const LabelWord w : set) count += std::popcount(w);
  return count;
}
inline bool containsLabel(std::span<const LabelWord> set, int label) {
  return set[label / 64] >> (label % 64) & 1;
}
inline void addLabel(std::span<LabelWord> set, int label) {
  set[label / 64] |= LabelWord{1} << (label % 64);
}

/// Rows of label sets: row b of a support table holds the labels that the far end of a link
/// may have when the near one has b.
class LabelSets {
 public:
  LabelSets() = default;
  LabelSets(int labels, std::size_t rows)
      : words_(wordsForLabels(labels)), data_(rows * words_, 0) {}

  int words() const { return words_; }
  std::size_t rows() const { return words_ ? data_.size() / words_ : 0; }
  std::span<LabelWord> operator[](std::size_t row) {
    return {data_.data() + row * words_, static_cast<std::size_t>(words_)};
  }
  std::span<const LabelWord> operator[](std::size_t row) const {
    return {data_.data() + row * words_, static_cast<std::size_t>(words_)};
  }
  LabelWord* data() { return data_.data(); }
  const LabelWord* data() const { return data_.data(); }
  bool operator==(const LabelSets&) const = default;

 private:
  int words_ = 0;
  std::vector<LabelWord> data_;
};

/// Cells, their neighbors, and which labels neighbors may have: what model synthesis solves,
/// whatever the grid looks like (periodic, with holes, hexagonal, symmetric, changing over time).
///
/// Relations come in pairs: relation r ^ 1 is r seen from the far end. Relation r of the first
/// `slots` belongs to slot r of every cell; the others belong to single links.
struct LabelNetwork {
  struct Link {
    std::int32_t cell;      ///< at the far end
    std::int32_t relation;  ///< index into `support`
  };

  int labels = 0;
  int cells = 0;
  int slots = 0;                        ///< neighbors of a cell that follow a rule; even
  std::vector<std::int32_t> neighbor;   ///< cells × slots; `cells`: none
  std::vector<LabelSets> support;       ///< one a relation, each with `labels` rows
  std::vector<std::int32_t> linkBegin;  ///< empty, or cells + 1: links beside the slots
  std::vector<Link> links;

  int words() const { return wordsForLabels(labels); }
  std::span<const std::int32_t> neighbors(int cell) const {
    return {neighbor.data() + static_cast<std::size_t>(cell) * slots,
            static_cast<std::size_t>(slots)};
  }
  std::span<const Link> linksOf(int cell) const {
    if (linkBegin.empty()) return {};
    return {links.data() + linkBegin[cell],
            static_cast<std::size_t>(linkBegin[cell + 1] - linkBegin[cell])};
  }
  /// Calls `visit(neighbor, relation)` for each neighbor.
  template <class Visit>
  void forEachNeighbor(int cell, const Visit& visit) const {
    const auto near = neighbors(cell);
    for (int s = 0; s < slots; ++s) {
      if (near[s] != cells) visit(near[s], s);
    }
    for (const Link& l : linksOf(cell)) visit(l.cell, l.relation);
  }
};

/// The two support tables of each rule: relation 2r along rule r's offset, 2r + 1 against it.
std::vector<LabelSets> supportTables(const Adjacency& adjacency);

/// The network of some cells of another one, in the order given; neighbors that are not among them
/// are gone. The far ends of a cell's lost neighbors restrict `domains` (one set a new cell, in and
/// out) to what `outside(cell)`, a set of labels, supports.
class NetworkPart {
 public:
  explicit NetworkPart(const LabelNetwork& whole);

  /// `cells` ascending. O(cells x slots).
  void select(std::span<const std::int32_t> cells);

  const LabelNetwork& network() const { return part_; }
  std::span<const std::int32_t> cells() const { return chosen_; }
  /// The new number of a cell, or -1.
  int local(int cell) const { return local_[cell]; }

  /// Restricts `domain`, the set of the new cell `c`, to what its neighbors left outside support.
  template <class Outside>
  void restrictByOutside(int c, std::span<LabelWord> domain, const Outside& outside) const {
    whole_->forEachNeighbor(chosen_[c], [&](int n, int relation) {
      if (local_[n] >= 0) return;
      restrictBySupport(domain, outside(n), whole_->support[relation ^ 1]);
    });
  }
  /// The same where each cell left outside has one label, its own in `labels`.
  void restrictByLabels(int c, std::span<LabelWord> domain, std::span<const Label> labels) const {
    whole_->forEachNeighbor(chosen_[c], [&](int n, int relation) {
      if (local_[n] >= 0) return;
      const auto row = whole_->support[relation ^ 1][labels[n]];
      for (std::size_t w = 0; w < domain.size(); ++w) domain[w] &= row[w];
    });
  }

 private:
  /// Keeps in `domain` what the labels of `far` support through `table`.
  static void restrictBySupport(std::span<LabelWord> domain, std::span<const LabelWord> far,
                                const LabelSets& table);

  const LabelNetwork* whole_;
  LabelNetwork part_;
  std::vector<std::int32_t> chosen_, local_;
};

}  // namespace exemplar
