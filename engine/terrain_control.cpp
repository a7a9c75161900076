// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/terrain_control.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "engine/words.h"
#include "maps/distance_transform.h"
#include "maps/height_map_file.h"
#include "maps/map.h"
#include "synth/terrain/guide_lines.h"
#include "synth/terrain/height_pyramid.h"

namespace exemplar {
namespace {

/// A gray picture, 0..1.
Grid<float> readMask(const Source& source) {
  MapLayer layer = source.inMemory<std::string>()
                       ? decodeMapLayer(*source.inMemory<std::string>(), source.name(), "mask")
                       : readMapLayer(source.path(), "mask");
  if (layer.planes.size() != 1)
    throw InputError(source.name() + ": a colored picture; a mask is gray, black and white");
  return std::move(layer.planes.front());
}

/// What `height-scale` says of the example holds for files of its kind: of integers, or of heights.
std::optional<double> scaleFor(const std::string& file, const Example& example) {
  const bool alike = holdsIntegers(file) == holdsIntegers(example.source.path());
  return alike ? example.reading.heightScale : std::nullopt;
}

void requireWhole(const HeightMap& map, const std::string& name) {
  for (const float h : map.heights.values()) {
    if (std::isnan(h))
      throw InputError(name + ": has points without data; fill them, they say nothing here");
  }
}

std::vector<TerrainLine> parseLines(const std::string& text, const std::string& name,
                                    double cellSize, int height) {
  std::vector<TerrainLine> lines;
  std::istringstream rows(text);
  std::string row;
  for (int number = 1; std::getline(rows, row); ++number) {
    const std::string where = name + ":" + std::to_string(number);
    row = row.substr(0, row.find('#'));
    std::istringstream words(row);
    std::string word;
    if (!(words >> word)) continue;
    if (word != "ridge" && word != "valley")
      throw InputError(where + ": '" + word + "'; expected ridge or valley, and points x,y");
    TerrainLine line;
    line.ridge = word == "ridge";
    while (words >> word) {
      const std::vector<std::string> numbers = split(word, ',');
      if (numbers.size() != 2 && numbers.size() != 3)
        throw InputError(where + ": '" + word + "'; expected a point x,y or x,y,height");
      TerrainLine::Point point;
      point.x = parseNumber(numbers[0], where) / cellSize;
      point.y = height - parseNumber(numbers[1], where) / cellSize;
      if (numbers.size() == 3) point.height = parseNumber(numbers[2], where);
      if (std::abs(point.x) > 1e6 || std::abs(point.y) > 1e6)
        throw InputError(where + ": '" + word + "' is far beyond the result");
      line.points.push_back(point);
    }
    if (line.points.empty()) throw InputError(where + ": a line without points");
    lines.push_back(std::move(line));
  }
  if (lines.empty()) throw InputError(name + ": no ridge and no valley");
  return lines;
}

/// Mixes what is given into the control, where nothing is held more firmly.
void hold(TerrainControl& control, int x, int y, float height, float firmness) {
  if (!(firmness > control.hold(x, y)) || std::isnan(height)) return;
  control.hold(x, y) = firmness;
  control.given(x, y) = height;
}

}  // namespace

CoarseTerrain readCoarseTerrain(const std::string& file, const Example& example,
                                const Progress& progress) {
  CoarseTerrain coarse{readHeights(file, {.heightScale = scaleFor(file, example)}, progress)};
  requireWhole(coarse.map, file);
  if (coarse.map.cellSizeKnown && example.heights().cellSizeKnown) {
    coarse.factor = coarse.map.cellSize / example.heights().cellSize;
    if (!(coarse.factor > 1.2 && coarse.factor < 64)) {
      throw InputError(file + ": cells of " + numberText(coarse.map.cellSize) + ", and " +
                       example.name() + " has cells of " + numberText(example.heights().cellSize) +
                       "; `detail-of` is a terrain with cells 1.2 to 64 times as large");
    }
  }
  return coarse;
}

TerrainGuide readTerrainGuide(const Source& source, std::span<const Grid<float>> examples,
                              double cellSize, int width, int height, const Progress& progress) {
  const std::string ending = lowerExtension(source.path());
  if (ending == ".csv" || ending == ".txt") {
    LinesGuide lines = guideOfLines(parseLines(readBytes(source), source.name(), cellSize, height),
                                    width, height, examples, progress);
    return {std::move(lines.heights), std::move(lines.weight)};
  }
  if (!source.inMemory<HeightMap>() && !isHeightMapFile(source.path())) {
    throw InputError(source.name() + ": `guide` of a terrain is a height map (" +
                     kHeightMapEndings + "), or lines (.csv .txt)");
  }
  HeightMap map = readHeights(source, {}, progress);
  TerrainGuide guide;
  // Where nothing is painted land is free.
  const std::optional<HeightRange> range = rangeOf(map.heights);
  if (!range) throw InputError(source.name() + ": has no heights; a guide says some");
  if (range->holes > 0) {
    guide.weight = Grid<float>(map.width(), map.height());
    for (std::size_t s = 0; s < guide.weight.count(); ++s)
      guide.weight[s] = std::isnan(map.heights[s]) ? 0 : 1;
    fillHoles(map.heights);
  }
  std::error_code error;
  const bool said = !map.steps || map.steps->size != 1 || map.steps->offset != 0 ||
                    std::filesystem::exists(heightSidecarPath(source.path()), error);
  guide.heights = std::move(map.heights);
  if (said) return guide;
  // Painted: from the lowest to the highest of the examples.
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const Grid<float>& example : examples) {
    const std::optional<HeightRange> own = rangeOf(example);
    if (!own) continue;
    low = std::min(low, own->low);
    high = std::max(high, own->high);
  }
  const double span = range->relief() > 0 ? range->relief() : 1;
  for (float& h : guide.heights.values())
    h = static_cast<float>(low + (h - range->low) / span * (high - low));
  return guide;
}

