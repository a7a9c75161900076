// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Heights over a regular grid of points, row 0 at the largest y (north), as in the files.
struct HeightMap {
  int width = 0, height = 0;   ///< points along x and y
  std::vector<float> heights;  ///< world units, `heights[row * width + column]`
  double cellSize = 1;         ///< distance between neighboring points, world units

  float at(int column, int row) const {
    return heights[static_cast<std::size_t>(row) * width + column];
  }
};

struct HeightMapFileOptions {
  /// World distance between neighboring points where the file does not say (.png, .pgm); > 0. By
  /// default the relief (highest less lowest point) becomes a fifth of the longer side, as in steep
  /// mountains; say 30 for a map of 30 m cells whose steps are meters.
  std::optional<double> cellSize;
  /// World height of one step of the file's integers (.png, .pgm); > 0.
  double heightScale = 1;
};

/// Whether the path ends in `.png .pgm .asc`, in any case.
bool isHeightMapFile(const std::filesystem::path& path);

/// Reads 16- or 8-bit gray `.png`, `.pgm` (P2 and P5) or an ESRI `.asc` grid (NODATA cells are
/// filled from their neighbors). Throws `InputError` naming the file for anything malformed or
/// smaller than 2 x 2.
HeightMap readHeightMap(const std::filesystem::path& path,
                        const HeightMapFileOptions& options = {});

/// Writes heights: `.asc` as they are, `.png` and `.pgm` as 16-bit steps of `heightScale`, clamped
/// to 0..65535. Whole or not at all.
void writeHeightMap(const std::filesystem::path& path, const HeightMap& map,
                    const HeightMapFileOptions& options = {});

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
/// `InputError` for options out of range and fields that would not fit in memory, and `Cancelled`.
DistanceField heightMapToSdf(const HeightMap& map, const HeightMapToSdfOptions& options = {},
                             const Progress& progress = {});

/// The height, at each column of samples, of the topmost crossing from outside to inside, linearly
/// between samples. Columns that are outside all the way have the height of the box's floor, those
/// that are inside at the top the height of its ceiling. Within half a voxel of the height map that
/// a field was made from where that is no steeper than the grid resolves. Throws `Cancelled`.
HeightMap sdfToHeightMap(const DistanceField& field, const Progress& progress = {});

}  // namespace exemplar
