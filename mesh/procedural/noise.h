// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/random.h"
#include "core/vec.h"

namespace exemplar {

/// Smooth noise in the plane: random values at the points of a unit lattice, blended between them
/// by fifth-degree steps. In -1..1, mean 0; anywhere in the plane; twice differentiable.
double latticeNoise(const Random& random, double x, double y, std::uint32_t draw = 0);

/// `octaves` of lattice noise, each of twice the frequency and `gain` times the amplitude.
double fractalNoise(const Random& random, double x, double y, int octaves, double gain = 0.5);

/// Points of a rectangle no two of which are nearer than `distance`: dart throwing on a grid, each
/// dart a function of the seed. About 0.7 points for each distance². x in [0, width), y in [0,
/// height), z 0.
std::vector<Vec3d> scatteredPoints(const Random& random, double width, double height,
                                   double distance);

/// The nearest of several places, and how far it and the next one are (Worley: "A cellular texture
/// basis function", SIGGRAPH 1996).
struct TwoNearest {
  std::size_t which = 0;
  double first = std::numeric_limits<double>::max(), second = first;
};

/// `distance(n)` is that of place n, of `count`.
template <typename Distance>
TwoNearest twoNearest(std::size_t count, const Distance& distance) {
  TwoNearest found;
  for (std::size_t n = 0; n < count; ++n) {
    const double d = distance(n);
    if (d < found.first) {
      found.second = found.first;
      found.first = d;
      found.which = n;
    } else {
      found.second = std::min(found.second, d);
    }
  }
  return found;
}

}  // namespace exemplar
