// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/pieces.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/figure_constants.h"
#include "measure/solid_runs.h"

namespace exemplar {
namespace {

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
  SolidRuns runs(occupancy, progress);
  std::vector<Component> byRoot(runs.count());
  for (int z = 0; z < n.z; ++z)
    for (int y = 0; y < n.y; ++y) {
      const bool border = y == 0 || z == 0 || y == n.y - 1 || z == n.z - 1;
      for (const SolidRuns::Run& run : runs.row(y, z)) {
        Component& c = byRoot[runs.component(run)];
        c.cells += run.x1 - run.x0;
        c.touchesFace |= border || run.x0 == 0 || run.x1 == n.x;
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
