// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/progress.h"
#include "maps/grid.h"
#include "synth/terrain/standing_water.h"

/// Outlets for hollows: rivers that have somewhere to go.
namespace exemplar {

struct OutletOptions {
  /// How far hollows are first filled, of their depth, before an outlet is cut: 0 (cut only) to 1
  /// (filled up to where they spill over). Half moves the least earth.
  double fill = 0.5;
  /// How much a filled hollow and the bed of a cut fall toward their outlet, height per sample; >=
  /// 0.
  double fall = 0;
  /// Beside a cut land is lowered with it, by so much less a sample: what it adds to the slope of
  /// banks, which keep their shape; > 0; infinite: cuts are one sample wide.
  double bank = 1;
  /// Hollows that may stay: as shares of the samples, by size, as `Hollows::bySize` has them; what
  /// one size does not need is left to smaller ones. Where they are no more in all, all stay.
  std::span<const double> kept;
  /// Where water leaves, 1; empty: at the map's border.
  Grid<std::uint8_t> outlets;
  /// With these: how firmly samples are held, 0 to 1, so that cuts keep away from what is; may be
  /// empty.
  Grid<float> hold;
  bool wrapsX = false, wrapsY = false;
};

/// What was done for them.
struct OutletsCut {
  double flooded = 0;  ///< the share of samples below where water would run off, by `fall`, before
  std::int64_t outlets = 0;  ///< how many were cut
  double mean = 0;           ///< what was taken away, a sample
  double deepest = 0;        ///< the deepest cut
  std::int64_t left = 0;     ///< with `outlets`, pits behind what is held
};

/// Gives every hollow an outlet: water runs from every sample down to the map's border, or, on a
/// torus, to its lowest sample. The outlet of a hollow runs along the path on which a rising water
/// level would leave it, over the lowest saddle (Barnes, Lehman, Mulla 2014,
/// doi:10.1016/j.cageo.2013.04.024; Soille 2004, doi:10.1029/2004WR003060; Lindsay 2016,
/// doi:10.1002/hyp.10648), up to 1 / 262,144 of the relief. Samples where `held` (may be empty) is
/// not 0 stay, and so may what lies behind them. NaN samples are outlets. O(samples), one thread,
/// 13 bytes a sample, and as much again with hollows that may stay. Throws `Cancelled`.
///
/// With `outlets`, water leaves there alone. What lies below all ways to them is lifted, a hollow
/// of which some is held is cut and not filled, and where the lowest way leads up over what is held
/// another one is cut through what is not. If there was such a way for every held sample, nothing
/// is left flooded; exactly so, and so in O(n log n).
///
/// Bodies of water (may be null) stay flat: the sea takes all water, and each lake gets one outlet,
/// which begins at its level. Lakes that would run up into the next one come to one level with it,
/// and shores come down with water that does, and with water that lies lower than `before`, which
/// is of the heights' size or empty: then shores stay.
OutletsCut cutOutlets(Grid<float>& heights, const Grid<std::uint8_t>& held,
                      const OutletOptions& options = {}, const WaterBodies* water = nullptr,
                      const Progress& progress = {});

}  // namespace exemplar
