// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/progress.h"
#include "engine/world.h"

/// Tiles of a world on demand, over HTTP, and a page that flies over them.
namespace exemplar {

struct WorldServerOptions {
  /// The address that is listened at: this machine alone by default.
  std::string host = "127.0.0.1";
  int port = 8700;  ///< 0: one that is free
  int waiting = 8;  ///< requests for tiles that may wait for one that is being made, 0..1000
  std::int64_t most = 4096;  ///< tiles that are made in all; >= 0
};

/// Whether the program was built with what this takes (cpp-httplib).
bool canServe();

/// Serves a world until `progress` is cancelled, and then throws `Cancelled`:
///
///     /                    the page
///     /world.json          what it needs to know of the world
///     /tileset.json        the world's, where `writeTileset` has written one
///     /tiles/0/I/J.glb     a tile's file; if need be made, and kept in the world's folder
///
/// Nothing else is answered, nothing is read or written but by a tile's number and format, and only
/// GET and HEAD; where `host` is of this machine alone, only for its own names. One tile is made at
/// a time, by all cores; where too many wait, or as many as `most` were made, the answer is 503.
/// `listening` hears the address once. Throws `InputError` where it cannot be listened at.
void serveWorld(const World& world, const WorldServerOptions& options,
                const std::function<void(const std::string& address)>& listening,
                const Progress& progress);

}  // namespace exemplar
