// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>

#include "core/array3d.h"
#include "core/axes.h"
#include "core/progress.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// The field as it is contoured: in units in which neighbors differ by about 1 where the surface
/// runs through, one layer of samples added on each side, index space for positions.
class ContourField {
 public:
  /// Beyond this many typical differences a sample says no more than its sign.
  static constexpr float kSaturation = 8;

  /// Closed by the box's faces if `close`, but for those across the axes along which it wraps.
  ContourField(const DistanceField& field, bool close, const Axes& wraps, const Progress& progress);

  /// The size without the added layers.
  const Vec3i& size() const { return size_; }
  bool close() const { return close_; }
  const Axes& wraps() const { return wraps_; }
  const Array3D<float>& padded() const { return padded_; }

  float at(int i, int j, int k) const { return padded_(i + 1, j + 1, k + 1); }

  /// What the box's faces on the sides `side` (as of `face`) of outer sample `p` have: the sample's
  /// value carried on; halfway between the first and the last sample where the field wraps.
  double atFace(const Vec3i& p, const Vec3i& side) const {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3i q = p;
      for (int a = 0; a < 3; ++a) {
        if (side[a] != 0 && wraps_[a]) q[a] = (corner >> a & 1) ? 0 : size_[a] - 1;
      }
      sum += at(q.x, q.y, q.z);
    }
    return sum / 8;
  }

  /// Whether the cell from sample `cell` to its upper neighbor lies in the box's face of `axis`:
  /// -1 the lower one, 1 the upper one, 0 inside.
  int face(int cell, int axis) const { return cell < 0 ? -1 : cell >= size_[axis] - 1 ? 1 : 0; }
  /// Where the face lies.
  double facePlane(int side, int axis) const { return side < 0 ? -0.5 : size_[axis] - 0.5; }

  /// Between samples: tricubic, constant beyond the outer samples; cut by the box where it closes.
  double value(const Vec3d& p) const;
  /// The same without the cut, and its gradient.
  double smoothValue(const Vec3d& p, Vec3d* gradient) const;

 private:
  Vec3i size_;
  bool close_;
  Axes wraps_;
  Array3D<float> padded_;
};

}  // namespace exemplar
