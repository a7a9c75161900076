// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// ESRI grids: keys and numbers, as text.

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/text.h"
#include "core/text_scanner.h"
#include "maps/height_formats.h"
#include "maps/height_words.h"

namespace exemplar {
namespace {

// Heights are stored as float, and squares of them must not overflow.
constexpr double kLargestHeight = 1e15;

/// Reads an ESRI grid: keys and numbers, then the heights.
class AscReader {
 public:
  explicit AscReader(const HeightFile& source) : source_(source), words_(source, false) {}

  HeightMap read() {
    std::string_view word = readKeys();
    if (!columns_ || !rows_ || !cellSize_)
      words_.fail(std::string("is no ESRI grid: ") +
                  (!columns_ ? "ncols"
                   : !rows_  ? "nrows"
                             : "cellsize") +
                  " is missing");
    const std::size_t count = static_cast<std::size_t>(*columns_) * *rows_;
    if (source_.bytes.size() / 2 + 1 < count)  // a digit and a blank each
      source_.fail("the file ends early: it is too short for " + std::to_string(*columns_) + " x " +
                   std::to_string(*rows_) + " heights");
    map_ = source_.allocate(*columns_, *rows_);
    for (std::size_t p = 0; p < count; ++p, word = words_.next()) {
      if (word.empty())
        words_.fail("the file ends after " + std::to_string(p) + " of " + std::to_string(count) +
                    " heights");
      readHeight(p, word);
    }
    if (!word.empty())
      words_.fail("has more than " + std::to_string(*columns_) + " x " + std::to_string(*rows_) +
                  " heights");
    warnOfAssumedHoles(source_, assumed_);
    if (source_.options.heightScale) {
      for (float& h : map_.heights.values())
        h = static_cast<float>(h * *source_.options.heightScale);
    }
    setCellSize();
    return std::move(map_);
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static bool isNan(const std::string& word) {
    // As C, Python, and Microsoft's and Intel's libraries write it.
    return word.find("nan") != std::string::npos || word.find("#ind") != std::string::npos;
  }

  /// Reads the keys; returns the first word after them.
  std::string_view readKeys() {
    std::string_view word = words_.next();
    for (; !word.empty() && std::isalpha(static_cast<unsigned char>(word[0]));
         word = words_.next()) {
      const std::string key = lowerCase(word);
      if (key == "nan" || key == "inf" || key == "infinity") break;  // a value
      if (key == "ncols") {
        columns_ = words_.number("ncols", 1, 1 << 24);
      } else if (key == "nrows") {
        rows_ = words_.number("nrows", 1, 1 << 24);
      } else if (key == "cellsize" || key == "dx" || key == "dy") {
        const double size = words_.number(key, std::numeric_limits<double>::min(), kLargestHeight);
        if (cellSize_ && std::abs(size - *cellSize_) > 1e-6 * size)
          words_.fail("dx and dy differ; the cells must be square");
        cellSize_ = size;
      } else if (key == "xllcorner" || key == "xllcenter") {
        west_ = words_.number(key, -kInfinity, kInfinity);
        westIsCenter_ = key == "xllcenter";
      } else if (key == "yllcorner" || key == "yllcenter") {
        south_ = words_.number(key, -kInfinity, kInfinity);
        southIsCenter_ = key == "yllcenter";
      } else if (key == "nodata_value" || key == "nodata") {
        const std::string_view value = words_.next();
        hasNoData_ = true;
        noData_ = isNan(lowerCase(value)) ? std::numeric_limits<double>::quiet_NaN()
                                          : words_.parse(value, key, -kInfinity, kInfinity);
      } else {
        words_.fail("\"" + TextScanner::shown(word) +
                    "\" is no key of an ESRI grid: ncols, nrows, xllcorner, yllcorner, cellsize, "
                    "nodata_value");
      }
    }
    return word;
  }

  /// Whether a number means that there is no data. Programs round the value on its way through
  /// floats and few digits.
  bool isNoData(double h) const {
    if (hasNoData_) {
      const double rounding = (std::abs(noData_) < 1e30 ? 1e-6 : 1e-5) * std::abs(noData_);
      return std::abs(h - noData_) <= rounding;
    }
    return isUsualNoData(h);
  }

  void readHeight(std::size_t p, std::string_view word) {
    if (word.find_first_of("nN#") != std::string_view::npos && isNan(lowerCase(word))) {
      assumed_ += !(hasNoData_ && std::isnan(noData_));
      return;
    }
    const double h = words_.parse(word, "a height", -kInfinity, kInfinity);
    if (isNoData(h)) {
      assumed_ += !hasNoData_;
      return;
    }
    if (!(std::abs(h) <= kLargestHeight))
      words_.fail("a height is \"" + TextScanner::shown(word) +
                  "\"; it must be below 1e15 in size");
    map_.heights[p] = static_cast<float>(h);
  }

  void setCellSize() {
    map_.cellSizeKnown = true;
    map_.cellSize = source_.options.cellSize.value_or(*cellSize_);
    if (west_ && south_) {
      map_.corner = {*west_ - (westIsCenter_ ? *cellSize_ / 2 : 0),
                     *south_ - (southIsCenter_ ? *cellSize_ / 2 : 0)};
    }
    if (!source_.options.cellSize) checkCellUnit(map_, source_);
  }

  const HeightFile& source_;
  Words words_;
  HeightMap map_;
  std::optional<int> columns_, rows_;
  std::optional<double> cellSize_, west_, south_;
  double noData_ = 0;
  bool westIsCenter_ = false, southIsCenter_ = false;
  bool hasNoData_ = false;
  std::size_t assumed_ = 0;  // cells without data that the file does not announce
};

template <class Number>
void appendNumber(std::string& out, Number value) {
  char buffer[64];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

/// A number for holes that is far below all heights.
double noDataBelow(double lowest) {
  double value = -9999;
  while (value >= 2 * lowest && lowest < 0) value = 10 * value - 9;
  return value;
}

}  // namespace

HeightMap readEsriGrid(const HeightFile& file) { return AscReader(file).read(); }

std::string esriGridText(const HeightMap& map, const Progress& progress) {
  const MapCorner corner = map.corner.value_or(MapCorner{});
  const std::optional<HeightRange> range = rangeOf(map.heights);
  std::string out = "ncols " + std::to_string(map.width()) + "\nnrows " +
                    std::to_string(map.height()) + "\nxllcorner ";
  appendNumber(out, corner.west);
  out += "\nyllcorner ";
  appendNumber(out, corner.south);
  out += "\ncellsize ";
  appendNumber(out, map.cellSize);
  // Heights that others take for holes are none where the file says what a hole is.
  const bool saysHoles = !range || range->holes > 0 || range->low <= -9999;
  std::string noData;
  if (saysHoles) {
    appendNumber(noData, static_cast<std::int64_t>(noDataBelow(range ? range->low : 0)));
    out += "\nNODATA_value " + noData;
  }
  out += '\n';
  for (int row = 0; row < map.height(); ++row) {
    progress.report("writing", static_cast<double>(row) / map.height());
    for (int column = 0; column < map.width(); ++column) {
      const float h = map.at(column, row);
      if (std::isnan(h)) {
        out += noData;
      } else {
        appendNumber(out, h);
      }
      out += column + 1 < map.width() ? ' ' : '\n';
    }
  }
  return out;
}

}  // namespace exemplar
