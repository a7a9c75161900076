// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "core/warnings.h"
#include "maps/height_map.h"

/// Files of heights. What is written and read again is the same number, through any chain of
/// formats: to the bit in .asc, .tif and .exr, and in files of integers where the heights are
/// multiples of their steps, which they are once they have been written to one.
namespace exemplar {

/// The endings of height maps that are read and written.
inline constexpr const char* kHeightMapEndings = ".asc .tif .tiff .exr .png .pgm .r16 .raw";

struct HeightMapFileOptions {
  /// World distance of neighboring points; > 0. By default what the file or the .json beside it
  /// says, else such that the relief (highest less lowest point) becomes a fifth of the longer
  /// side, as in steep mountains; say 30 for a map of 30 m cells whose steps are meters.
  std::optional<double> cellSize;
  /// World height of one step of the file's integers, or of a height of 1 where it holds heights
  /// (.asc, .exr, .tif of floats); > 0. Reading takes what the .json beside it says, or 1; writing
  /// what `HeightMap::steps` says.
  std::optional<double> heightScale;
  /// Receives a line for what is taken otherwise than the file says; null drops the lines.
  Warnings* warnings = nullptr;
};

/// Whether the path has one of `kHeightMapEndings`, in any case.
bool isHeightMapFile(const std::filesystem::path& path);
/// Whether it is of those that hold integers, of which `FILE.json` says what they stand for.
bool holdsIntegers(const std::filesystem::path& path);

/// Reads an ESRI `.asc` grid, a gray `.tif` (integers or floats, GeoTIFF tags where there are any,
/// GDAL's NODATA), one channel of an `.exr`, 16- or 8-bit gray `.png`, `.pgm` (P2 and P5), or
/// `.r16` and `.raw` (without a header: 16-bit integers, low byte first, that make a square, or the
/// width, height and, of .raw, type uint16 or float32 that the .json beside it says). Cells without
/// data (NODATA, up to a float's rounding; NaN; -9999 and the like in an .asc without NODATA_value;
/// transparent pixels) are NaN. Cells in degrees of longitude and latitude get a size in meters,
/// which a warning states. What integers stand for and how large cells are is read from
/// `FILE.json`, as `writeHeightMap` writes it.
///
/// Throws `InputError` naming the file, and the line in text, for anything malformed, without data,
/// with cells that are not square, or smaller than 2 x 2, and `Cancelled`. Memory is asked for
/// before it is taken: a header that promises more than there is costs nothing.
HeightMap readHeightMap(const std::filesystem::path& path, const HeightMapFileOptions& options = {},
                        const Progress& progress = {});

/// The same from the bytes of a file, with nothing beside it. `name` is what errors call it; its
/// ending says the format.
HeightMap readHeightMap(std::string_view bytes, const std::string& name,
                        const HeightMapFileOptions& options, const Progress& progress = {});

/// Where that which a format cannot say goes: `FILE.json`.
std::filesystem::path heightSidecarPath(const std::filesystem::path& path);

/// Writes heights: `.asc`, `.tif` (32-bit floats, GeoTIFF) and `.exr` (32-bit floats) as they are,
/// `.png`, `.pgm`, `.r16` and `.raw` as 16-bit integers. Heights are never stretched: integers
/// count steps of `options.heightScale` or else `map.steps`, finer where those came from a file of
/// fewer bits, so that 8-bit maps become 16-bit ones of the same brightness; without both, or where
/// these do not hold the heights, steps of 1 for whole numbers and else of a power of two. What the
/// integers stand for, and how large cells are, goes into `FILE.json`, and a warning says so; no
/// such file is left where nothing has to be said. With `options.heightScale`, heights that do not
/// fit are clamped, and a warning counts them. Each file is whole or not there. Throws
/// `InputError`, also where `FILE.json` is there and something else, and `Cancelled`.
void writeHeightMap(const std::filesystem::path& path, const HeightMap& map,
                    const HeightMapFileOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
