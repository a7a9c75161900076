// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"

namespace exemplar {

/// Heights over a regular grid of points, row 0 at the largest y (north), as in the files.
struct HeightMap {
  int width = 0, height = 0;   ///< points along x and y
  std::vector<float> heights;  ///< world units, `heights[row * width + column]`
  double cellSize = 1;         ///< distance of neighbouring points, world units

  float at(int column, int row) const {
    return heights[static_cast<std::size_t>(row) * width + column];
  }
};

struct HeightMapFileOptions {
  /// World distance of neighbouring points where the file does not say (.png, .pgm); > 0.
  double cellSize = 1;
  /// World height of one step of the file's integers (.png, .pgm); > 0.
  double heightScale = 1;
};

/// Whether the path ends in `.png .pgm .asc`, in any case.
bool isHeightMapFile(const std::filesystem::path& path);

/// Reads 16- or 8-bit grey `.png`, `.pgm` (P2 and P5) or an ESRI `.asc` grid (NODATA cells are
/// filled from their neighbours). Throws `InputError` naming the file for anything malformed or
/// smaller than 2 x 2.
HeightMap readHeightMap(const std::filesystem::path& path,
                        const HeightMapFileOptions& options = {});

/// Writes heights: `.asc` as they are, `.png` and `.pgm` as 16-bit steps of `heightScale`, clamped
/// to 0..65535. Whole or not at all.
void writeHeightMap(const std::filesystem::path& path, const HeightMap& map,
                    const HeightMapFileOptions& options = {});

/// A height map as a closed solid: its surface, walls along its border and a floor `base` world
/// units below its lowest point (`base` > 0).
TriangleMesh heightMapToMesh(const HeightMap& map, double base);

/// The height, at each column of samples, of the topmost crossing from outside to inside, linearly
/// between samples; the field's floor where there is none.
HeightMap sdfToHeightMap(const DistanceField& field);

}  // namespace exemplar