void readHeld(const std::optional<Source>& keep, const TerrainFiles& files, const Example& example,
              int width, int height, TerrainControl& control, const Progress& progress) {
  if (!files.base.empty() && files.mask.empty())
    throw InputError("`base`: say with `mask` what of it is made anew");
  if (!keep && files.mask.empty()) return;
  control.given = Grid<float>(width, height);
  control.hold = Grid<float>(width, height);
  const auto blend = static_cast<float>(files.blend);
  // Falls from what stays, over `blend` points.
  const auto firmness = [&](float distance) {
    return distance <= 0 ? 1.0f : std::max(0.0f, 1 - distance / (blend + 1));
  };
  if (keep) {
    const Grid<float>& heights = example.heights().heights;
    const Grid<float> white = stretched(readMask(*keep), heights.width(), heights.height());
    Pixel at{(width - heights.width()) / 2, (height - heights.height()) / 2};
    if (!files.at.empty()) {
      const std::vector<double> xy = parseNumbers(files.at, 2, "`keep-at` " + files.at);
      at = {wholeNumber(xy[0], "`keep-at` " + files.at),
            wholeNumber(xy[1], "`keep-at` " + files.at)};
    }
    Grid<std::uint8_t> stays(width, height);
    std::size_t count = 0;
    for (int y = 0; y < heights.height(); ++y) {
      for (int x = 0; x < heights.width(); ++x) {
        if (white(x, y) < 0.5f || !stays.contains(x + at.x, y + at.y)) continue;
        stays(x + at.x, y + at.y) = 1;
        ++count;
      }
    }
    if (count == 0)
      throw InputError(keep->name() + ": nothing of it is white within the result; nothing stays");
    progress.check();
    const Grid<float> distance = distanceTo(stays, false);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (heights.contains(x - at.x, y - at.y))
          hold(control, x, y, heights(x - at.x, y - at.y), firmness(distance(x, y)));
      }
    }
  }
  if (files.mask.empty()) return;
  Grid<float> base = example.heights().heights;
  if (!files.base.empty()) {
    const std::optional<double> scale = scaleFor(files.base, example);
    base = readHeights(files.base, {.heightScale = scale}, progress).heights;
  }
  if (base.width() != width || base.height() != height) {
    const std::string name = files.base.empty() ? example.name() : files.base;
    throw InputError(name + ": " + std::to_string(base.width()) + " x " +
                     std::to_string(base.height()) +
                     " points; what `mask` leaves as it is has the "
                     "size of the result, " +
                     std::to_string(width) + " x " + std::to_string(height));
  }
  const Grid<float> white = stretched(readMask(files.mask), width, height);
  Grid<std::uint8_t> stays(width, height);
  for (std::size_t s = 0; s < stays.count(); ++s) stays[s] = white[s] < 0.5f;
  const Grid<float> distance = distanceTo(stays, false);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) hold(control, x, y, base(x, y), firmness(distance(x, y)));
}

void holdData(const Example& example, TerrainControl& control) {
  const Grid<float>& heights = example.heights().heights;
  control.given = heights;
  control.hold = Grid<float>(heights.width(), heights.height());
  std::size_t holes = 0;
  for (std::size_t s = 0; s < heights.count(); ++s) {
    const bool hole = std::isnan(heights[s]);
    control.hold[s] = hole ? 0 : 1;
    if (hole) control.given[s] = 0;
    holes += hole;
  }
  if (holes == 0)
    throw InputError(example.name() + ": has data everywhere; there is nothing for `fill` to fill");
}

Grid<std::uint8_t> takeHoles(Grid<float>& heights) {
  Grid<std::uint8_t> holes(heights.width(), heights.height());
  for (std::size_t s = 0; s < heights.count(); ++s) holes[s] = std::isnan(heights[s]);
  fillHoles(heights);
  return holes;
}

void putHoles(std::span<const Grid<std::uint8_t>> holes, SynthesizedTerrain& made) {
  for (std::size_t s = 0; s < made.heights.count(); ++s) {
    const HeightOrigin& origin = made.origins[s];
    if (holes[origin.example](origin.x, origin.y))
      made.heights[s] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace exemplar
