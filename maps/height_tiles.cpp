// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/height_tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/memory.h"

namespace exemplar {
namespace {

constexpr int kLeastEdge = 8, kMostOverlap = 16;
constexpr double kOffGrid = 0.01;  ///< of a cell
constexpr double kDisagrees = 4, kDisagreesRelief = 0.02;

/// Where cells of a map lie on a grid whose origin is the southwestern cell of another one.
struct Cells {
  const HeightMap& map;
  int west, south;

  float at(int x, int y) const {
    const int column = x - west, row = map.height() - 1 - (y - south);
    return map.heights.contains(column, row) ? map.at(column, row)
                                             : std::numeric_limits<float>::quiet_NaN();
  }
  int east() const { return west + map.width(); }
  int north() const { return south + map.height(); }
};

/// The mean of numbers that are there.
struct Mean {
  double sum = 0;
  int count = 0;
  void add(double value) {
    if (std::isnan(value)) return;
    sum += value;
    ++count;
  }
  double value() const { return count > 0 ? sum / count : 0; }
};

/// Compares heights where two maps overlap, or meet: along x or, `upright`, along y.
void compareEdges(const Cells& a, const Cells& b, bool upright, TilePlace& place) {
  const int begin = upright ? std::max(a.west, b.west) : std::max(a.south, b.south);
  const int end = upright ? std::min(a.east(), b.east()) : std::min(a.north(), b.north());
  const auto at = [&](const Cells& cells, int along, int over) {
    return double{upright ? cells.at(along, over) : cells.at(over, along)};
  };
  // From the first cell of the later map to the last of the earlier one.
  const bool aFirst = upright ? a.south <= b.south : a.west <= b.west;
  const Cells &first = aFirst ? a : b, &second = aFirst ? b : a;
  const int from = upright ? second.south : second.west;
  const int last = (upright ? first.north() : first.east()) - 1;
  Mean across, usual;
  for (int n = begin; n < end; ++n) {
    for (int over = from; over <= last; ++over)
      across.add(std::abs(at(first, n, over) - at(second, n, over)));
    if (last < from) across.add(std::abs(at(first, n, last) - at(second, n, from)));
    usual.add(std::abs(at(first, n, last) - at(first, n, last - 1)));
    usual.add(std::abs(at(second, n, from + 1) - at(second, n, from)));
  }
  place.across = across.value();
  place.usual = usual.value();
}

}  // namespace

TilePlace placeOf(const HeightMap& map, const HeightMap& beside) {
  TilePlace place;
  if (!map.corner || !beside.corner || std::abs(map.cellSize / beside.cellSize - 1) > 1e-6)
    return place;
  place.east = (map.corner->west - beside.corner->west) / beside.cellSize;
  place.north = (map.corner->south - beside.corner->south) / beside.cellSize;
  const double overlapX =
      std::min<double>(beside.width(), place.east + map.width()) - std::max(0.0, place.east);
  const double overlapY =
      std::min<double>(beside.height(), place.north + map.height()) - std::max(0.0, place.north);
  const double narrow = std::min(overlapX, overlapY), shared = std::max(overlapX, overlapY);
  if (!(narrow > -1 && narrow <= kMostOverlap && shared >= kLeastEdge)) return place;
  const double east = std::round(place.east), north = std::round(place.north);
  if (std::max(std::abs(place.east - east), std::abs(place.north - north)) > kOffGrid) {
    place.fit = TileFit::OffGrid;
    return place;
  }
  const Cells a{beside, 0, 0}, b{map, static_cast<int>(east), static_cast<int>(north)};
  compareEdges(a, b, overlapY < overlapX, place);
  double relief = 0;
  for (const HeightMap* one : {&map, &beside})
    if (const auto range = rangeOf(one->heights)) relief = std::max(relief, range->relief());
  const bool disagrees =
      place.across > kDisagrees * place.usual && place.across > kDisagreesRelief * relief;
  place.fit = disagrees ? TileFit::Disagrees : TileFit::Fits;
  return place;
}

HeightMap joinedTiles(std::span<const HeightMap> tiles) {
  HeightMap joined;
  joined.cellSize = tiles.front().cellSize;
  joined.cellSizeKnown = tiles.front().cellSizeKnown;
  joined.steps = tiles.front().steps;
  MapCorner corner = *tiles.front().corner;
  for (const HeightMap& tile : tiles) {
    corner.west = std::min(corner.west, tile.corner->west);
    corner.south = std::min(corner.south, tile.corner->south);
  }
  int width = 0, height = 0;
  const auto cells = [&](const HeightMap& tile) {
    return Cells{
        tile, static_cast<int>(std::lround((tile.corner->west - corner.west) / joined.cellSize)),
        static_cast<int>(std::lround((tile.corner->south - corner.south) / joined.cellSize))};
  };
  for (const HeightMap& tile : tiles) {
    width = std::max(width, cells(tile).east());
    height = std::max(height, cells(tile).north());
  }
  requireMemory(double{sizeof(float)} * width * height,
                "a map of " + std::to_string(width) + " x " + std::to_string(height) +
                    " points around all tiles",
                "give fewer of them");
  joined.corner = corner;
  joined.heights = Grid<float>(width, height, std::numeric_limits<float>::quiet_NaN());
  for (const HeightMap& tile : tiles) {
    const Cells at = cells(tile);
    for (int y = at.south; y < at.north(); ++y) {
      for (int x = at.west; x < at.east(); ++x) {
        float& h = joined.heights(x, height - 1 - y);
        if (std::isnan(h)) h = at.at(x, y);
      }
    }
  }
  return joined;
}

}  // namespace exemplar
