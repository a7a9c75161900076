// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/labels.h"

#include <algorithm>

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
  return made;
}

}  // namespace

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
