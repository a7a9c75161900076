// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "voxelize/tiled_map.h"

namespace exemplar {

/// The tiles of a layer, or of a chunk of one, from the text of its `<data>` or `<chunk>`: exactly
/// `count`, row by row from the top. Throws `InputError` (`what`: ...) for anything else. Elements
/// are not read here: they are tags.
std::vector<std::uint32_t> decodeTiles(std::string_view text, TiledMap::Encoding encoding,
                                       std::size_t count, const std::string& what);
/// The text for a layer of rows of `width` tiles, elements too.
std::string encodeTiles(std::span<const std::uint32_t> tiles, TiledMap::Encoding encoding,
                        int width);

}  // namespace exemplar
