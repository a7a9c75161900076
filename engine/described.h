// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/axes.h"
#include "engine/example.h"
#include "measure/example_nature.h"

namespace exemplar {

/// What an example is, as synthesis sees it.
struct DescribedExample {
  ExampleNature nature;  ///< of its solid; of labels, of the cells that are not empty
  double cell = 1;       ///< world length of a sample or cell
  Axes stationary;       ///< of distances: along which its parts may move, unless it is said
  std::array<std::string, 3> why;  ///< for each axis, one clause
};

/// Of the form Field or Labels. O(samples).
DescribedExample describe(const Example& example);

/// For people, a label and a text each: "samples" or "cells", "solid", "sides" and, of
/// distances, "stationary", "along x", "along y" and "along z".
std::vector<std::pair<std::string, std::string>> readable(const DescribedExample& described,
                                                          Form form);

}  // namespace exemplar
