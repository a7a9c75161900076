// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/cells.h"
#include "synth/model/network.h"
#include "synth/model/synthesize.h"

namespace exemplar {

/// Which of a request's demands count: to find out which of them exclude each other.
struct ModelDemands {
  std::vector<bool> pins;
  std::array<bool, 6> sides{true, true, true, true, true, true};
};

/// A request as a network: cells in column order (x outermost, then y, z, time), each with the
/// labels that the request alone leaves it. Holes are no cells, and of cells that are images of
/// each other only one is a cell.
class ModelProblem {
 public:
  /// Both arguments must outlive the problem. Throws `InputError` as `synthesizeModel` does.
  ModelProblem(const Adjacency& adjacency, const ModelOptions& options,
               const Progress& progress = {});

  const Adjacency& adjacency() const { return *adjacency_; }
  const ModelOptions& options() const { return *options_; }
  const LabelNetwork& network() const { return network_; }
  const SymmetryGroup& symmetry() const { return symmetry_; }
  /// The steps to a cell's neighbors along the even slots of the network; the odd ones go back.
  const std::vector<CellOffset>& offsets() const { return offsets_; }

  /// The grid's positions, holes and images included, in column order.
  std::int64_t positions() const { return volume(options_->size) * options_->frames; }
  std::int64_t position(const Vec3i& p, int frame = 0) const {
    const Vec3i& n = options_->size;
    return ((std::int64_t{p.x} * n.y + p.y) * n.z + p.z) * options_->frames + frame;
  }
  Vec3i cellAt(std::int64_t position) const;
  /// Whether a height is the example's from the bottom up: where the result does not tile along z,
  /// and bottom or top has a rule.
  bool heightsDiffer() const {
    return !options_->periodic.z &&
           (options_->sides[4].excludes() || options_->sides[5].excludes());
  }
  int frameAt(std::int64_t position) const { return static_cast<int>(position % options_->frames); }
  /// The network's cell at a position, or -1 at a hole.
  int cell(std::int64_t position) const { return cellOf_[position]; }
  /// The first position of a network's cell.
  std::int64_t positionOf(int cell) const { return positionOf_[cell]; }
  /// The cells of the network in a box of the grid and in the frames from `first` to before `last`,
  /// ascending, each once. What reaches over a periodic side, or the end of a loop, continues at
  /// the other one; what reaches over other sides is left out. O(positions).
  std::vector<std::int32_t> cellsIn(const CellBox& box, int first, int last) const;
  /// The same: the cells up to `reach` steps away from one, along each axis and in time.
  std::vector<std::int32_t> cellsAround(int cell, int reach) const;
  /// The label at a position where the network's cell there has `label`.
  Label labelAt(std::int64_t position, Label label) const {
    return symmetry_.image(imageOf_.empty() ? 0 : imageOf_[position], label);
  }

  /// All demands.
  ModelDemands demands() const;
  /// The labels that the demands leave each cell, before any propagation; O(cells).
  LabelSets domains(const ModelDemands& demands, const Progress& progress = {}) const;

  /// The weight of a label at a cell: the user's weights and maps, without frequencies.
  double weight(int cell, int label) const;
  bool weightVaries() const { return !options_->weightMaps.empty(); }

 private:
  void checkOptions() const;
  void buildCells(const Progress& progress);
  void buildNetwork(const Progress& progress);
  /// The position at an offset, or -1 outside the grid.
  std::int64_t offsetPosition(std::int64_t position, const CellOffset& offset) const;

  const Adjacency* adjacency_;
  const ModelOptions* options_;
  SymmetryGroup symmetry_;
  LabelNetwork network_;
  std::vector<CellOffset> offsets_;
  std::vector<std::int32_t> cellOf_;
  std::vector<std::int32_t> positionOf_;  // a grid has at most 2^30 positions
  std::vector<std::uint8_t> imageOf_;
  LabelSets unary_;  // what symmetry alone leaves; without rows where it is not symmetric
};

}  // namespace exemplar
