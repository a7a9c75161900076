// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "engine/world_tiles.h"

namespace exemplar {

/// What was written for programs that stream.
struct WrittenTileset {
  std::int64_t tiles = 0;  ///< that have a `.glb`
  std::int64_t files = 0;  ///< `tileset.json`, and parts of it
};

/// Writes `tileset.json` (3D Tiles 1.1, OGC 22-025r4) to a world's folder, over the `.glb` of the
/// tiles listed: a tree of squares, each with the box of what is in it as its file states it, the
/// tiles at its leaves, moved to where they lie (z up, in the example's unit). A square all of
/// whose tiles are there and which has a coarser one (`makeLevels`) shows that first, with the
/// error that was measured, or its parts' where that is larger; other squares are empty, with their
/// side as their error, so that what is near is loaded first. Of more than 4,096 tiles, squares of
/// 64 x 64 have a file each
/// (`tilesets/I_J.json`), which is loaded as it comes near. (Implicit tiling, which would say this
/// in less, has no tiles with numbers below 0.) Nothing is written where no tile has a `.glb`.
/// Throws `InputError` where one cannot be read.
WrittenTileset writeTileset(const World& world, const std::vector<ListedTile>& tiles);

}  // namespace exemplar
