// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/array3d.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Where along an axis an example docks onto itself (Bokeloh, Wand, Seidel: "A connection between
/// partial symmetry and inverse procedural modeling", SIGGRAPH 2010, doi:10.1145/1778765.1778841,
/// section 3, for translations along one axis and cuts that are nearly planar): before which two
/// slices its surroundings agree, so that one part may go on as the other does.
///
/// A joint need not be flat: each column of samples across it is cut where both sides agree best,
/// within `kJointReach` slices. If they differ by d voxels there, up to 3, that costs (d + d²) / 2;
/// a joint's cost is the sum over columns as a share of how many columns of a slice the surface is
/// near on the mean.
class SliceDocking {
 public:
  /// Slices to either side of a joint in which it may lie.
  static constexpr int kJointReach = 4;

  /// O(slices² x 2,048 x kJointReach), in parallel; the same at any number of threads. Throws
  /// `Cancelled`.
  SliceDocking(const DistanceField& example, int axis, const Progress& progress = {});

  int slices() const { return slices_; }
  /// The first slice that holds anything solid, and the one after the last; equal where none does.
  int solidBegin() const { return solidBegin_; }
  int solidEnd() const { return solidEnd_; }
  /// How much of a slice is solid, as a share of the mean of those that hold anything solid.
  double section(int slice) const { return sections_[static_cast<std::size_t>(slice)]; }
  /// How much the surface near a slice changes along the axis: the mean of the squared slope of the
  /// distance, 0 where the surface is that of a prism to 1 where it faces along the axis, or where
  /// there is none.
  double change(int slice) const { return changes_[static_cast<std::size_t>(slice)]; }
  /// What it costs that `next` comes where `usual` would. Symmetric; 0 where they are one.
  float cost(int usual, int next) const {
    return costs_[static_cast<std::size_t>(usual) * static_cast<std::size_t>(slices_) +
                  static_cast<std::size_t>(next)];
  }

 private:
  int slices_ = 0, solidBegin_ = 0, solidEnd_ = 0;
  std::vector<double> sections_, changes_;
  std::vector<float> costs_;
};

}  // namespace exemplar
