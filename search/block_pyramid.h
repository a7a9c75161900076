// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/array3d.h"

/// Block pyramids (Lagae, Dumont, Dutré: "Geometry Synthesis", report CW 381, K.U.Leuven, 2004,
/// sections 4.1 and 4.2) and the two bounds that matching rests on.
///
/// Level l of a block's pyramid holds the averages of its 2^(l-1) cells a side; level 1 is one
/// cell, the last level the samples themselves. For two blocks let d be their difference. In a cell
/// C,
///
///     mean of d² over C = (mean of d over C)² + variance of d over C.                          (*)
///
/// Equation 2: variances are not negative, so a level's distance never exceeds the next one's.
///
/// Equation 3: the variance of d over C is at most (s + s')², where s and s' are the two blocks'
/// standard deviations over C (Minkowski). For a field that is L-Lipschitz (a distance field in
/// units of its voxels has L = 1), and u, v independent and uniform on the cell's samples,
///
///     s² = ½ E (b(u) − b(v))² ≤ ½ L² E |u − v|² = L² (r² − 1) / 4
///
/// for a cell of r³ samples, the variance of each coordinate being (r² − 1) / 12. So by (*)
///
///     dist(finest level) ≤ dist(level of cells of r³) + ε,   ε = (2 s)² ≤ L² (r² − 1).
///
/// One step (r = 2, in units of the finer level's spacing) has ε = 3 L². The paper's appendix A.2
/// takes the squared distance of neighbors for a 1D step and adds a step's ε once a level, with
/// averages that it no longer constrains; here all levels are crossed at once, with the constraint
/// in full.
///
/// It holds for fields that are L-Lipschitz between all samples of a cell, in Euclidean distance.
/// It does not hold for synthesized targets, noise or random seeding, and for quantized fields only
/// with the rounding counted in (each difference moves by up to one level). `cellDeviation`
/// measures s instead of assuming it, and then equation 3 holds for any field.
namespace exemplar {

/// log2 of `blockSize`. Throws `InputError` unless it is a power of two, 1..1024.
int blockLevels(int blockSize);

/// ε of equation 3 between a level whose cells have `cellSide`³ samples and the samples themselves,
/// for two fields that change by at most `lipschitz` a sample's spacing: lipschitz² (cellSide² −
/// 1).
double lipschitzEpsilon(int cellSide, double lipschitz);

/// The globally subsampled field that all block pyramids are windows into (section 4.1): for each
/// level and *each* position of a cell's first sample, the cell's average, rounded to one of 256
/// levels (halves up).
///
/// Rounding averages breaks equation 2 by itself: `cellSums` says what a rounded average still says
/// for certain, and the bounds use that.
class SlidingPyramid {
 public:
  /// Averages over cells of 1, 2, 4, ..., `largestCell` samples a side, a power of two up to 256.
  /// O(samples x scales), parallel; 1 byte a sample and scale.
  SlidingPyramid(Array3D<std::uint8_t> source, int largestCell);

  /// log2 of the largest cell's side.
  int scales() const { return static_cast<int>(averages_.size()) - 1; }
  /// The averages of the cells of 2^`scale` samples a side, at the index of the cell's first
  /// sample; 0 is the source itself. All of the source's size, so that indices agree; 0 where a
  /// cell would reach beyond it.
  const Array3D<std::uint8_t>& averages(int scale) const { return averages_[scale]; }
  /// For each scale the largest standard deviation of a cell, anywhere in the source, taking the
  /// averages of scale `finest` as its samples; 0 for `finest` and below. O(samples x scales).
  std::vector<double> cellDeviations(int finest = 0) const;

 private:
  std::vector<Array3D<std::uint8_t>> averages_;
};

/// The whole numbers that the sum of a cell's (2^(scale - finest))³ finest averages may be, when
/// the cell's own average was rounded to `average`; both ends included.
struct SumRange {
  std::int64_t low, high;
};
SumRange cellSums(int average, int scale, int finest);

}  // namespace exemplar
