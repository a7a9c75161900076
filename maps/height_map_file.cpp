// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/height_map_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "core/text.h"
#include "maps/height_formats.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

// A map without a cell size of its own is this many reliefs wide.
constexpr double kSidePerRelief = 5;

std::string readableEndings() { return ".asc, .tif, .exr, .png, .pgm, .r16 or .raw"; }

void checkOptions(const HeightMapFileOptions& options) {
  const auto check = [](const std::optional<double>& value, const char* name) {
    if (value && !(*value > 0 && *value < std::numeric_limits<double>::infinity())) {
      throw InputError(std::string("`") + name + "` is " + exactNumber(*value) +
                       "; it must be > 0");
    }
  };
  check(options.cellSize, "cell-size");
  check(options.heightScale, "height-scale");
}

HeightMap readFormat(const HeightFile& file) {
  const std::string ending = lowerExtension(file.name);
  if (ending == ".asc") return readEsriGrid(file);
  if (ending == ".pgm") return readPgm(file);
  if (ending == ".png") return readPngHeights(file);
  if (ending == ".r16" || ending == ".raw") return readRaw(file);
  if (ending == ".exr") return readExr(file);
  if (ending == ".tif" || ending == ".tiff") return readTiff(file);
  file.fail("is no height map; its ending must be " + readableEndings());
}

/// Reads a file, and gives the map what the file does not say.
HeightMap read(const HeightFile& file) {
  HeightMap map = readFormat(file);
  const std::optional<HeightRange> range = rangeOf(map.heights);
  if (!range) file.fail("holds no heights: every cell is without data (NODATA)");
  if (file.options.cellSize) {
    map.cellSize = *file.options.cellSize;
    map.cellSizeKnown = true;
  } else if (!map.cellSizeKnown) {
    const double longerSide = std::max(map.width(), map.height()) - 1;
    map.cellSize = range->relief() > 0 ? kSidePerRelief * range->relief() / longerSide : 1;
  }
  if (range->relief() == 0)
    file.warn("all its heights are " + exactNumber(range->low) + ": more of it is a plane");
  if (map.steps && map.steps->largest <= 255 && range->relief() > 0) {
    file.warn(
        "8 bits hold at most 256 different heights, which makes terraces on slopes; save it "
        "with 16 bits, or as .tif or .asc, from where it was made");
  }
  return map;
}

}  // namespace

void HeightFile::fail(const std::string& what) const { throw InputError(name + ": " + what); }

HeightMap HeightFile::allocate(double width, double height) const {
  if (width < 2 || height < 2)
    fail("is " + exactNumber(width) + " x " + exactNumber(height) +
         " points; a height map needs at least 2 x 2");
  requireMemory(8 * width * height, name + ": its heights", "use a smaller height map");
  if (width > 1 << 24 || height > 1 << 24) fail("is longer than 16,777,216 points");
  HeightMap map;
  map.heights = Grid<float>(static_cast<int>(width), static_cast<int>(height),
                            std::numeric_limits<float>::quiet_NaN());
  return map;
}

double metersOfDegrees(double degrees, double south, double north) {
  // One length for both directions, that the cells' area is right.
  constexpr double kMetersPerDegree = 111'195;  // on a sphere of 6371 km
  const double latitude = (south + north) / 2 * (std::numbers::pi / 180);
  return kMetersPerDegree * degrees * std::sqrt(std::max(0.01, std::cos(latitude)));
}

bool isUsualNoData(double height) {
  for (const double usual : {-9999.0, -99999.0, -32768.0, -32767.0}) {
    if (height == usual) return true;
  }
  return std::abs(height) >= 3.4e38 && std::abs(height) < 3.41e38;
}

void warnOfAssumedHoles(const HeightFile& file, std::size_t cells) {
  if (cells == 0) return;
  file.warn("taking " + counted(cells, "cell") +
            " for cells without data, which no NODATA_value announces");
}

void checkCellUnit(HeightMap& map, const HeightFile& file) {
  const double cell = map.cellSize;
  // No ground is ten times as high as it is wide: the heights are in another unit.
  const std::optional<HeightRange> range = rangeOf(map.heights);
  const double side = (std::max(map.width(), map.height()) - 1) * cell;
  if (!range || !(range->relief() > 10 * side)) return;
  const auto [west, south] = map.corner.value_or(MapCorner{});
  const double north = south + cell * map.height();
  const bool degrees = cell <= 1 && std::abs(west) <= 361 &&
                       std::abs(west + cell * map.width()) <= 361 && south >= -90.5 &&
                       north <= 90.5;
  if (!degrees) {
    file.warn("its heights span " + roundedNumber(range->relief()) + " and its side is " +
              roundedNumber(side) + ": set `cell-size` where cells have another unit than heights");
    return;
  }
  map.cellSize = metersOfDegrees(cell, south, north);
  map.corner.reset();
  file.warn("its cells of " + roundedNumber(cell) +
            " degrees under heights in meters are taken as " + roundedNumber(map.cellSize) +
            " m long; set `cell-size` for another length");
}

std::string exactNumber(double value) {
  char buffer[64];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

std::string roundedNumber(double value) {
  char buffer[64];
  return {buffer,
          std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 4).ptr};
}

bool isHeightMapFile(const fs::path& path) {
  const std::string ending = lowerExtension(path);
  return !ending.empty() &&
         (" " + std::string(kHeightMapEndings) + " ").find(" " + ending + " ") != std::string::npos;
}

bool holdsIntegers(const fs::path& path) {
  const std::string ending = lowerExtension(path);
  return ending == ".png" || ending == ".pgm" || ending == ".r16" || ending == ".raw";
}

HeightMap readHeightMap(const fs::path& path, const HeightMapFileOptions& options,
                        const Progress& progress) {
  checkOptions(options);
  const std::string name = path.string();
  if (!isHeightMapFile(path))
    throw InputError(name + ": is no height map; its ending must be " + readableEndings());
  const std::string bytes = readFile(path, progress.part(0, 0.1));
  const Progress rest = progress.part(0.1, 1);
  HeightFile file{bytes, name, options, rest};
  if (holdsIntegers(path)) file.sidecar = readSidecar(path);
  return read(file);
}

HeightMap readHeightMap(std::string_view bytes, const std::string& name,
                        const HeightMapFileOptions& options, const Progress& progress) {
  checkOptions(options);
  return read({bytes, name, options, progress});
}

void writeHeightMap(const fs::path& path, const HeightMap& map, const HeightMapFileOptions& options,
                    const Progress& progress) {
  checkOptions(options);
  const std::string name = path.string();
  if (map.heights.empty()) throw InputError(name + ": cannot be written: the height map is empty");
  progress.report("writing", 0);
  const std::string ending = lowerExtension(path);
  if (ending == ".asc") {
    writeFile(path, esriGridText(map, progress.part(0, 0.9)), progress.part(0.9, 1));
  } else if (ending == ".tif" || ending == ".tiff") {
    writeFile(path, tiffBytes(map, name, progress.part(0, 0.9)), progress.part(0.9, 1));
  } else if (ending == ".exr") {
    writeFile(path, exrBytes(map, name), progress.part(0.9, 1));
  } else if (isHeightMapFile(path)) {
    writeIntegers(path, map, options, progress);
  } else {
    throw InputError(name + ": cannot be written as a height map; its ending must be " +
                     readableEndings());
  }
}

}  // namespace exemplar
