// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/tile_range.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "core/error.h"

namespace exemplar {
namespace {

/// Whole numbers between `between`, and nothing else; false where the text is not that.
bool readNumbers(std::string_view text, std::string_view between, std::int64_t* numbers) {
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t n = 0; n <= between.size(); ++n) {
    const auto [after, error] = std::from_chars(at, end, numbers[n]);
    if (error != std::errc{}) return false;
    at = after;
    if (n == between.size()) return at == end;
    if (at == end || *at++ != between[n]) return false;
  }
  return false;
}

void requireInRange(const std::string& what, std::int64_t least, std::int64_t most) {
  if (least < -kMostTiles || most >= kMostTiles)
    throw InputError(what + ": tiles are numbered from " + std::to_string(-kMostTiles) + " to " +
                     std::to_string(kMostTiles - 1) + " along each axis");
}

/// A number's bits with a zero before each.
std::uint64_t spread(std::uint64_t v) {
  v &= 0xffffffff;
  v = (v | v << 16) & 0x0000ffff0000ffff;
  v = (v | v << 8) & 0x00ff00ff00ff00ff;
  v = (v | v << 4) & 0x0f0f0f0f0f0f0f0f;
  v = (v | v << 2) & 0x3333333333333333;
  return (v | v << 1) & 0x5555555555555555;
}

}  // namespace

PlanePoint parseTile(const std::string& text) {
  std::int64_t n[2];
  if (!readNumbers(text, ",", n))
    throw InputError("tile " + text + ": expected two whole numbers, as 3,-2");
  requireInRange("tile " + text, std::min(n[0], n[1]), std::max(n[0], n[1]));
  return {n[0], n[1]};
}

std::string tileText(const PlanePoint& tile) {
  return std::to_string(tile.x) + "," + std::to_string(tile.y);
}

PlaneBox parseTileRange(const std::string& text) {
  std::int64_t n[4];
  if (!readNumbers(text, ":,:", n))
    throw InputError("region " + text +
                     ": expected the first tile and the one after the last along x and y, as "
                     "0:16,-4:4");
  const PlaneBox tiles{{n[0], n[2]}, {n[1], n[3]}};
  if (tiles.end.x <= tiles.begin.x || tiles.end.y <= tiles.begin.y)
    throw InputError("region " + text + ": holds no tile; each end must be above its beginning");
  requireInRange("region " + text, std::min(n[0], n[2]), std::max(n[1], n[3]) - 1);
  return tiles;
}

std::string tileRangeText(const PlaneBox& tiles) {
  return std::to_string(tiles.begin.x) + ":" + std::to_string(tiles.end.x) + "," +
         std::to_string(tiles.begin.y) + ":" + std::to_string(tiles.end.y);
}

PlaneBox columnsOfTile(const PlanePoint& tile, int side) {
  return columnsOfTiles({tile, {tile.x + 1, tile.y + 1}}, side);
}

PlaneBox columnsOfTiles(const PlaneBox& tiles, int side) {
  return {{tiles.begin.x * side, tiles.begin.y * side}, {tiles.end.x * side, tiles.end.y * side}};
}

std::vector<PlaneBox> jobsOf(const PlaneBox& tiles, int side) {
  const PlanePoint first{floorDivide(tiles.begin.x, side), floorDivide(tiles.begin.y, side)};
  const PlanePoint last{floorDivide(tiles.end.x - 1, side), floorDivide(tiles.end.y - 1, side)};
  std::vector<std::pair<std::uint64_t, PlaneBox>> jobs;
  for (std::int64_t x = first.x; x <= last.x; ++x) {
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      const PlaneBox square{{x * side, y * side}, {(x + 1) * side, (y + 1) * side}};
      const std::uint64_t morton = spread(static_cast<std::uint64_t>(x + kMostTiles)) << 1 |
                                   spread(static_cast<std::uint64_t>(y + kMostTiles));
      jobs.emplace_back(morton, square & tiles);
    }
  }
  std::sort(jobs.begin(), jobs.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PlaneBox> list;
  for (auto& [morton, job] : jobs) list.push_back(job);
  return list;
}

std::vector<PlanePoint> tilesOf(const PlaneBox& tiles) {
  std::vector<PlanePoint> list;
  for (std::int64_t x = tiles.begin.x; x < tiles.end.x; ++x)
    for (std::int64_t y = tiles.begin.y; y < tiles.end.y; ++y) list.push_back({x, y});
  return list;
}

}  // namespace exemplar
