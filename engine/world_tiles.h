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

/// What tiles of a world can be written to: ".txt .vox ...".
const char* tileEndings(const World& world);
/// What its tiles are written to where nothing is said: "glb" of labels, "tif" of heights.
std::string usualFormat(const World& world);
/// The endings of formats ("glb", or ".glb,txt"; empty: `usualFormat`), each with its dot. Throws
/// `InputError` for those that tiles of this world cannot be written to.
std::vector<std::string> tileEndings(const World& world, const std::string& formats);

/// The surface of a square of heights but its outer rows and columns, x and y from the first point
/// that is left, and its vertices' normals, which know of those that are not.
TriangleMesh meshOfInside(const HeightMap& map, std::vector<Vec3f>& normals,
                          const Progress& progress = {});

/// A tile as triangles, from its own corner. What lies around it is seen: tiles of pieces are
/// divided along their edges as their neighbors are, and meet them; tiles of heights have their
/// neighbors' points along their border and, where `normals` is given, the same normals there.
TriangleMesh tileMesh(const World& world, const PlanePoint& tile,
                      std::vector<Vec3f>* normals = nullptr, const Progress& progress = {});
/// Writes a tile, whole or not at all; grids of labels and maps of heights lie where the tile lies
/// in the world, meshes from the tile's corner. Heights as integers have one scale in all tiles.
/// Returns what the format cannot say.
Warnings writeTile(const World& world, const PlanePoint& tile, const Result& result,
                   const std::filesystem::path& path, const Progress& progress = {});

struct MakeOptions {
  std::vector<std::string> endings;  ///< as `tileEndings` gives them
  int job = 4;                       ///< tiles along each side that are made together, 1..64
};
/// How far `makeTiles` is, and what it came to.
struct MadeTiles {
  std::int64_t all = 0, there = 0, made = 0;               ///< of them there before; made now
  std::vector<std::pair<PlanePoint, std::string>> failed;  ///< and why
  Warnings warnings;                                       ///< of the first tile
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
  /// Of neighboring labels, also across tiles, and those that the example does not show; of points
  /// that two tiles of heights share, and those that are not at one height.
  std::int64_t pairs = 0, violations = 0;
  std::int64_t files = 0;                    ///< that are there
  std::int64_t remade = 0;                   ///< of these, made again
  std::vector<std::string> different;        ///< of these, not the same bytes
  std::int64_t rimEdges = 0, unmatched = 0;  ///< of meshes, on planes between two tiles
  std::uint64_t hash = 0;                    ///< of all tiles' contents
  bool sound() const { return violations == 0 && different.empty() && unmatched == 0; }
};
/// Checks a region: every pair of neighbors, or shared point, the bytes of files that are there
/// (some of them, the same at each call), and that edges of meshes on the plane between two tiles
/// are both tiles'.
CheckedTiles checkTiles(const World& world, const PlaneBox& tiles, const CheckOptions& options = {},
                        const Progress& progress = {});

/// The tiles of which there is a file, in order, and their endings.
struct ListedTile {
  PlanePoint tile;
  std::vector<std::string> endings;
};
std::vector<ListedTile> listTiles(const World& world);

}  // namespace exemplar
