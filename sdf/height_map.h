// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/warnings.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// How a file of integers (.png, .pgm) counts heights.
struct HeightSteps {
  double size = 1;      ///< world height of one step, > 0
  int largest = 65535;  ///< the largest integer that the file can hold: 255 at 8 bits
};

/// Heights over a regular grid of points, row 0 at the largest y (north), as in the files.
struct HeightMap {
  int width = 0, height = 0;   ///< points along x and y
  std::vector<float> heights;  ///< world units, `heights[row * width + column]`
  double cellSize = 1;         ///< distance of neighboring points, world units
  /// Of the file that the heights came from, so that others can be written like it; nothing where
  /// they never were integers.
  std::optional<HeightSteps> steps;

  float at(int column, int row) const {
    return heights[static_cast<std::size_t>(row) * width + column];
  }
};

struct HeightMapFileOptions {
  /// World distance of neighboring points; > 0. By default what the file says (.asc), else (.png,
  /// .pgm) such that the relief (highest less lowest point) becomes a fifth of the longer side, as
  /// in steep mountains; say 30 for a map of 30 m cells whose steps are meters.
  std::optional<double> cellSize;
  /// World height of one step of the file's integers (.png, .pgm) or of a height of 1 (.asc); > 0.
  /// Reading takes 1 by default, writing what `HeightMap::steps` says.
  std::optional<double> heightScale;
  /// Receives a line for what is taken otherwise than the file says; null drops the lines.
  Warnings* warnings = nullptr;
};

/// Whether the path ends in `.png .pgm .asc`, in any case.
bool isHeightMapFile(const std::filesystem::path& path);

/// Reads 16- or 8-bit gray `.png`, `.pgm` (P2 and P5) or an ESRI `.asc` grid. Cells without data
/// (NODATA, up to a float's rounding; NaN; -9999 and the like where no NODATA_value is given;
/// transparent pixels) are filled from their neighbors. An `.asc` in degrees of longitude and
/// latitude under heights in meters gets cells in meters, which a warning states.
///
/// Throws `InputError` naming the file, and the line in text, for anything malformed or smaller
/// than 2 x 2, and `Cancelled`.
HeightMap readHeightMap(const std::filesystem::path& path, const HeightMapFileOptions& options = {},
                        const Progress& progress = {});

/// The same from the bytes of a file. `name` is what errors call it; its ending says the format.
HeightMap readHeightMap(std::string_view bytes, const std::string& name,
                        const HeightMapFileOptions& options, const Progress& progress = {});

/// Writes heights: `.asc` as they are, `.png` and `.pgm` as 16-bit integers. These count steps of
/// `options.heightScale` or else `map.steps`, finer where the steps came from a file of fewer bits,
/// so that 8-bit maps become 16-bit ones of the same brightness; without both, the lowest height is
/// 0 and the highest 65535, and a warning states the scale. Heights that do not fit are clamped,
/// and a warning counts them. Whole or not at all. Throws `Cancelled`.
void writeHeightMap(const std::filesystem::path& path, const HeightMap& map,
                    const HeightMapFileOptions& options = {}, const Progress& progress = {});

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
