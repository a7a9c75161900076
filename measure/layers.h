// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "maps/layer_map.h"

namespace exemplar {

/// One layer of a result against the example's.
struct LayerLikeness {
  int layer = 2;
  double areaError = 0;  ///< share of cells inside, less the example's; 0 is best
  /// Boundary cells per cell over the example's; 1 is best. Nothing where the example has none.
  std::optional<double> boundaryRatio;
  /// The two directions of the distance of shapes (Rosenberger, Cohen-Or, Lischinski 2009,
  /// equations 1 to 3): the mean distance of the result's boundary patches (of 15 x 15 pixels, in
  /// space of 9 x 9 x 9 cells) to
  /// their nearest of the example (is everything here from there?), and of the example's to their
  /// nearest of the result (is everything from there here?), as shares of the patch; 0 is best.
  std::optional<double> toExample, toResult;
  /// How evenly the example's boundary is used: exp(H) of the entropy H of which of its patches are
  /// the nearest of the result's, over how many there could be; near 0 where few places serve all.
  /// Two independent samples of noise have .4 to .5, of discs that are all alike .15 to .25.
  std::optional<double> usage;
  /// The longest stretch of the result's boundary, in pixels, that is one of the example's, moved
  /// and turned by quarters: where patches at every step differ in 3 % of their pixels at most. 12
  /// to 20 in independent samples of noise. Nothing in space.
  std::optional<std::int64_t> longestRun;
  /// Kolmogorov-Smirnov distance of the sizes of components, 0..1; 0 is best. What patches do not
  /// see. Nothing where either has none.
  std::optional<double> componentSizes;
};

/// A layer map against its example.
struct LayersLikeness {
  std::vector<LayerLikeness> layers;
  double skipping = 0, exampleSkipping = 0;  ///< `skippingShare`
  /// Of windows of 32 x 32 pixels (in space 16 x 16 x 16 cells) with two layers or more, the share
  /// that occurs elsewhere in the same map but for 3 % of its cells, and the same of the example. 0
  /// is best.
  std::optional<double> repeated, exampleRepeated;
};

/// Measures layers, flat or in space, which are taken for a torus, against their example's. Up to
/// 2,000 patches of each are looked up among all (up to 20,000) of the other. The same at any
/// number of threads. Throws `InputError` where the result has layers that the example has not, or
/// one of the two is flat and the other is not, and `Cancelled`.
LayersLikeness measureLayers(const LayerVolume& example, bool exampleWraps,
                             const LayerVolume& result, const Progress& progress = {});

}  // namespace exemplar
