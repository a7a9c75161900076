// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/pieces.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/figure_constants.h"

namespace exemplar {
namespace {

/// Solid cells x0..x1 (excluded) of one row.
struct Run {
  int x0, x1;
  std::uint32_t id;
};

void appendRuns(const Occupancy& o, int y, int z, DisjointSets& sets, std::vector<Run>& runs) {
  const int n = o.size().x;
  for (int x = 0; x < n;) {
    const std::uint64_t cells = o.bits(x, y, z);
    if ((cells & 1) == 0) {
      x += std::countr_zero(cells);
      continue;
    }
    const int first = x;
    for (int solid = 64; solid == 64; x += solid) solid = std::countr_one(o.bits(x, y, z));
    runs.push_back({first, x, sets.add()});
  }
}

/// Joins runs of neighboring rows that share a face.
void joinRows(const std::vector<Run>& runs, std::size_t a, std::size_t aEnd, std::size_t b,
              std::size_t bEnd, DisjointSets& sets) {
  while (a < aEnd && b < bEnd) {
    if (runs[a].x0 < runs[b].x1 && runs[b].x0 < runs[a].x1) sets.join(runs[a].id, runs[b].id);
    if (runs[a].x1 < runs[b].x1) {
      ++a;
    } else {
      ++b;
    }
  }
}

double perMillion(std::int64_t pieces, const DistanceField& field) {
  return 1e6 * static_cast<double>(pieces) / static_cast<double>(field.values.count());
}

/// The share of the solid that is in whole pieces.
double wholeShare(const std::vector<Component>& components) {
  std::int64_t whole = 0, all = 0;
  for (const Component& c : components) {
    all += c.cells;
    if (!c.touchesFace) whole += c.cells;
  }
  return all == 0 ? 0 : static_cast<double>(whole) / static_cast<double>(all);
}

}  // namespace

std::vector<Component> connectedComponents(const Occupancy& occupancy, const Progress& progress) {
  const Vec3i n = occupancy.size();
  DisjointSets sets(0);
  std::vector<Run> runs;
  std::vector<std::size_t> rowStart;  // rows in order of y, then z
  for (int z = 0; z < n.z; ++z) {
    progress.report("finding pieces", static_cast<double>(z) / n.z);
    for (int y = 0; y < n.y; ++y) {
      const std::size_t row = rowStart.size();
      rowStart.push_back(runs.size());
      appendRuns(occupancy, y, z, sets, runs);
      if (y > 0) joinRows(runs, rowStart[row - 1], rowStart[row], rowStart[row], runs.size(), sets);
      if (z > 0)
        joinRows(runs, rowStart[row - n.y], rowStart[row - n.y + 1], rowStart[row], runs.size(),
                 sets);
    }
  }
  rowStart.push_back(runs.size());

  std::vector<Component> byRoot(sets.count());
  for (std::size_t row = 0; row + 1 < rowStart.size(); ++row) {
    const int y = static_cast<int>(row % n.y), z = static_cast<int>(row / n.y);
    const bool border = y == 0 || z == 0 || y == n.y - 1 || z == n.z - 1;
    for (std::size_t r = rowStart[row]; r < rowStart[row + 1]; ++r) {
      Component& c = byRoot[sets.find(runs[r].id)];
      c.cells += runs[r].x1 - runs[r].x0;
      c.touchesFace |= border || runs[r].x0 == 0 || runs[r].x1 == n.x;
    }
  }
  std::erase_if(byRoot, [](const Component& c) { return c.cells == 0; });
  return byRoot;
}

Pieces comparePieces(const DistanceField& example, const DistanceField& result,
                     const Progress& progress) {
  Pieces pieces;
  std::vector<Component> components =
      connectedComponents(Occupancy(example), progress.part(0, 0.3));
  if (wholeShare(components) < kMostlyWhole) {
    auto deeper = connectedComponents(Occupancy(example, kContactDepth), progress.part(0.3, 0.6));
    if (wholeShare(deeper) >= kMostlyWhole) {
      components = std::move(deeper);
      pieces.depth = kContactDepth;
    }
  }
  std::int64_t largest = 0;
  for (const Component& c : components) {
    largest = std::max(largest, c.cells);
    if (c.touchesFace) continue;
    if (++pieces.example == 1 || c.cells < pieces.smallest) pieces.smallest = c.cells;
  }
  if (pieces.example == 0) pieces.smallest = largest;

  const Occupancy solid(result, pieces.depth);
  std::int64_t broken = 0;
  for (const Component& c : connectedComponents(solid, progress.part(0.6, 1))) {
    if (c.touchesFace) continue;
    ++pieces.result;
    if (static_cast<double>(c.cells) < kBrokenShare * static_cast<double>(pieces.smallest))
      broken += c.cells;
  }
  pieces.examplePerMillion = perMillion(pieces.example, example);
  pieces.resultPerMillion = perMillion(pieces.result, result);
  if (solid.solidCells() > 0)
    pieces.brokenShare = static_cast<double>(broken) / static_cast<double>(solid.solidCells());
  return pieces;
}

}  // namespace exemplar
