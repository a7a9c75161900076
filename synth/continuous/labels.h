// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/progress.h"
#include "synth/continuous/arrangement.h"
#include "synth/continuous/figures.h"

/// Which figures fit which vertices, and which fit together along an edge.
namespace exemplar::continuous {

/// Sets of labels as words, 64 labels each.
using Word = std::uint64_t;

/// The edge labels along all rays of a vertex that a set of labels leaves, by tables: a row of
/// words, some for each ray in turn.
class EdgeRows {
 public:
  EdgeRows() = default;
  /// `edgeOf[ray][label]` of `edges[ray]` edge labels. Takes at most `kMostTable` bytes for tables
  /// of four labels each, else a row for each label.
  EdgeRows(const std::vector<std::vector<std::uint32_t>>& edgeOf, const std::vector<int>& edges,
           std::size_t labels);

  /// Words of a row, and where the set of a ray begins; `start(rays)` is their number.
  std::size_t words() const { return start_.empty() ? 0 : start_.back(); }
  std::uint32_t start(std::uint32_t ray) const { return start_[ray]; }
  /// Writes the row of a set of labels.
  void of(std::span<const Word> labels, Word* row) const;

 private:
  static constexpr std::size_t kMostTable = std::size_t{1} << 19;
  static constexpr std::size_t kBlock = 4;       // words that are united at once
  static constexpr std::size_t kMostParts = 64;  // rows
  void unite(std::span<const Word* const> parts, Word* row) const;

  std::vector<std::uint32_t> start_;
  std::size_t stride_ = 0;  // of rows, in words: whole blocks
  bool fours_ = false;
  std::vector<Word> rows_;  // for each four labels their 16 subsets' rows, or one for each label
};

/// What vertices through which the same families go can look like (thesis, sections 4.5.2, 4.5.4
/// and 4.5.5). Since a label says what every edge at the vertex looks like, two vertices agree
/// along an edge where their labels give it the same edge label; no table of pairs is needed.
struct VertexClass {
  const Central* central = nullptr;
  int words = 0;                       ///< of a set of labels
  std::vector<std::uint32_t> figures;  ///< of each label; ascending
  std::vector<Substance> substances;   ///< label by label, of the cells

  /// Along a ray: the edge label of each label, and for each edge label the set of labels with it.
  struct Along {
    std::vector<std::uint32_t> edgeOf;
    std::vector<Word> labelsWith;  ///< edge label by edge label, `words` each
    int edges = 0;                 ///< how many edge labels the line has
  };
  std::vector<Along> rays;
  EdgeRows edgeRows;

  std::size_t labels() const { return figures.size(); }
  std::span<const Substance> cells(std::size_t label) const {
    return {substances.data() + label * central->cells.size(), central->cells.size()};
  }
  /// The label of a figure, or -1.
  int labelOf(std::uint32_t figure) const;
};

/// The most edge labels that a line may have.
inline constexpr int kMostEdgeLabels = 1024;

/// The classes of an arrangement's inner vertices, by their kinds; kinds that are only on its
/// border have none (no labels). Throws `InputError` where a line has more than `kMostEdgeLabels`.
std::vector<VertexClass> classesOf(const Arrangement& arrangement, const FigureSet& figures,
                                   const Progress& progress = {});

/// The numbers of the figures whose support is among some families, ascending.
std::vector<std::uint32_t> figuresWithin(const FigureSet& figures, Families families);

// Sets of labels.

inline bool contains(std::span<const Word> set, std::size_t label) {
  return (set[label / 64] >> (label % 64) & 1) != 0;
}
inline void insert(std::span<Word> set, std::size_t label) {
  set[label / 64] |= Word{1} << (label % 64);
}
/// Not `erase`, which for a vector would be `std::erase` of words that are equal to the label.
inline void takeOut(std::span<Word> set, std::size_t label) {
  set[label / 64] &= ~(Word{1} << (label % 64));
}
inline int count(std::span<const Word> set) {
  int n = 0;
  for (const Word w : set) n += std::popcount(w);
  return n;
}
/// Whether a set has exactly one label.
inline bool hasOne(std::span<const Word> set) {
  Word one = 0;
  for (const Word w : set) {
    if (w == 0) continue;
    if (one != 0 || (w & (w - 1)) != 0) return false;
    one = w;
  }
  return one != 0;
}
/// The lowest label of a set that has some.
inline std::size_t lowest(std::span<const Word> set) {
  std::size_t w = 0;
  while (set[w] == 0) ++w;
  return w * 64 + static_cast<std::size_t>(std::countr_zero(set[w]));
}
/// Calls `body(label)` for each label of a set, ascending.
template <class Body>
void forEach(std::span<const Word> set, Body&& body) {
  for (std::size_t w = 0; w < set.size(); ++w) {
    for (Word rest = set[w]; rest != 0; rest &= rest - 1)
      body(w * 64 + static_cast<std::size_t>(std::countr_zero(rest)));
  }
}

}  // namespace exemplar::continuous
