// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/world.h"

namespace exemplar {

/// Each has a quarter of the points of the one before.
inline constexpr int kMostLevels = 4;

/// Where a tile of a coarser level of detail is: tiles/LEVEL/I/J and an ending.
std::filesystem::path levelPath(const World& world, int level, const PlanePoint& tile,
                                const std::string& ending);

/// How far, in world units, a coarser tile is from the world: what its file's neighbor says, which
/// `makeLevels` wrote. Nothing where it is not there, or is not that.
std::optional<double> levelError(const World& world, int level, const PlanePoint& tile);

struct MadeLevels {
  std::int64_t there = 0, made = 0;  ///< coarser tiles
};
/// Makes the coarser tiles of a world of heights that a region of tiles holds whole, those that are
/// there left out: of level 1 to `levels` (at most `kMostLevels`), as `.glb`. Tile I,J of level m
/// lies where the 2^m x 2^m tiles from 2^m·I,2^m·J on lie, has every 2^m-th of their points, and so
/// as many as one of them; its normals are its neighbors' too. Its error, in a `.json` beside it,
/// is the largest distance, up or down, of one of the world's points from it: at least the
/// one-sided Hausdorff distance. Along its border upright triangles fill what is between its edges
/// and the world's own, so that tiles of any two levels meet without a gap. What
/// a square of the highest level covers is in memory at once. Throws `InputError` for worlds of
/// labels, and `Cancelled`.
MadeLevels makeLevels(const World& world, const PlaneBox& tiles, int levels,
                      const Progress& progress = {});

}  // namespace exemplar
