// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "maps/height_map_file.h"

/// The formats of height maps, one by one: what `readHeightMap` and `writeHeightMap` call.
namespace exemplar {

/// What is beside a file whose format cannot say it.
struct HeightSidecar {
  int width = 0, height = 0;
  std::optional<double> cellSize;
  std::optional<MapCorner> corner;
  double step = 1, offset = 0;
  std::optional<int> noData;  ///< the integer that stands for holes
  bool floats = false;        ///< of .raw: 32-bit floats, else 16-bit integers
};

/// A file that is being read.
struct HeightFile {
  std::string_view bytes;
  const std::string& name;
  const HeightMapFileOptions& options;
  const Progress& progress;
  std::optional<HeightSidecar> sidecar = {};

  void warn(const std::string& what) const { exemplar::warn(options.warnings, name + ": " + what); }
  [[noreturn]] void fail(const std::string& what) const;
  /// A map of so many points, all holes. Throws where it would not be one or would not fit.
  HeightMap allocate(double width, double height) const;
};

HeightMap readEsriGrid(const HeightFile& file);
HeightMap readPgm(const HeightFile& file);
HeightMap readPngHeights(const HeightFile& file);
HeightMap readRaw(const HeightFile& file);
HeightMap readTiff(const HeightFile& file);
HeightMap readExr(const HeightFile& file);

std::string esriGridText(const HeightMap& map, const Progress& progress);
std::string tiffBytes(const HeightMap& map, const std::string& name, const Progress& progress);
std::string exrBytes(const HeightMap& map, const std::string& name);
/// Writes a .png, .pgm, .r16 or .raw and what is beside it.
void writeIntegers(const std::filesystem::path& path, const HeightMap& map,
                   const HeightMapFileOptions& options, const Progress& progress);

/// Heights in meters over cells of `degrees`: how long cells are that have the same area.
/// `south` and `north` are latitudes.
double metersOfDegrees(double degrees, double south, double north);

/// Whether a height is what programs write for cells without data, and do not always announce:
/// -9999 (Esri's default), -99999, -32768, -32767, or a float's largest number.
bool isUsualNoData(double height);
/// Warns of cells that were taken for cells without data though no NODATA value announces them.
void warnOfAssumedHoles(const HeightFile& file, std::size_t cells);
/// Warns where a map's cells have another unit than its heights, which span more than ten times its
/// side then: cells that can be degrees become as many meters, and other ones stay as they are.
void checkCellUnit(HeightMap& map, const HeightFile& file);

/// Reads what is beside a file; nothing where it is not there, or is something else.
std::optional<HeightSidecar> readSidecar(const std::filesystem::path& path);
/// Writes it, or, where it says nothing that is not so without, removes one that is there.
void writeSidecar(const std::filesystem::path& path, const HeightSidecar& sidecar,
                  Warnings* warnings);
/// Throws `InputError` where the place of a sidecar is taken by another file.
void requireSidecarPlace(const std::filesystem::path& path);

/// For messages.
std::string exactNumber(double value);
std::string roundedNumber(double value);  ///< to four digits

}  // namespace exemplar
