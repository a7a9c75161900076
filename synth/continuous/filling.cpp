// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/filling.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "core/loop_progress.h"
#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

/// At a vertex on the box's sides: the families that a cell within must be above, and below.
struct Within {
  Families above = 0, below = 0;
  bool contains(Families cell) const { return (cell & above) == above && (cell & below) == 0; }
};
Within withinBox(const Arrangement& arrangement, const ExactBox& box, const ExactPoint& p) {
  static constexpr std::array<Vec3l, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::vector<Vec3l>& normals = arrangement.planes().normals;
  Within within;
  for (int axis = 0; axis < 3; ++axis) {
    const auto family = std::ranges::find(normals, axes[axis]) - normals.begin();
    if (p.n[axis] == box.low[axis] * p.d) within.above |= Families{1} << family;
    if (p.n[axis] == box.high[axis] * p.d) within.below |= Families{1} << family;
  }
  return within;
}

}  // namespace

SolidsFilling::SolidsFilling(const Arrangement& arrangement, const Solids& solids,
                             const Progress& progress)
    : cells_(arrangement.vertices()) {
  std::vector<std::vector<Substance>> made(arrangement.vertices());
  LoopProgress loop(progress, "filling the example", made.size());
  parallelFor(0, made.size(), 64, [&](std::size_t from, std::size_t to) {
    for (auto v = static_cast<std::uint32_t>(from); v < to; ++v) {
      const Central& central = arrangement.central(v);
      made[v] = substancesAround(solids, central, arrangement.point(v));
      const Within within =
          withinBox(arrangement, arrangement.planes().window, arrangement.point(v));
      for (std::size_t c = 0; c < made[v].size(); ++c)
        if (!within.contains(central.cells[c])) made[v][c] = kAir;
    }
    loop.advance(to - from);
  });
  for (std::uint32_t v = 0; v < made.size(); ++v)
    cells_[v] = tables_.add(arrangement.kind(v), std::move(made[v]));
}

LabelFilling::LabelFilling(const Puzzle& puzzle, const Domains& solved,
                           const std::optional<Ground>& ground)
    : cells_(puzzle.arrangement.vertices()) {
  const Arrangement& a = puzzle.arrangement;
  for (std::uint32_t v = 0; v < cells_.size(); ++v) {
    const Central& central = a.central(v);
    if (a.inside(v)) {
      std::size_t label = 0;
      forEach(solved[v], [&](std::size_t l) { label = l; });
      cells_[v] = puzzle.classOf(v).cells(label).data();
      continue;
    }
    std::vector<Substance> table =
        expanded(a.centrals(), backgroundAt(a.centrals(), ground, a.point(v)), central.families);
    const Within within = withinBox(a, a.planes().window, a.point(v));
    for (std::size_t c = 0; c < table.size(); ++c)
      if (!within.contains(central.cells[c])) table[c] = kAir;
    cells_[v] = tables_.add(a.kind(v), std::move(table));
  }
}

CroppedFilling::CroppedFilling(const Arrangement& arrangement, const Filling& whole,
                               const ExactBox& box)
    : cells_(arrangement.vertices()) {
  for (std::uint32_t v = 0; v < cells_.size(); ++v) {
    const ExactPoint& p = arrangement.point(v);
    const Central& central = arrangement.central(v);
    bool outside = false, inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      outside = outside || p.n[axis] < box.low[axis] * p.d || p.n[axis] > box.high[axis] * p.d;
      inside = inside && p.n[axis] > box.low[axis] * p.d && p.n[axis] < box.high[axis] * p.d;
    }
    const Substance* cells = whole.cells(v);
    if (inside) {
      cells_[v] = cells;
      continue;
    }
    const Within within = withinBox(arrangement, box, p);
    std::vector<Substance> table(cells, cells + central.cells.size());
    for (std::size_t c = 0; c < table.size(); ++c)
      if (outside || !within.contains(central.cells[c])) table[c] = kAir;
    cells_[v] = tables_.add(arrangement.kind(v), std::move(table));
  }
}

std::vector<std::uint32_t> figuresOf(const Arrangement& arrangement, const Filling& filling,
                                     const FigureSet& figures) {
  std::vector<std::uint32_t> found(arrangement.vertices(), FigureSet::kNone);
  std::unordered_map<const Substance*, std::uint32_t> known;
  for (std::uint32_t v = 0; v < found.size(); ++v) {
    if (!arrangement.inside(v)) continue;
    const Substance* cells = filling.cells(v);
    const auto [entry, isNew] = known.emplace(cells, FigureSet::kNone);
    if (isNew) {
      const Central& central = arrangement.central(v);
      entry->second = figures.find(
          reduced(arrangement.centrals(), central.families, {cells, central.cells.size()}));
    }
    found[v] = entry->second;
  }
  return found;
}

}  // namespace exemplar::continuous
