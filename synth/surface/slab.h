// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "sdf/distance_field.h"
#include "synth/surface/plane.h"

namespace exemplar::surface {

/// An example that lies flat, as columns: over each place (x, y) of its plane, in samples, what is
/// there along z.
class Slab {
 public:
  /// The example, whose top is air. Throws `InputError` where solid is cut at its top, or where it
  /// has no surface, saying what would be right.
  explicit Slab(const DistanceField& example);

  const Vec3i& size() const { return values_.size(); }
  /// Whether its lowest layer is solid: ground that goes on downward.
  bool grounded() const { return grounded_; }
  /// Heights along z, in samples: of the lowest and the highest place of the surface (of grounded
  /// ones, of the ground's).
  double low() const { return low_; }
  double high() const { return high_; }
  /// Of the highest solid of all.
  double top() const { return top_; }

  /// Distance at a place and a height, in samples; cubic (`cubicAt`), going on beyond the box as
  /// far as the way out of it is long.
  double value(const Vec2d& at, double z) const;
  /// Whether a place has a column.
  bool has(const Vec2d& at) const {
    return at.x >= 0 && at.y >= 0 && at.x <= size().x - 1 && at.y <= size().y - 1;
  }

  /// What columns are compared by: distances up to two samples on either side, in 60ths of one, at
  /// so many heights.
  static constexpr double kLimit = 2, kSteps = 60;
  int heights() const { return heights_; }
  /// The nearest column to a place that has one: `heights()` numbers.
  std::span<const std::int8_t> column(const Vec2d& at) const;
  /// The same, bilinear between columns.
  void column(const Vec2d& at, std::int8_t* out) const;

 private:
  Array3D<float> values_;  // samples
  bool grounded_ = false;
  double low_ = 0, high_ = 0, top_ = 0;
  int heights_ = 0;
  std::vector<std::int8_t> columns_;  // y, then x, then heights
};

/// How a slab can be turned about z, and about which place, so that it goes on as before.
struct SlabSymmetry {
  int turns = 1;   ///< of 2 pi / turns: 1, 2 or 4
  Vec2d middle{};  ///< samples: a place about which it is turned, where the example repeats
};

/// The turns that leave a slab as it is. Where it repeats, those that leave it in place after some
/// step; else those after which its parts look as much like it as parts of itself do. `lattice` is
/// made exactly square where the slab has quarter turns. Deterministic.
SlabSymmetry findSymmetry(const Slab& slab, Lattice& lattice,
                          std::optional<int> wanted = std::nullopt);

/// Steps after which an example repeats, as steps in its plane: of up to three, the two that lie in
/// it most; those that lead upward are left out.
Lattice latticeOf(std::span<const Vec3d> basis);

}  // namespace exemplar::surface
