// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "measure/example_nature.h"
#include "measure/occupancy.h"

/// Whether a result holds together as its example does: what fell to pieces, floats, was sliced or
/// torn, and where its solid is.
namespace exemplar {

/// What one volume is made of. `nature` says where its example's box cuts.
struct Integrity {
  /// Connected components of at least `kSpeckCells` cells, those at the box's faces included.
  std::int64_t pieces = 0;
  /// The largest one's share of the solid, 0..1.
  double largestShare = 0;
  /// The share of the solid in components that nothing holds: that neither begin on the ground (the
  /// lowest layer of the largest component, and two above it), nor touch a side of the box that the
  /// example is cut at, nor lie upon (with up to two empty cells between) one that is held. 0..1.
  double floatingShare = 0;
  /// For each direction that a surface may face (-x, +x, -y, +y, -z, +z), the share of all exposed
  /// faces of cells that are in flat squares of `kFlatSide` faces a side of one plane. The box's
  /// own faces count where the example has air there: what is solid at them was cut off.
  std::array<double, 6> flat{};
  /// The share of all exposed faces that is at sides of the box where the example has air.
  double openShare = 0;
  std::int64_t faces = 0;      ///< exposed faces of cells
  std::int64_t tunnels = 0;    ///< ways through the solid (the genus, summed over components)
  std::int64_t bubbles = 0;    ///< pockets of air that the solid encloses
  std::vector<double> layers;  ///< the solid share of each layer, from below
};

inline constexpr std::int64_t kSpeckCells = 8;  ///< smaller components are dust, no pieces
inline constexpr int kFlatSide = 6;             ///< cells

/// Solid cells are connected through faces, air through corners, too. O(cells), about 30 ns each;
/// the same at any number of threads. Throws `Cancelled`.
Integrity integrityOf(const Occupancy& volume, const ExampleNature& nature,
                      const Progress& progress = {});

/// A result beside its example.
struct Wholeness {
  std::int64_t pieces = 0, examplePieces = 0;
  double largestShare = 0, exampleLargestShare = 0;
  double floatingShare = 0, exampleFloatingShare = 0;
  /// Flat area for each exposed face, over all directions, and how far it is above the example's,
  /// direction by direction: what was sliced. 0..1.
  double flatShare = 0, exampleFlatShare = 0, slicedShare = 0;
  double openShare = 0;
  /// For each ten thousand exposed faces.
  double tunnels = 0, exampleTunnels = 0, bubbles = 0, exampleBubbles = 0;
  /// Sum over layers of |solid share of the result's - of the example's at that height|, over the
  /// sum of the example's; layers of a result that is higher or lower correspond in proportion. 0
  /// is best, 2 the worst of equal amounts. Nothing where the example has no solid.
  std::optional<double> layers;
};

Wholeness compareWholeness(const Integrity& example, const Integrity& result);
/// Throws `Cancelled`.
Wholeness measureWholeness(const Occupancy& example, const Occupancy& result,
                           const Progress& progress = {});

}  // namespace exemplar
