// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "synth/model/problem.h"

namespace exemplar {

/// A way to repeat cells along x and y: so many at either side stand for themselves, and what lies
/// between them repeats.
struct Pattern {
  int rim;
  Vec3i period;  ///< of x and y
};

/// An axis in classes: cells alike.
struct AxisClasses {
  std::vector<int> of;    ///< each index's class
  std::vector<int> some;  ///< indices, one at least for each class and the classes around it
  int count = 0;
};

/// The network of a result that repeats: cells alike are one cell, with the labels that suit all of
/// them and the neighbors of each. What is consistent in it is so in the whole, repeated, unless a
/// periodic side does not meet its opposite after whole tiles.
class Tile {
 public:
  /// The problem must outlive the tile.
  Tile(const ModelProblem& problem, const Pattern& pattern);
  /// Finds the tile's cells; false where one has no label, or there are more than `mostLabels` in
  /// all.
  bool findCells(const LabelSets& base, std::int64_t mostLabels, const Progress& progress);
  void findNeighbors();

  const LabelNetwork& network() const { return network_; }
  const LabelSets& domains() const { return domains_; }
  /// A cell of the whole network for each of the tile.
  const std::vector<std::int32_t>& members() const { return members_; }
  /// Calls `visit(cell, tile cell)` for all cells of the whole network, ascending.
  template <class Visit>
  void forEach(const Visit& visit) const {
    const ModelOptions& o = problem_.options();
    const int column = o.size.z * o.frames;
    std::int64_t at = 0;
    for (int i = 0; i < o.size.x; ++i) {
      for (int j = 0; j < o.size.y; ++j) {
        const int first = (x_.of[i] * y_.count + y_.of[j]) * column;
        for (int k = 0; k < column; ++k, ++at) {
          const int c = problem_.cell(at);
          if (c >= 0 && problem_.positionOf(c) == at) visit(c, first + k);
        }
      }
    }
  }
  int cellOf(int key) const { return number_[key]; }

 private:
  int keyOf(int cell) const;

  const ModelProblem& problem_;
  AxisClasses x_, y_;
  LabelNetwork network_;
  LabelSets domains_;
  std::vector<std::int32_t> number_;  // by class along x, y, then z and frame
  std::vector<std::int32_t> members_;
};

}  // namespace exemplar
