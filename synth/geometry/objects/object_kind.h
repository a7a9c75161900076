// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "sdf/distance_field.h"

namespace exemplar {

/// What an object that stands alone is made of, as far as that decides how it grows.
enum class ObjectKind {
  Planes,  ///< faces of few directions, or sharp edges: a building, rubble
  Limbs,   ///< round bars and thin walls without edges: a tree, a vase
  Lump     ///< all else that is thick: a boulder
};

/// By how much of the surface faces the commonest directions, how much of it is edges, and how
/// thick the object is where it is thickest; where distances inside are clamped that is unknown,
/// and taken as thick. O(samples).
ObjectKind objectKind(const DistanceField& example);

}  // namespace exemplar
