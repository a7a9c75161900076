// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/progress.h"
#include "maps/height_map.h"
#include "synth/terrain/terrain.h"
#include "world/phased_plane.h"

namespace exemplar {

/// Sides of the windows of `HeightWorld`: samples from one to the next.
inline constexpr int kLeastHeightWindow = 96, kMostHeightWindow = 1024;

/// How wide the rims of such windows are.
WindowLattice heightLattice(int pitch);

/// Heights to begin a world with: `synthesizeTerrain` on a torus, 8/3 windows a side. All its water
/// runs to its lowest sample.
Grid<float> heightWorldStart(std::span<const Grid<float>> examples,
                             const TerrainSynthesisOptions& options, const WindowLattice& lattice,
                             const Progress& progress = {});

/// Between which heights such a world lies: a quarter of the examples' relief beyond theirs, and
/// where it begins.
HeightRange heightWorldRange(std::span<const Grid<float>> examples, const Grid<float>& start);

/// An unbounded plane of heights like the examples'. Each part of it is a function of its rules
/// alone.
///
/// The plane begins with `start`, over and over. In three phases (`WindowLattice`) the inside of
/// every window is synthesized anew, coarse to fine, from what its rim holds: nothing but that is
/// seen, so that windows fit whoever is beside them. A window's rim is wider and narrower by turns,
/// and beside it old and new heights mix, so that no straight line shows where it ran; samples of
/// the start are left nowhere, for a rim of one phase lies inside the windows of another.
///
/// Water. Where a phase's rim is lower than what lies inside along its border, water left the
/// window there, and must do so again: these samples, and the start's lowest one where a window
/// holds it, are the only outlets that hollows are cut to. So if water ran everywhere before, it
/// does so after: a river goes on wherever it crosses a rim, and ends, with all others around it,
/// at the lowest sample of the start, once in each of its copies.
class HeightWorld {
 public:
  /// All but `cache` are copied. `options` are those of any result, its sizes and control left out;
  /// the lattice is one of `heightLattice`. Throws `InputError`.
  HeightWorld(std::span<const Grid<float>> examples, const TerrainSynthesisOptions& options,
              Grid<float> start, const WindowLattice& lattice, WindowCache& cache,
              const Progress& progress = {});
  ~HeightWorld();
  HeightWorld(const HeightWorld&) = delete;
  HeightWorld& operator=(const HeightWorld&) = delete;

  struct Region {
    Grid<float> heights;  ///< row 0 at the largest y
    Grid<HeightOrigin> origins;
  };
  /// The samples of a box, each where the examples have it. Thread-safe. Throws `Cancelled`, and
  /// `InputError` where it does not fit in memory.
  Region region(const PlaneBox& box, const Progress& progress = {}) const;

  /// Whether the start's lowest sample is at a place of the plane.
  bool takesWater(const PlanePoint& at) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace exemplar
