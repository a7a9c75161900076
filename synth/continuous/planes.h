// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "synth/continuous/exact.h"
#include "synth/continuous/solids.h"

/// The planes on which faces of a result may lie.
namespace exemplar::continuous {

/// Families of parallel planes at equal distances: normal . x = phase + k step. All planes of the
/// example are among them, so that the example itself is a valid result, and its corners repeat
/// however many planes meet there: the places where planes of a set of families meet are a coset of
/// the lattice { e : n_i . e = 0 mod step_i }, which has full rank. This is what the thesis,
/// equation 4.25, solves for, and leaves open where the equations have no solution: with integer
/// normals they always do.
struct PlaneLattice {
  std::vector<Vec3l> normals;  ///< canonical, sorted
  std::vector<std::int64_t> phases, steps;
  Vec3l spacing;  ///< distance of planes along each axis; where it has none, the example's measure
  Vec3l origin;   ///< where the planes along each axis are counted from: the example's low corner

  /// The index of a normal, or -1.
  int familyOf(const Vec3l& normal) const;
};

/// The steps are the greatest common divisors of the distances between the example's parallel
/// planes; those of a family with one plane, `spacing`, which is by default the greatest common
/// divisor of the steps along the axes. A `spacing` that is given divides all steps.
PlaneLattice latticeOf(const Solids& solids, std::optional<std::int64_t> spacing = {});

/// A box with planes, its six sides among them.
struct PlaneSets {
  ExactBox window;
  std::vector<Vec3l> normals;                      ///< the lattice's, then axes that it lacks
  std::vector<std::vector<std::int64_t>> offsets;  ///< of each family, ascending
  std::size_t latticeFamilies = 0;                 ///< how many are the lattice's
};

/// The box of a result of `size` spacings from the example's low corner (or the ground) on, with
/// one spacing more on every side, which stays empty, or bare ground.
ExactBox windowOf(const PlaneLattice& lattice, const Vec3i& size);
/// The example's size in spacings.
Vec3i sizeInSpacings(const PlaneLattice& lattice, const Solids& solids);

/// The planes that cross a box, and the sides of another one within it. Throws `InputError` where
/// that is out of range, or axes and normals are more than `kMostFamilies`.
PlaneSets planesIn(const PlaneLattice& lattice, const ExactBox& window);
PlaneSets planesIn(const PlaneLattice& lattice, const ExactBox& window, const ExactBox& inner);

}  // namespace exemplar::continuous
