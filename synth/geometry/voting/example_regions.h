// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/array3d.h"
#include "core/axes.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// How several examples share a result.
struct MixOptions {
  /// Each example's share of the result's surface: one for each of them, each 0..1, of sum 1.
  /// Empty: equal shares.
  std::vector<double> shares;
  /// In place of shares, what is painted: of the result's size, 0 where the first example is
  /// wanted, 1 where the last is, evenly spaced between them the others. What lies between two of
  /// them is the share of the later one there. Or none.
  std::optional<Array3D<float>> map;
};

/// Which region of a result is made of which example.
///
/// Regions are the level sets of a smooth Gaussian random field (a sum of plane waves of one
/// length, about one and a half examples, less where the result is smaller), cut at those of its
/// quantiles that give each example its share. A function of the options and the seed alone.
class ExampleRegions {
 public:
  /// `size` is the result's, in samples; regions change only along axes of `along`, and tile along
  /// those of `periodic`. Throws `InputError` for shares that are not one for each example, or do
  /// not add up to 1 within a hundredth, and for a map of another size.
  ExampleRegions(std::span<const DistanceField* const> examples, const MixOptions& mix,
                 const Vec3i& size, const Axes& along, const Axes& periodic, std::uint64_t seed);

  /// The example that the result is made of at a place, in samples.
  int at(const Vec3d& place) const;

  /// Moves the borders, given each example's share of the surface that was made within them, so
  /// that shares come nearer to those asked for, and returns how far off the farthest is. What is
  /// painted stays, and is not off.
  double correct(std::span<const double> made);

 private:
  double field(const Vec3d& place) const;
  void findTails();

  MixOptions mix_;
  Vec3i size_;
  struct Wave {
    Vec3d frequency;
    double phase;
  };
  std::vector<Wave> waves_;
  std::vector<double> sorted_;   ///< the field's values over the result
  std::vector<double> density_;  ///< of each example's surface, in its volume
  std::vector<double> tails_;    ///< volume shares of all examples after each but the last
};

}  // namespace exemplar
