// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "synth/geometry/kept_places.h"
#include "synth/geometry/objects/slice_docking.h"

namespace exemplar {

/// Which slice of an example each slice of a result comes from, along one axis. The first and the
/// last of what is solid are the example's.
struct SlicePath {
  std::vector<int> source;
  int joints = 0;        ///< places at which a slice is not followed by the next one
  double meanCost = 0;   ///< of the joints (`SliceDocking::cost`); 0 where there is none
  double worstCost = 0;  ///< the same of the worst
};

/// A path as long as the example, whose parts are out of place by up to about `amplitude` slices,
/// smoothly: some become longer, others shorter. Joints are where the example docks onto itself;
/// where that would cost too much, parts stay nearer to their place: less so the greater `pull`, >
/// 0, which is what it costs that none is out of place, in joints. Another `draw`, another path.
/// O(slices x amplitude²); deterministic.
SlicePath variedPath(const SliceDocking& docking, double amplitude, double pull,
                     std::uint64_t draw);

/// A path of `length` slices, not the example's number; the air at both ends has its share of them.
/// A longer one repeats parts that dock onto themselves, none more often than the result has to; a
/// shorter one leaves parts out. Each range of `held` is there once and whole. Empty where there is
/// none. O(length x slices²); deterministic.
SlicePath fittedPath(const SliceDocking& docking, int length, std::uint64_t draw,
                     std::span<const SliceRange> held = {});

/// The place in the example, in slices, of each slice of a result that is longer, where the example
/// does not dock onto itself: it is stretched, most where it is like a prism along the axis, and
/// least where its surface faces along it (Kraevoy, Sheffer, Shamir, Cohen-Or: "Non-homogeneous
/// resizing of complex models", SIGGRAPH Asia 2008, doi:10.1145/1409060.1409064, here for
/// slices). The sum of the squared stretches is least, each times what the slice costs
/// (`SliceDocking::change`) and a smooth random factor of the `draw`. An example without solid is
/// stretched evenly. Both ends of what is solid stay ends; the air at both has its share.
/// O(length); deterministic.
std::vector<double> stretchedPath(const SliceDocking& docking, int length, std::uint64_t draw);

}  // namespace exemplar
