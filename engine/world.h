// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "engine/engine.h"
#include "engine/realize.h"
#include "engine/world_file.h"
#include "world/tile_range.h"

/// Worlds: an example without end, made tile by tile.
namespace exemplar {

inline constexpr int kMostTileSide = 4096;  ///< columns

/// What a new world is to be.
struct WorldRequest {
  Source example;
  std::string engine;       ///< empty: the one that the example asks for
  Settings settings;        ///< of reading the example, of the engine, and `seed`
  std::optional<int> tile;  ///< columns along each side of a tile, 8..4096; 72, heights 256
  /// Columns from one window to the next: 36, 12..512; of heights 384, 96..1024.
  std::optional<int> window;
  std::optional<int> height;  ///< cells, 1..1024; the example's
};

/// What making tiles has taken.
struct WorldCosts {
  double coldSeconds = 0;  ///< of one tile of which nothing was known
  double warmSeconds = 0;  ///< of each of some more beside it
};

/// A world is a pure function: the example's bytes, the settings, the seed and a tile's number
/// decide the tile's bytes. Any tile can be made alone, in any order, by any number of threads,
/// processes and machines, and fits its neighbors. It lives in a folder:
///
///     world.json      what it is (`WorldFile`)
///     example/        the example as it is read; what the world begins with
///     tiles/0/I/J.*   tiles that were made; each is whole, or not there
///     cache/          windows that were made, where that is asked for; may be deleted at any time
///
/// Labels (the engine model) and heights (terrain) have worlds. Tiles of heights share their outer
/// rows with their neighbors: they have a point more along each side than `WorldFile::tile` says.
class World {
 public:
  /// Makes a world in a folder, which is made, too; opens the one that is there where it is the
  /// same. Makes tile 0,0 and, for `costs`, the ones beside it. Throws `InputError` for requests
  /// that no world can meet and where the folder holds another world, and `Cancelled`. Where the
  /// example does not repeat over the plane the returned outcome is Impossible or Unfinished, the
  /// world is null, and `why` says so.
  struct Created;
  static Created create(const std::filesystem::path& folder, const WorldRequest& request,
                        const Progress& progress = {});
  /// Opens a world. With `cached`, windows are kept in its folder.
  explicit World(const std::filesystem::path& folder, bool cached = false,
                 const Progress& progress = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// A tile. Thread-safe; throws `Cancelled`, and `InputError` where the number is out of range.
  Result tile(const PlanePoint& tile, const Progress& progress = {}) const;
  /// Several at once, as one result: what is in each is what `tile` gives.
  Result tiles(const PlaneBox& tiles, const Progress& progress = {}) const;
  /// The part of a result of several tiles that is one of them.
  Result tileOf(const Result& result, const PlaneBox& tiles, const PlanePoint& tile) const;
  /// The columns of some tiles with so many more around them.
  Result around(const PlaneBox& tiles, int columns, const Progress& progress = {}) const;

  /// Of how many columns neighboring tiles both have a copy: 1 of heights, else 0.
  int shared() const;
  /// A hash of a result's content.
  static std::uint64_t hashOf(const Result& result);
  /// Makes tile 0,0 and throws `InputError` where it is not the one that the world's maker got:
  /// tiles of this machine would not fit the others'. Where the machine has done so before, it is
  /// believed (`verified/` in the world's folder).
  void requireSameBytes(const Progress& progress = {}) const;

  const WorldFile& file() const;
  const std::filesystem::path& folder() const;
  std::span<const Example> examples() const;
  /// Of a tile, world units: what one is to be moved by for each number along x and y; along z its
  /// height, 0 of heights.
  Vec3d tileSize() const;
  /// Where a tile's file with an ending (".glb") is.
  std::filesystem::path tilePath(const PlanePoint& tile, const std::string& ending) const;

 private:
  struct State;
  explicit World(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct World::Created {
  Outcome outcome = Outcome::Complete;
  std::string why;
  std::optional<World> world;
  bool wasThere = false;
  WorldCosts costs;
  Warnings warnings;
  /// Lines about what it begins with: a label and a text.
  std::vector<std::pair<std::string, std::string>> notes;
};

}  // namespace exemplar
