// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "engine/example.h"
#include "engine/result.h"
#include "mesh/image.h"
#include "mesh/triangle_mesh.h"

/// Height maps as people see them.
namespace exemplar {

/// The example and, beside it, a result of heights as shaded relief, both in one scale, with their
/// streams; below the same without, in light from the other side. Maps of more than `longest`
/// points a side together are averaged down by a whole number.
Image8 terrainPicture(const Result& result, const Example& example, int longest = 2400,
                      const Progress& progress = {});

/// Heights as a surface: two triangles between each four points, cut along the diagonal whose ends
/// differ less; open at its border, x and y from 0, y up in the picture. Points that are NaN are
/// left out. Throws `InputError` where it would not fit in memory.
TriangleMesh meshOfHeights(const HeightMap& map, const Progress& progress = {});

}  // namespace exemplar
