// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/world.h"

/// Tiles of a world as files: made, checked, listed.
namespace exemplar {

/// The endings of formats ("glb", or ".glb,txt"), each with its dot. Throws `InputError` for those
/// that tiles of this world cannot be written to.
std::vector<std::string> tileEndings(const World& world, const std::string& formats);

/// A tile as triangles, from its own corner, where the world's example is made of pieces: cells
/// around it are seen, so that its edges are divided as its neighbors' are, and meet them.
TriangleMesh tileMesh(const World& world, const PlanePoint& tile, const Progress& progress = {});
/// Writes a tile, whole or not at all; grids of labels lie where the tile lies in the world, meshes
/// from the tile's corner.
void writeTile(const World& world, const PlanePoint& tile, const Result& result,
               const std::filesystem::path& path, const Progress& progress = {});

struct MakeOptions {
  std::vector<std::string> endings;  ///< as `tileEndings` gives them
  int job = 4;                       ///< tiles along each side that are made together, 1..64
};
/// How far `makeTiles` is, and what it came to.
struct MadeTiles {
  std::int64_t all = 0, there = 0, made = 0;               ///< of them there before; made now
  std::vector<std::pair<PlanePoint, std::string>> failed;  ///< and why
};
/// Makes those tiles of a region whose files are not all there; a file that is there is whole. Runs
/// of several processes at once on one folder, or after one that was killed, lose nothing and harm
/// nothing. `made` hears of each tile, one call at a time. Throws `Cancelled`, and `InputError`
/// where this machine makes other bytes than the world's maker.
MadeTiles makeTiles(const World& world, const PlaneBox& tiles, const MakeOptions& options,
                    const std::function<void(const MadeTiles&)>& made = {},
                    const Progress& progress = {});

struct CheckOptions {
  double remake = 1;  ///< percent of the tiles' files that are made once more, 0..100
};
/// What is wrong with a region.
struct CheckedTiles {
  std::int64_t tiles = 0;
  std::int64_t pairs = 0, violations = 0;    ///< of neighbors, also across tiles
  std::int64_t files = 0;                    ///< that are there
  std::int64_t remade = 0;                   ///< of these, made again
  std::vector<std::string> different;        ///< of these, not the same bytes
  std::int64_t rimEdges = 0, unmatched = 0;  ///< of meshes, on planes between two tiles
  std::uint64_t hash = 0;                    ///< of all tiles' contents
  bool sound() const { return violations == 0 && different.empty() && unmatched == 0; }
};
/// Checks a region: every pair of neighbors, the bytes of files that are there (some of them, the
/// same at each call), and that edges of meshes on the plane between two tiles are both tiles'.
CheckedTiles checkTiles(const World& world, const PlaneBox& tiles, const CheckOptions& options = {},
                        const Progress& progress = {});

/// The tiles of which there is a file, in order, and their endings.
struct ListedTile {
  PlanePoint tile;
  std::vector<std::string> endings;
};
std::vector<ListedTile> listTiles(const World& world);

}  // namespace exemplar
