// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "sdf/triangle_tree.h"

namespace exemplar {

/// Whether two triangles have a point in common; touching counts. Answers in doubt (within 1e-9 of
/// their size) are yes.
bool trianglesMeet(const Corners& a, const Corners& b);

/// The same for triangles that share a corner: whether they have more in common than their rims.
/// They cross, or lie on each other in one plane. Answers in doubt may go either way.
bool trianglesOverlap(const Corners& a, const Corners& b);

}  // namespace exemplar
