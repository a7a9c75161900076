// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/random.h"
#include "synth/continuous/planes.h"
#include "synth/continuous/polygons.h"

namespace exemplar::continuous {

/// Moves each plane of a model by up to `amount` (0..1) of half its family's step, so that faces
/// are not in rows. Between planes of three directions every order of them has the same vertices,
/// and all corners stay what they are; for more the example's corners could fall apart, and
/// `InputError` is thrown. The sides of the window and the ground stay. Exact: on a grid finer by
/// 16, which may be too fine for a large model (`InputError`).
void jitterPlanes(PolygonModel& model, const PlaneLattice& lattice, const ExactBox& window,
                  const std::optional<Ground>& ground, double amount, const Random& random);

}  // namespace exemplar::continuous
