// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/grounding.h"

#include <algorithm>
#include <map>
#include <vector>

#include "core/disjoint_sets.h"

namespace exemplar::continuous {
namespace {

constexpr std::size_t kNoLabel = static_cast<std::size_t>(-1);

/// Joins vertices along edges with anything but air around them; `labelOf(v)` is a vertex's label.
/// Returns for each vertex whether its piece has any of the ground, and the pieces.
template <class LabelOf>
std::vector<std::uint8_t> grounded(const Puzzle& puzzle, Substance ground, DisjointSets& pieces,
                                   const LabelOf& labelOf) {
  const Arrangement& a = puzzle.arrangement;
  pieces.reset(a.vertices());
  std::vector<std::uint8_t> has(a.vertices());
  for (std::uint32_t v = 0; v < a.vertices(); ++v) {
    if (!a.inside(v)) continue;
    const std::size_t label = labelOf(v);
    if (label == kNoLabel) continue;
    const std::span<const Substance> cells = puzzle.classOf(v).cells(label);
    has[v] = std::ranges::find(cells, ground) != cells.end();
    const std::span<const EdgeEnd> ends = a.ends(v);
    for (std::size_t r = 0; r < ends.size(); ++r) {
      const std::uint32_t w = ends[r].vertex;
      if (w == EdgeEnd::kNone || w < v || !a.inside(w)) continue;
      const std::vector<std::uint32_t>& around = a.central(v).rays[r].around;
      if (std::ranges::any_of(around, [&](std::uint32_t c) { return cells[c] != kAir; }))
        pieces.join(v, w);
    }
  }
  for (std::uint32_t v = 0; v < has.size(); ++v)
    if (has[v]) has[pieces.find(v)] = 1;
  for (std::uint32_t v = 0; v < has.size(); ++v) has[v] = has[pieces.find(v)];
  return has;
}

std::size_t labelIn(const Domains& labels, std::uint32_t v) {
  std::size_t label = kNoLabel;
  forEach(labels[v], [&](std::size_t l) { label = l; });
  return label;
}

bool isAir(std::span<const Substance> cells) {
  return std::ranges::all_of(cells, [](Substance s) { return s == kAir; });
}

}  // namespace

bool anyFloats(const Puzzle& puzzle, std::span<const std::uint32_t> figures, Substance ground) {
  const auto labelOf = [&](std::uint32_t v) {
    const int label = puzzle.classOf(v).labelOf(figures[v]);
    return label < 0 ? kNoLabel : static_cast<std::size_t>(label);
  };
  DisjointSets pieces;
  const std::vector<std::uint8_t> has = grounded(puzzle, ground, pieces, labelOf);
  for (std::uint32_t v = 0; v < has.size(); ++v) {
    if (!puzzle.arrangement.inside(v) || has[v]) continue;
    const std::size_t label = labelOf(v);
    if (label != kNoLabel && !isAir(puzzle.classOf(v).cells(label))) return true;
  }
  return false;
}

std::int64_t removeFloating(const Puzzle& puzzle, const Domains& allowed,
                            std::span<const std::uint32_t> vertices, Substance ground,
                            Domains& labels) {
  const auto labelOf = [&](std::uint32_t v) { return labelIn(labels, v); };
  const std::uint32_t air = puzzle.figures.find({0, {kAir}});
  DisjointSets pieces;
  const std::vector<std::uint8_t> has = grounded(puzzle, ground, pieces, labelOf);
  std::vector<std::uint8_t> stays(has.size());
  for (const std::uint32_t v : vertices) {
    const int label = puzzle.classOf(v).labelOf(air);
    if (label < 0 || !contains(allowed[v], static_cast<std::size_t>(label)))
      stays[pieces.find(v)] = 1;
  }
  std::int64_t removed = 0;
  std::vector<std::uint8_t> counted(has.size());
  for (const std::uint32_t v : vertices) {
    const std::uint32_t piece = pieces.find(v);
    if (has[v] || stays[piece] || isAir(puzzle.classOf(v).cells(labelOf(v)))) continue;
    removed += !counted[piece];
    counted[piece] = 1;
    std::ranges::fill(labels[v], 0);
    insert(labels[v], static_cast<std::size_t>(puzzle.classOf(v).labelOf(air)));
  }
  return removed;
}

std::int64_t keepLargest(const Puzzle& puzzle, const Domains& allowed,
                         std::span<const std::uint32_t> vertices, const Growth& growth, int most,
                         Domains& labels) {
  const Arrangement& a = puzzle.arrangement;
  DisjointSets pieces(a.vertices());
  for (const std::uint32_t v : vertices) {
    const std::size_t label = labelIn(labels, v);
    const std::span<const EdgeEnd> ends = a.ends(v);
    for (std::size_t r = 0; r < ends.size(); ++r) {
      if (ends[r].vertex != EdgeEnd::kNone && a.inside(ends[r].vertex) &&
          growth.builtAlong[a.kind(v)][r][label])
        pieces.join(v, ends[r].vertex);
    }
  }
  // Pieces by size; those that cannot become background come first.
  struct Piece {
    std::vector<std::uint32_t> vertices;
    bool stays = false;
  };
  std::map<std::uint32_t, Piece> byRoot;
  for (const std::uint32_t v : vertices) {
    const std::size_t label = labelIn(labels, v);
    if (!growth.builtAt[a.kind(v)][label]) continue;
    Piece& piece = byRoot[pieces.find(v)];
    piece.vertices.push_back(v);
    const auto background = static_cast<std::size_t>(puzzle.background[v]);
    piece.stays = piece.stays || !contains(allowed[v], background);
    // What is around the piece must look the same with background in its place.
    const std::span<const EdgeEnd> ends = a.ends(v);
    for (std::size_t r = 0; r < ends.size() && !piece.stays; ++r) {
      if (growth.builtAlong[a.kind(v)][r][label]) continue;
      const VertexClass::Along& along = puzzle.classOf(v).rays[r];
      piece.stays = along.edgeOf[label] != along.edgeOf[background];
    }
  }
  std::vector<const Piece*> order;
  for (const auto& [root, piece] : byRoot) order.push_back(&piece);
  std::ranges::stable_sort(order, [](const Piece* p, const Piece* q) {
    return p->stays != q->stays ? p->stays : p->vertices.size() > q->vertices.size();
  });
  std::int64_t left = 0;
  for (const Piece* piece : order) {
    if (piece->stays || left < most) {
      ++left;
      continue;
    }
    for (const std::uint32_t v : piece->vertices) {
      std::ranges::fill(labels[v], 0);
      insert(labels[v], static_cast<std::size_t>(puzzle.background[v]));
    }
  }
  return left;
}

}  // namespace exemplar::continuous
