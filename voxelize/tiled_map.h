// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "voxelize/label_grid.h"

namespace exemplar {

/// A map of the Tiled editor as a flat grid of labels. What a cell holds is the stack of its tiles
/// in all layers; each different stack is a label, 0 the one without any. Tiles that are flipped or
/// turned are other tiles, with Tiled's bits in their numbers.
struct TiledMap {
  /// One layer; x to the right, y up, so that the map's first row is the last one.
  LabelGrid grid;
  /// For each label, its tile in each layer, as the file numbers it: in a .tmx the global number,
  /// 0 where there is none, with the flip bits on top.
  std::vector<std::vector<std::uint32_t>> stacks;
  /// What each label is when mirrored across x or y, or turned a quarter counterclockwise: the
  /// stack flipped so, where the map has it; else the label itself.
  std::vector<Label> mirroredX, mirroredY, turned;

  /// How a layer's tiles are written.
  enum class Encoding { Elements, Csv, Base64, Zlib, Gzip };
  std::vector<Encoding> layers;
  /// The file, in pieces: before each of `slots`, and what comes after the last one. Without
  /// slots it was a .csv.
  std::vector<std::string> text;
  struct Slot {
    enum class Kind { Width, Height, Tiles, Path } kind;
    int layer = 0;     ///< Tiles
    std::string path;  ///< Path: of another file, from the map's folder
  };
  std::vector<Slot> slots;
  std::filesystem::path folder;  ///< of the map; empty where it is not a file
  /// What the map has and a result will not have, for people: "object layers".
  std::vector<std::string> dropped;

  /// Whether any label is another one when mirrored or turned.
  bool hasFlips() const;
  /// Adds the stack of a label that another map has, too: its own image in mirrors and turns. The
  /// map must be of as many layers: throws `InputError`.
  void addLabel(const std::vector<std::uint32_t>& stack);
};

/// Bits on top of the number of a tile that is flipped: left and right, up and down, along the
/// diagonal (first). https://doc.mapeditor.org/en/stable/reference/global-tile-ids/
inline constexpr std::uint32_t kFlippedX = 0x80000000u, kFlippedY = 0x40000000u,
                               kFlippedDiagonally = 0x20000000u;

/// Whether the path's ending is `.tmx` or `.csv`.
bool isTiledFile(const std::filesystem::path& path);

/// Reads a `.tmx`: orthogonal or isometric, finite or infinite, its tiles as elements, CSV, or
/// base64 that may be compressed with zlib or gzip; of infinite maps the box of all tiles. Layers
/// in groups count; object and image layers do not. Throws `InputError` ("NAME: ...") for anything
/// malformed, hexagonal and staggered maps, Zstandard, more than 65,535 different stacks, and more
/// cells than an `Array3D` has.
TiledMap parseTiledMap(std::string_view bytes, const std::string& name,
                       const Progress& progress = {});
/// Reads a `.csv` as Tiled exports one layer: a line a row, -1 where there is no tile, with flip
/// bits, or any whole numbers from 0 to 2^32 - 1, each a label.
TiledMap parseTileRows(std::string_view bytes, const std::string& name,
                       const Progress& progress = {});
/// Either of them, by the path's ending.
TiledMap readTiledMap(const std::filesystem::path& path, const Progress& progress = {});

/// Writes a flat grid of a map's labels as that map, with its tilesets, properties and layers; in
/// another size, without objects and images, never infinite. Paths to tilesets and pictures are
/// made anew where `path` is in another folder. A `.csv` has the uppermost tile of each stack.
/// The same grid gives the same bytes. Throws `InputError` for grids of several layers or other
/// labels, and for a .tmx where the map was a .csv.
void writeTiledMap(const std::filesystem::path& path, const LabelGrid& grid, const TiledMap& map,
                   const Progress& progress = {});
/// The numbers of a flat grid's labels as a `.csv`, -1 where a label is empty.
void writeLabelRows(const std::filesystem::path& path, const LabelGrid& grid,
                    const Progress& progress = {});

}  // namespace exemplar
