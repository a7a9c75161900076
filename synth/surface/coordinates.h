// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "synth/surface/direction_field.h"
#include "synth/surface/plane.h"
#include "synth/surface/sheet.h"

namespace exemplar::surface {

/// How the example's coordinates go on along each edge of a sheet: what local maps add up. Counted
/// in steps of a lattice.
///
/// Along periods of the example they are *stripes*: each node has a phase, and what an edge adds
/// fits the phases of its ends, so that all maps agree up to whole periods but where a row ends (a
/// dislocation).
struct Coordinates {
  struct Step {
    Vec2d by;       ///< from `a` to `b`, in the direction named at `a`
    int turns = 0;  ///< `DirectionField::turns`
  };
  int symmetry = 1;
  Lattice lattice;
  std::vector<Step> steps;                  ///< of the sheet's edges
  std::vector<Vec2d> phases;                ///< n where the lattice has periods, else none: 0..1
  std::vector<std::uint32_t> dislocations;  ///< triangles around which phases do not close
  std::vector<std::uint8_t> singular;       ///< m: whether directions turn around a triangle

  /// What a step counted in the direction named at a node is in one that is `turns` turns further
  /// back.
  const Mat2d& turned(int turns) const { return turns_[static_cast<std::size_t>(turns)]; }
  /// The step along a link, in the direction named where it begins, and the turns there.
  Step along(const Sheet::Link& link) const;

  void setTurns();

 private:
  std::vector<Mat2d> turns_;
};

/// Integrates the field: a sample of the example is `sample` long on the surface, times its size.
/// With periods, phases are the eigenvectors of the smallest eigenvalue of the energy of Knöppel,
/// Crane, Pinkall, Schröder ("Stripe patterns on surfaces", SIGGRAPH 2015, doi:10.1145/2767000,
/// section 3), one for each period, together where the field's turns exchange them. Phases then
/// spread with length 1 at every node (steps of a Ginzburg-Landau flow), and each moves to where
/// its neighbors want it.
///
/// `field.symmetry` is 1 or 2 with periods, or 4 where both are as long and across each other. The
/// same bytes at any number of threads. Throws `Cancelled`.
Coordinates integrate(const Sheet& sheet, const DirectionField& field, const Lattice& lattice,
                      double sample, const Progress& progress = {});

}  // namespace exemplar::surface
