// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "world/window_lattice.h"

/// Tiles of a world: squares of columns, numbered along x and y from tile 0,0, whose first column
/// is the world's column 0,0.
namespace exemplar {

/// Tiles are numbered from -2^20 to 2^20 - 1 along each axis.
inline constexpr std::int64_t kMostTiles = std::int64_t{1} << 20;

/// "3,-2". Throws `InputError` naming the text unless it is two whole numbers in range.
PlanePoint parseTile(const std::string& text);
std::string tileText(const PlanePoint& tile);

/// "0:16,-4:4": the tiles from 0 to before 16 along x and from -4 to before 4 along y. Throws
/// `InputError` naming the text unless it is that, in range and not empty.
PlaneBox parseTileRange(const std::string& text);
std::string tileRangeText(const PlaneBox& tiles);

/// The columns of a tile, or of a range of tiles, of `side` columns.
PlaneBox columnsOfTile(const PlanePoint& tile, int side);
PlaneBox columnsOfTiles(const PlaneBox& tiles, int side);

/// Squares of `side` x `side` tiles that cover a range (at its ends less), in Morton order: near
/// ones follow each other, so that what one has made for its surroundings is still known to the
/// next. Squares begin at multiples of `side`.
std::vector<PlaneBox> jobsOf(const PlaneBox& tiles, int side);
/// The tiles of a range, x outermost.
std::vector<PlanePoint> tilesOf(const PlaneBox& tiles);

}  // namespace exemplar
