// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "sdf/triangle_tree.h"

namespace exemplar {

/// Whether two triangles meet in more than their rims: they cross, lie on each other in one plane,
/// or a side or corner of one lies in the middle of the other. Triangles that only share an edge or
/// a corner, or touch edge to edge, do not overlap. Answers in doubt (within 1e-9 of their size)
/// may go either way.
bool trianglesOverlap(const Corners& a, const Corners& b);

}  // namespace exemplar
