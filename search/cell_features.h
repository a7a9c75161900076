// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "search/block_match.h"
#include "search/kernels.h"

namespace exemplar {

/// How a block is cut into up to eight cells, each axis into two parts. Bits 0, 1, 2 of a cell's
/// number say in which part of x, y, z it lies; an axis of one sample is one part.
struct CellLayout {
  /// `equal`: all cells have the same size; a middle sample of odd sides belongs to none.
  CellLayout(const Vec3i& block, bool equal);

  bool there(int cell) const { return size[cell].x > 0; }
  std::array<Vec3i, 8> first{}, size{};  ///< of each cell, in samples; size 0 where it is not there
};

/// Features of cells: inner products with orthonormal polynomials (the mean, slopes, curvatures:
/// products of discrete Legendre polynomials along the axes), as whole numbers from 0 to 32767.
///
/// By Bessel's inequality the sum of squared differences of a cell's features never exceeds that of
/// its samples (times `scale()`²), which is equation 2 of Lagae 2004 for averages. Rounding is
/// accounted for: a feature's number is off by at most `margin()`.
class CellFeatures {
 public:
  static constexpr int kCount = kernels::kFeatures;
  using Numbers = std::array<std::int16_t, kCount>;
  /// By axis, degree and sample.
  using Polynomials = std::array<std::vector<std::vector<double>>, 3>;

  /// For values from `low` to `high`; others are no error, only bounded less tightly.
  /// The mean and the three polynomials up to degree two that vary most over cells of the sources.
  template <class Sample>
  CellFeatures(const CellLayout& layout, std::span<const Array3D<Sample>* const> sources,
               double low, double high);

  /// Numbers a unit of an orthonormal coefficient: differences of samples, summed squared, times
  /// scale()² bound the sums of squared differences of numbers from above.
  double scale() const { return scale_; }
  int margin() const { return margin_; }
  /// Whether feature `f` of a cell says anything: small cells have no high degrees.
  bool there(int cell, int f) const;

  /// The features of all cells of this size, at the index of the cell's first sample in an array of
  /// the source's size less the cell's plus one. O(samples × (sum of the cell's sides)), parallel.
  template <class Sample>
  Array3D<Numbers> ofSource(const Array3D<Sample>& source, const Vec3i& cell) const;

  /// The ranges in which the features of a block at distance 0 lie. Cells known in part say what
  /// their known samples' mean and the source's slopes leave possible of the whole mean: `slopes`
  /// are the largest differences of neighboring samples along each axis.
  template <class Sample>
  kernels::QueryFeatures ofQuery(const BlockQuery<Sample>& query, const Vec3d& slopes) const;

 private:
  std::int16_t number(double coefficient) const;

  CellLayout layout_;
  std::array<Polynomials, 8> polynomials_;                                 // of each cell
  std::array<std::array<std::vector<std::vector<float>>, 3>, 8> weights_;  // the same, rounded
  std::array<Vec3i, kCount> degrees_{};
  double middle_ = 0, scale_ = 1;
  int margin_ = 1;
};

/// An upper bound on the difference between the mean of a field over a cell and over the cell's
/// known samples, for a field whose neighboring samples differ by at most `slopes` along x, y and
/// z: the cost of moving the one distribution into the other, axis after axis (Knothe and
/// Rosenblatt). Infinite where none is known.
double meanShift(const Array3D<std::uint8_t>& known, const Vec3i& first, const Vec3i& size,
                 const Vec3d& slopes);

/// Polynomials of degree 0, 1, ... (at most `count`, at most `length`) on `length` points,
/// orthonormal.
std::vector<std::vector<double>> orthonormalPolynomials(int length, int count);

}  // namespace exemplar
