// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "maps/height_map.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Heights as a surface: two triangles between each four points, cut along the diagonal whose ends
/// differ less; open at its border, x and y from 0, y up in the picture. Points that are NaN are
/// left out. Throws `InputError` where it would not fit in memory.
TriangleMesh meshOfHeights(const HeightMap& map, const Progress& progress = {});

}  // namespace exemplar
