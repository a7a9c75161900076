// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/array3d.h"
#include "core/vec.h"

namespace exemplar {

/// The steps after which an example nearly repeats: integer combinations of up to three basis
/// vectors, in samples. They need not be whole samples, nor along the axes.
struct Repetition {
  std::vector<Vec3d> basis;  ///< 0 to 3, linearly independent; empty: it does not repeat

  bool any() const { return !basis.empty(); }
  /// Whether a step is one of them, to within `tolerance` samples along each axis. Only its part in
  /// the span of the basis counts: along other directions any step will do.
  bool holds(const Vec3i& step, double tolerance) const;
  /// The step of theirs that is nearest to this one, to the sample; what of it is not in their span
  /// stays.
  Vec3i nearest(const Vec3i& step) const;
  /// The same on a grid of samples that are `factor` times smaller.
  Repetition refined(double factor) const;
  /// The length of the basis vector along this axis, if a single one has a part along it and nearly
  /// none aside; else 0.
  double periodAlong(int axis) const;
  /// Makes `length` a whole number of periods along this axis, where it has a period and that moves
  /// what is `apart` samples apart by at most `tolerance`; else returns false.
  bool stretch(int axis, int length, int apart, double tolerance);
  /// How long the basis vectors are along each axis at most, samples, rounded up.
  Vec3i cell() const;

 private:
  /// How far a step is off the nearest of theirs, within their span.
  Vec3d off(const Vec3i& step) const;
};

/// Finds them. How unlike the example is to itself one step on is the mean difference of its
/// values, cut off at two, at samples within one of the surface; the example repeats where that has
/// a strict local minimum far below what steps have in general, and the combinations of such steps
/// have them too. So what is woven, laid, or built on a grid repeats, with parts that are a little
/// out of place; random packings, ground, and what only continues along an axis do not.
///
/// `values` is in samples (distances, negative inside). Steps of up to 0.7 of its length are seen,
/// and basis vectors of up to 0.6 of it are found. O(steps x 1024); the same at any number of
/// threads.
Repetition findRepetition(const Array3D<float>& values);

}  // namespace exemplar
