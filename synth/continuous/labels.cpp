// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/labels.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/loop_progress.h"
#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

VertexClass makeClass(const Central& central, const Centrals& centrals, const FigureSet& figures) {
  VertexClass made;
  made.central = &central;
  made.figures = figuresWithin(figures, central.families);
  made.words = static_cast<int>((made.figures.size() + 63) / 64);
  for (const std::uint32_t f : made.figures) {
    const std::vector<Substance> cells = expanded(centrals, figures[f], central.families);
    made.substances.insert(made.substances.end(), cells.begin(), cells.end());
  }
  std::vector<Substance> around;
  for (const Central::Ray& ray : central.rays) {
    const std::vector<std::uint32_t> edges = figuresWithin(figures, ray.on);
    VertexClass::Along along;
    along.edges = static_cast<int>(edges.size());
    if (along.edges > kMostEdgeLabels) {
      throw InputError("the example's edges look in " + std::to_string(edges.size()) +
                       " ways along one line, and at most " + std::to_string(kMostEdgeLabels) +
                       " can be handled; use fewer materials or directions of faces");
    }
    along.labelsWith.assign(edges.size() * static_cast<std::size_t>(made.words), 0);
    for (std::size_t label = 0; label < made.labels(); ++label) {
      around.clear();
      for (const std::uint32_t c : ray.around) around.push_back(made.cells(label)[c]);
      // The set is closed under restriction, so the edge's figure is in it.
      const std::uint32_t figure = figures.find(reduced(centrals, ray.on, around));
      const auto edge =
          static_cast<std::size_t>(std::ranges::lower_bound(edges, figure) - edges.begin());
      along.edgeOf.push_back(static_cast<std::uint32_t>(edge));
      insert({along.labelsWith.data() + edge * static_cast<std::size_t>(made.words),
              static_cast<std::size_t>(made.words)},
             label);
    }
    made.rays.push_back(std::move(along));
  }
  std::vector<std::vector<std::uint32_t>> edgeOf;
  std::vector<int> edges;
  for (const VertexClass::Along& along : made.rays) {
    edgeOf.push_back(along.edgeOf);
    edges.push_back(along.edges);
  }
  made.edgeRows = EdgeRows(edgeOf, edges, made.labels());
  return made;
}

}  // namespace

EdgeRows::EdgeRows(const std::vector<std::vector<std::uint32_t>>& edgeOf,
                   const std::vector<int>& edges, std::size_t labels)
    : start_{0} {
  for (const int n : edges)
    start_.push_back(start_.back() + static_cast<std::uint32_t>(n + 63) / 64);
  stride_ = (words() + kBlock - 1) / kBlock * kBlock;
  std::vector<Word> single(labels * stride_);
  for (std::size_t ray = 0; ray < edgeOf.size(); ++ray) {
    for (std::size_t l = 0; l < labels; ++l)
      insert({single.data() + l * stride_ + start_[ray], words() - start_[ray]}, edgeOf[ray][l]);
  }
  const std::size_t fours = (labels + 3) / 4;
  fours_ = fours * 16 * stride_ * sizeof(Word) <= kMostTable;
  if (!fours_) {
    rows_ = std::move(single);
    return;
  }
  rows_.resize(fours * 16 * stride_);
  for (std::size_t four = 0; four < fours; ++four) {
    for (std::size_t set = 1; set < 16; ++set) {
      Word* row = rows_.data() + (four * 16 + set) * stride_;
      for (std::size_t n = 0; n < 4 && four * 4 + n < labels; ++n) {
        if ((set >> n & 1) == 0) continue;
        const Word* one = single.data() + (four * 4 + n) * stride_;
        for (std::size_t w = 0; w < words(); ++w) row[w] |= one[w];
      }
    }
  }
}

void EdgeRows::of(std::span<const Word> labels, Word* row) const {
  std::array<const Word*, kMostParts> parts;
  std::size_t many = 0;
  std::fill(row, row + words(), 0);
  const auto add = [&](std::size_t at) {
    if (many == parts.size()) {
      unite({parts.data(), many}, row);
      many = 0;
    }
    parts[many++] = rows_.data() + at * stride_;
  };
  if (!fours_) {
    forEach(labels, add);
  } else {
    for (std::size_t w = 0; w < labels.size(); ++w) {
      for (Word rest = labels[w]; rest != 0;) {
        const int four = std::countr_zero(rest) / 4;
        add((w * 16 + static_cast<std::size_t>(four)) * 16 + (rest >> (4 * four) & 15));
        rest &= ~(Word{15} << (4 * four));
      }
    }
  }
  unite({parts.data(), many}, row);
}

/// Adds rows of the table to a row: block by block, so that sums stay in registers.
void EdgeRows::unite(std::span<const Word* const> parts, Word* row) const {
  const std::size_t width = words();
  for (std::size_t from = 0; from < width; from += kBlock) {
    std::array<Word, kBlock> sum{};
    for (const Word* part : parts)
      for (std::size_t w = 0; w < kBlock; ++w) sum[w] |= part[from + w];
    for (std::size_t w = 0; w < std::min(kBlock, width - from); ++w) row[from + w] |= sum[w];
  }
}

int VertexClass::labelOf(std::uint32_t figure) const {
  const auto found = std::ranges::lower_bound(figures, figure);
  return found == figures.end() || *found != figure ? -1
                                                    : static_cast<int>(found - figures.begin());
}

std::vector<std::uint32_t> figuresWithin(const FigureSet& figures, Families families) {
  std::vector<std::uint32_t> within;
  for (std::uint32_t f = 0; f < figures.size(); ++f)
    if ((figures[f].support & ~families) == 0) within.push_back(f);
  return within;
}

std::vector<VertexClass> classesOf(const Arrangement& arrangement, const FigureSet& figures,
                                   const Progress& progress) {
  const std::vector<const Central*>& kinds = arrangement.kinds();
  std::vector<std::uint8_t> inner(kinds.size());
  for (std::uint32_t v = 0; v < arrangement.vertices(); ++v)
    if (arrangement.inside(v)) inner[arrangement.kind(v)] = 1;
  std::vector<VertexClass> classes(kinds.size());
  LoopProgress loop(progress, "listing labels", kinds.size());
  parallelFor(0, kinds.size(), 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) {
      if (inner[k]) classes[k] = makeClass(*kinds[k], arrangement.centrals(), figures);
      loop.advance();
    }
  });
  return classes;
}

}  // namespace exemplar::continuous
