// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "synth/model/problem.h"

namespace exemplar {

/// How well each label would make a cell's surroundings resemble the example (Merrell 2007, section
/// 3.3): the number of places in the example whose 3 x 3 x 3 cells around the label differ from
/// what is around the cell in no more cells than the best such place of any label does.
class Resemblance {
 public:
  Resemblance(const ModelProblem& problem, std::span<const LabelGrid> examples,
              const Progress& progress = {});

  /// L(k) of equations 4 and 5 for each label of `labels`, with the threshold d0 at its least; 0
  /// for all others. `placed(cell)` is the label in place at a cell of the network, or -1: cells
  /// without one, and cells outside the grid, do not count. O(different surroundings of `labels`).
  std::vector<double> likeness(int cell, std::span<const LabelWord> labels,
                               const std::function<int(int)>& placed) const;

 private:
  static constexpr int kCells = 27;
  struct Window {
    std::array<std::uint32_t, kCells> labels;  // kOutside beyond the example
    double count;
  };

  const ModelProblem* problem_;
  std::vector<std::vector<Window>> windows_;  // of each label, all different
};

}  // namespace exemplar
