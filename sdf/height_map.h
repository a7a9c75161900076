// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/progress.h"
#include "maps/height_map.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

struct HeightMapToSdfOptions {
  double voxelSize = 0;  ///< world units, > 0; 0 means: `resolution` decides
  int resolution = 64;   ///< samples along the box's longest side where voxelSize is 0; 1..4096
  int air = 4;           ///< voxels above the highest point, >= 0
  int ground = 4;        ///< voxels below the lowest point, >= 0
  double halfWidth = 3;  ///< the distance is exact up to this many voxels, then clamped; > 0;
                         ///< infinite: exact everywhere
};

/// The signed distance of the ground under a height map, in world units without exaggeration: x
/// from 0 to the map's width, y to its depth, z as the heights are. The ground continues past
/// the box's sides, mirrored at the map's border, and downwards: the field has no walls and no
/// floor.
///
/// The surface is triangulated between the points, each cell along the diagonal whose ends differ
/// less in height; maps with more than four points a voxel along an axis
/// are averaged down to two to four first. The same bytes at any number of threads. Throws
/// `InputError` for options out of range, for maps with holes (`fillHoles`) and fields that would
/// not fit in memory, and `Cancelled`.
DistanceField heightMapToSdf(const HeightMap& map, const HeightMapToSdfOptions& options = {},
                             const Progress& progress = {});

/// The height, at each column of samples, of the topmost crossing from outside to inside, linearly
/// between samples. Columns that are outside all the way have the height of the box's floor, those
/// that are inside at the top the height of its ceiling. Within half a voxel of the height map that
/// a field was made from where that is no steeper than the grid resolves. Throws `Cancelled`.
HeightMap sdfToHeightMap(const DistanceField& field, const Progress& progress = {});

}  // namespace exemplar
