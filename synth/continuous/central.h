// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "synth/continuous/exact.h"

/// The surroundings of a point, cut by the planes through it.
namespace exemplar::continuous {

/// A set of families of parallel planes, by their indices: bit i stands for family i.
using Families = std::uint32_t;

/// The central arrangement of some families: their planes through the origin cut space into cells
/// (cones) that meet in rays. Cells and rays are named by the families that they are above of, on
/// the positive side; a ray is also on some.
struct Central {
  struct Ray {
    Vec3l direction;                    ///< primitive
    Families on = 0;                    ///< whose planes contain it
    Families above = 0;                 ///< on whose positive side it is; below all that are left
    std::uint32_t opposite = 0;         ///< the index of the opposite ray
    std::vector<std::uint32_t> around;  ///< cells around it, ordered by the families `on`
  };

  Families families = 0;
  int rank = 0;                 ///< of the normals, 0..3
  std::vector<Families> cells;  ///< each: the families it is above of; ascending
  std::vector<Ray> rays;        ///< for rank 3, ordered by direction; else none
  /// For rank 3: rays of each cell's border. Any sum of them with positive weights is inside it.
  std::vector<std::vector<std::uint32_t>> raysOfCell;

  /// The index of a cell, which must be one.
  std::uint32_t cell(Families above) const;
  /// The index of the ray of a direction; throws `std::logic_error` where there is none.
  std::uint32_t ray(const Vec3l& direction) const;
};

/// The central arrangements of sets of families, made when they are first asked for. Thread-safe;
/// what it returns stays where it is.
class Centrals {
 public:
  /// Canonical normals, no two equal, at most `kMostFamilies`.
  explicit Centrals(std::vector<Vec3l> normals) : normals_(std::move(normals)) {}

  const std::vector<Vec3l>& normals() const { return normals_; }
  const Central& of(Families families) const;

 private:
  std::vector<Vec3l> normals_;
  mutable std::mutex mutex_;
  mutable std::map<Families, std::unique_ptr<const Central>> made_;
};

/// Calls `body(i)` for each family of a set, ascending.
template <class Body>
void forEachFamily(Families families, Body&& body) {
  for (; families != 0; families &= families - 1) body(__builtin_ctz(families));
}

}  // namespace exemplar::continuous
