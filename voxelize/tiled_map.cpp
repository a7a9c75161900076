// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/tiled_map.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "voxelize/tile_data.h"
#include "voxelize/xml_tags.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using Encoding = TiledMap::Encoding;
using Slot = TiledMap::Slot;

constexpr std::uint32_t kFlips = kFlippedX | kFlippedY | kFlippedDiagonally;
/// The bit of a turned hexagon: such maps are not read.
constexpr std::uint32_t kTurnedHexagon = 0x10000000u;
constexpr int kFurthest = 1 << 24;  // from the middle of an infinite map, tiles
constexpr std::int64_t kMostCells = std::int64_t{1} << 26;

/// A rectangle of a layer's tiles; y down.
struct Chunk {
  int x = 0, y = 0, width = 0, height = 0;
  std::vector<std::uint32_t> tiles;
};

struct Layer {
  std::string name;
  Encoding encoding = Encoding::Elements;
  std::vector<Chunk> chunks;
};

/// Reads a .tmx tag by tag, and remembers what of it is written anew.
class TmxReader {
 public:
  TmxReader(std::string_view bytes, const std::string& name, const Progress& progress)
      : bytes_(bytes), name_(name), tags_(bytes_, name), progress_(progress) {}

  TiledMap read();

 private:
  struct Edit {
    std::size_t begin, end;
    std::optional<Slot> slot;  // none: `text`
    std::string text;
  };

  void readMap(const Tag& tag);
  void readLayer(const Tag& tag);
  void readData(const Tag& tag, Layer& layer, int width, int height);
  void readChunk(const Tag& tag, Layer& layer, const Chunk& place);
  void passOver(const Tag& tag);
  void takePath(const Tag& tag);
  int number(const Tag& tag, std::string_view key, int least, std::optional<int> otherwise = {});
  void replace(const Tag& tag, std::string_view key, const Slot& slot) {
    const Tag::Attribute* a = tag.find(key);
    if (a) edits_.push_back({a->begin, a->begin + a->value.size(), slot, {}});
  }
  void makeText(TiledMap& map) const;

  std::string_view bytes_;
  const std::string& name_;
  Tags tags_;
  const Progress& progress_;
  int width_ = 0, height_ = 0;
  bool infinite_ = false, anyMap_ = false;
  std::uint32_t firstOfTileset_ = 0;
  std::vector<Layer> layers_;
  std::vector<Edit> edits_;
  std::map<std::uint32_t, std::string> classes_;  // of tiles, by global number
  std::vector<std::string> dropped_;
};

int TmxReader::number(const Tag& tag, std::string_view key, int least,
                      std::optional<int> otherwise) {
  const Tag::Attribute* a = tag.find(key);
  if (!a && otherwise) return *otherwise;
  int value = 0;
  const std::string_view text = a ? a->value : std::string_view{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size() || value < least ||
      value > kFurthest)
    tags_.fail("<" + std::string(tag.name) + "> needs a whole number \"" + std::string(key) + "\"");
  return value;
}

void TmxReader::readMap(const Tag& tag) {
  anyMap_ = true;
  const std::string_view orientation = tag.value("orientation");
  if (!orientation.empty() && orientation != "orthogonal" && orientation != "isometric")
    tags_.fail("is a " + std::string(orientation) +
               " map, whose tiles have other neighbors; orthogonal and isometric maps are read");
  width_ = number(tag, "width", 1);
  height_ = number(tag, "height", 1);
  infinite_ = tag.value("infinite") == "1";
  replace(tag, "width", {Slot::Kind::Width, 0, {}});
  replace(tag, "height", {Slot::Kind::Height, 0, {}});
  if (const Tag::Attribute* a = tag.find("infinite"))
    edits_.push_back({a->begin, a->begin + a->value.size(), std::nullopt, "0"});
}

/// Passes over an element with all that is in it; it will not be written.
void TmxReader::passOver(const Tag& tag) {
  const std::string name(tag.name);
  std::size_t end = tag.end;
  for (int depth = tag.alone ? 0 : 1; depth > 0;) {
    Tag inner;
    if (!tags_.next(inner)) tags_.fail("ends within <" + name + ">");
    if (inner.name == name) depth += inner.closes ? -1 : inner.alone ? 0 : 1;
    end = inner.end;
  }
  edits_.push_back({tag.begin, end, std::nullopt, {}});
}

void TmxReader::takePath(const Tag& tag) {
  const std::string path(tag.value("source"));
  if (!path.empty()) replace(tag, "source", {Slot::Kind::Path, 0, path});
}

void TmxReader::readChunk(const Tag& tag, Layer& layer, const Chunk& place) {
  Chunk chunk = place;
  const std::string what = name_ + ": layer " + layer.name;
  const std::int64_t count = std::int64_t{chunk.width} * chunk.height;
  if (count > kMostCells) throw InputError(what + ": has more than 67,108,864 tiles");
  const std::string end(tag.name);
  Tag inner;
  for (;;) {
    if (!tags_.next(inner)) tags_.fail("ends within <" + end + ">");
    if (inner.closes && inner.name == end) break;
    if (inner.name != "tile" || layer.encoding != Encoding::Elements) continue;
    const std::string_view gid = inner.value("gid");
    std::uint32_t tile = 0;
    const auto [stop, error] = std::from_chars(gid.data(), gid.data() + gid.size(), tile);
    if (!gid.empty() && (error != std::errc{} || stop != gid.data() + gid.size()))
      tags_.fail("'" + std::string(gid) + "' is not the number of a tile");
    if (!inner.closes) chunk.tiles.push_back(tile);
  }
  const auto wanted = static_cast<std::size_t>(count);
  if (layer.encoding == Encoding::Elements) {
    if (chunk.tiles.size() != wanted)
      throw InputError(what + ": has " + std::to_string(chunk.tiles.size()) + " tiles, not the " +
                       std::to_string(wanted) + " that its size says");
  } else {
    chunk.tiles =
        decodeTiles(bytes_.substr(tag.end, inner.begin - tag.end), layer.encoding, wanted, what);
  }
  layer.chunks.push_back(std::move(chunk));
  if (end == "data") {
    const Slot slot{Slot::Kind::Tiles, static_cast<int>(layers_.size()), {}};
    edits_.push_back({tag.end, inner.begin, slot, {}});
  }
}

void TmxReader::readData(const Tag& tag, Layer& layer, int width, int height) {
  const std::string_view encoding = tag.value("encoding"), packed = tag.value("compression");
  if (encoding == "csv") {
    layer.encoding = Encoding::Csv;
  } else if (encoding == "base64") {
    if (!packed.empty() && packed != "zlib" && packed != "gzip")
      tags_.fail("tiles compressed by " + std::string(packed) +
                 " are not read; save the map with zlib or gzip");
    layer.encoding = packed.empty()     ? Encoding::Base64
                     : packed == "zlib" ? Encoding::Zlib
                                        : Encoding::Gzip;
  } else if (!encoding.empty()) {
    tags_.fail("unknown encoding of tiles: " + std::string(encoding));
  }
  if (tag.alone) tags_.fail("layer " + layer.name + " has no tiles");
  if (!infinite_) return readChunk(tag, layer, {0, 0, width, height, {}});
  Tag inner;
  for (;;) {
    if (!tags_.next(inner)) tags_.fail("ends within <data>");
    if (inner.closes && inner.name == "data") break;
    if (inner.closes || inner.name != "chunk") continue;
    readChunk(inner, layer,
              {number(inner, "x", -kFurthest),
               number(inner, "y", -kFurthest),
               number(inner, "width", 1),
               number(inner, "height", 1),
               {}});
  }
  const Slot slot{Slot::Kind::Tiles, static_cast<int>(layers_.size()), {}};
  edits_.push_back({tag.end, inner.begin, slot, {}});
}

void TmxReader::readLayer(const Tag& tag) {
  Layer layer;
  layer.name = tag.value("name").empty() ? std::to_string(layers_.size() + 1)
                                         : std::string(tag.value("name"));
  const int width = number(tag, "width", 1, width_), height = number(tag, "height", 1, height_);
  replace(tag, "width", {Slot::Kind::Width, 0, {}});
  replace(tag, "height", {Slot::Kind::Height, 0, {}});
  bool data = false;
  for (Tag inner;;) {
    if (tag.alone || !tags_.next(inner)) tags_.fail("layer " + layer.name + " has no tiles");
    if (inner.closes && inner.name == "layer") break;
    if (inner.closes || inner.name != "data") continue;
    readData(inner, layer, width, height);
    data = true;
  }
  if (!data) tags_.fail("layer " + layer.name + " has no tiles");
  layers_.push_back(std::move(layer));
}

/// The file in pieces between what is written anew.
void TmxReader::makeText(TiledMap& map) const {
  std::vector<Edit> edits = edits_;
  std::ranges::stable_sort(edits, {}, &Edit::begin);
  std::size_t done = 0;
  map.text.emplace_back();
  for (const Edit& edit : edits) {
    if (edit.begin < done) continue;  // within what is passed over
    map.text.back() += bytes_.substr(done, edit.begin - done);
    map.text.back() += edit.text;
    done = edit.end;
    if (!edit.slot) continue;
    map.slots.push_back(*edit.slot);
    map.text.emplace_back();
  }
  map.text.back() += bytes_.substr(done);
}

/// Numbers stacks of tiles as labels.
class Stacks {
 public:
  Stacks(TiledMap& map, const std::string& name, std::size_t layers) : map_(map), name_(name) {
    numbers_[std::vector<std::uint32_t>(layers, 0)] = 0;
    map_.stacks.emplace_back(layers, 0);
    map_.grid.labels.push_back(emptyLook());
  }

  Label number(const std::vector<std::uint32_t>& stack) {
    const auto [at, fresh] = numbers_.try_emplace(stack, static_cast<int>(map_.stacks.size()));
    if (fresh) {
      if (map_.stacks.size() == static_cast<std::size_t>(kMostLabels))
        throw InputError(name_ + ": has more than 65,535 different stacks of tiles");
      map_.stacks.push_back(stack);
      tiles_.insert(stack.begin(), stack.end());
      LabelLook look;
      look.color = distinctColor(at->second);
      map_.grid.labels.push_back(look);
    }
    return static_cast<Label>(at->second);
  }
  /// The label of a stack with each tile changed, where the map has that tile; `label` where it has
  /// no such stack.
  template <class Change>
  Label changed(Label label, const Change& change) const {
    std::vector<std::uint32_t> stack = map_.stacks[label];
    for (std::uint32_t& tile : stack) {
      const std::uint32_t other = change(tile);
      if (tiles_.contains(other)) tile = other;
    }
    const auto at = numbers_.find(stack);
    return at == numbers_.end() ? label : static_cast<Label>(at->second);
  }

 private:
  TiledMap& map_;
  const std::string& name_;
  std::map<std::vector<std::uint32_t>, int> numbers_;
  std::set<std::uint32_t> tiles_;
};

/// A tile's flips as a matrix of what is drawn: first the diagonal, then x and y.
using Flip = std::array<int, 4>;

Flip flipOf(std::uint32_t tile) {
  const int x = tile & kFlippedX ? -1 : 1, y = tile & kFlippedY ? -1 : 1;
  return tile & kFlippedDiagonally ? Flip{0, x, y, 0} : Flip{x, 0, 0, y};
}

/// The tile that looks like `tile` after `turn`.
std::uint32_t flipped(std::uint32_t tile, const Flip& turn) {
  const Flip f = flipOf(tile);
  const Flip product{turn[0] * f[0] + turn[1] * f[2], turn[0] * f[1] + turn[1] * f[3],
                     turn[2] * f[0] + turn[3] * f[2], turn[2] * f[1] + turn[3] * f[3]};
  for (std::uint32_t bits = 0; bits < 8; ++bits) {
    if (flipOf(bits << 29) == product) return (tile & ~kFlips) | bits << 29;
  }
  return tile;
}

/// Names, and what labels become when mirrored and turned.
void describeStacks(TiledMap& map, const Stacks& stacks,
                    const std::map<std::uint32_t, std::string>& classes, std::uint32_t first) {
  // Rows go down: a quarter turn counterclockwise takes (x, y) to (y, -x).
  constexpr Flip kMirrorX{-1, 0, 0, 1}, kMirrorY{1, 0, 0, -1}, kTurn{0, 1, -1, 0};
  for (std::size_t l = 0; l < map.stacks.size(); ++l) {
    const auto label = static_cast<Label>(l);
    const auto becomes = [&](const Flip& turn) {
      return stacks.changed(label, [&](std::uint32_t tile) { return flipped(tile, turn); });
    };
    map.mirroredX.push_back(becomes(kMirrorX));
    map.mirroredY.push_back(becomes(kMirrorY));
    map.turned.push_back(becomes(kTurn));
    if (l == 0) continue;
    std::string& name = map.grid.labels[l].name;
    for (const std::uint32_t tile : map.stacks[l]) {
      if (tile == 0) continue;
      const std::uint32_t number = tile & ~(kFlips | kTurnedHexagon);
      if (!name.empty()) name += ", ";
      if (const auto known = classes.find(number); known != classes.end())
        name += known->second + ", ";
      name += "tile " + std::to_string(number - first);
      if (tile & kFlippedX) name += ", flipped x";
      if (tile & kFlippedY) name += ", flipped y";
      if (tile & kFlippedDiagonally) name += ", flipped diagonally";
    }
  }
}

/// Where tiles are in any layer; y down.
Chunk boxOfTiles(const std::vector<Layer>& layers) {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -(1 << 30), y1 = -(1 << 30);
  for (const Layer& layer : layers) {
    for (const Chunk& c : layer.chunks) {
      for (std::size_t i = 0; i < c.tiles.size(); ++i) {
        if (c.tiles[i] == 0) continue;
        const int x = c.x + static_cast<int>(i) % c.width, y = c.y + static_cast<int>(i) / c.width;
        x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
        y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
      }
    }
  }
  return x1 < x0 ? Chunk{} : Chunk{x0, y0, x1 - x0, y1 - y0, {}};
}

TiledMap TmxReader::read() {
  for (Tag tag; tags_.next(tag);) {
    progress_.check();
    if (tag.closes) {
      if (tag.name == "tileset") firstOfTileset_ = 0;
      continue;
    }
    if (tag.name == "map") {
      readMap(tag);
    } else if (!anyMap_) {
      tags_.fail("is not a map of Tiled: it begins with <" + std::string(tag.name) + ">");
    } else if (tag.name == "tileset") {
      const int first = number(tag, "firstgid", 1);
      firstOfTileset_ = tag.alone ? 0 : static_cast<std::uint32_t>(first);
      takePath(tag);
    } else if (tag.name == "image") {
      takePath(tag);
    } else if (tag.name == "tile" && firstOfTileset_ > 0) {
      const std::string_view kind = tag.find("class") ? tag.value("class") : tag.value("type");
      if (!kind.empty())
        classes_[firstOfTileset_ + static_cast<std::uint32_t>(number(tag, "id", 0))] = kind;
    } else if (tag.name == "layer") {
      readLayer(tag);
    } else if (firstOfTileset_ == 0 && (tag.name == "objectgroup" || tag.name == "imagelayer")) {
      const std::string what = tag.name == "objectgroup" ? "object layers" : "image layers";
      if (std::ranges::find(dropped_, what) == dropped_.end()) dropped_.push_back(what);
      passOver(tag);
    }
  }
  if (!anyMap_) throw InputError(name_ + ": is not a map of Tiled");
  if (layers_.empty()) throw InputError(name_ + ": has no layer of tiles");

  TiledMap map;
  const Chunk box = infinite_ ? boxOfTiles(layers_) : Chunk{0, 0, width_, height_, {}};
  if (std::int64_t{box.width} * box.height > kMostCells)
    throw InputError(name_ + ": has more than 67,108,864 cells");
  if (box.width == 0) throw InputError(name_ + ": has no tiles");
  // Of each layer, the whole box.
  const auto count = static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height);
  std::vector<std::vector<std::uint32_t>> tiles(layers_.size(), std::vector<std::uint32_t>(count));
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    map.layers.push_back(layers_[l].encoding);
    for (const Chunk& c : layers_[l].chunks) {
      for (std::size_t i = 0; i < c.tiles.size(); ++i) {
        const int x = c.x - box.x + static_cast<int>(i) % c.width;
        const int y = c.y - box.y + static_cast<int>(i) / c.width;
        if (x < 0 || y < 0 || x >= box.width || y >= box.height) continue;
        tiles[l][static_cast<std::size_t>(y) * static_cast<std::size_t>(box.width) +
                 static_cast<std::size_t>(x)] = c.tiles[i];
      }
    }
  }
  Stacks stacks(map, name_, layers_.size());
  map.grid.cells = Array3D<Label>({box.width, box.height, 1});
  std::vector<std::uint32_t> stack(layers_.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t l = 0; l < layers_.size(); ++l) stack[l] = tiles[l][i];
    const int x = static_cast<int>(i) % box.width, y = static_cast<int>(i) / box.width;
    map.grid.cells(x, box.height - 1 - y, 0) = stacks.number(stack);
  }
  describeStacks(map, stacks, classes_, 0);
  makeText(map);
  map.dropped = std::move(dropped_);
  return map;
}

/// A path of the map's folder, from the folder of the file that is written.
std::string pathFrom(const fs::path& file, const fs::path& folder, const std::string& path) {
  if (folder.empty() || fs::path(path).is_absolute()) return path;
  std::error_code error;
  const fs::path there = fs::weakly_canonical(fs::absolute(folder, error), error);
  const fs::path here = fs::weakly_canonical(fs::absolute(file, error).parent_path(), error);
  if (error || there == here) return path;
  std::string escaped;  // the path itself is as the file spells it
  for (const char c : there.lexically_relative(here).generic_string())
    escaped += c == '&' ? "&amp;" : c == '"' ? "&quot;" : c == '<' ? "&lt;" : std::string(1, c);
  return escaped + "/" + path;
}

/// Tiles row by row from the top.
std::vector<std::uint32_t> tilesOf(const LabelGrid& grid, const TiledMap& map, std::size_t layer) {
  std::vector<std::uint32_t> tiles;
  tiles.reserve(grid.cells.count());
  for (int y = grid.size().y - 1; y >= 0; --y) {
    for (int x = 0; x < grid.size().x; ++x) tiles.push_back(map.stacks[grid.cells(x, y, 0)][layer]);
  }
  return tiles;
}

void requireFlat(const fs::path& path, const LabelGrid& grid) {
  if (grid.size().z != 1)
    throw InputError(path.string() + ": a map of tiles has one layer, and the result " +
                     std::to_string(grid.size().z) + "; write a .txt, .vox, .vdb or a mesh");
}

}  // namespace

bool TiledMap::hasFlips() const {
  for (const auto* images : {&mirroredX, &mirroredY, &turned}) {
    for (std::size_t l = 0; l < images->size(); ++l)
      if ((*images)[l] != l) return true;
  }
  return false;
}

void TiledMap::addLabel(const std::vector<std::uint32_t>& stack) {
  if (stack.size() != layers.size())
    throw InputError("maps of tiles that are mixed must have as many layers; one has " +
                     std::to_string(layers.size()) + " and another one " +
                     std::to_string(stack.size()));
  const auto label = static_cast<Label>(stacks.size());
  stacks.push_back(stack);
  for (auto* images : {&mirroredX, &mirroredY, &turned}) images->push_back(label);
}

bool isTiledFile(const fs::path& path) {
  const std::string ending = lowerExtension(path);
  return ending == ".tmx" || ending == ".csv";
}

TiledMap parseTiledMap(std::string_view bytes, const std::string& name, const Progress& progress) {
  std::string decoded;
  return TmxReader(asUtf8(bytes, decoded), name, progress).read();
}

TiledMap parseTileRows(std::string_view bytes, const std::string& name, const Progress& progress) {
  std::string decoded;
  const std::string_view text = asUtf8(bytes, decoded);
  std::vector<std::vector<std::uint32_t>> rows;
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size();) {
    progress.check();
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    std::string_view row = text.substr(at, end - at);
    at = end + 1;
    if (end < text.size() && text[end] == '\r' && at < text.size() && text[at] == '\n') ++at;
    ++line;
    const auto fail = [&](const std::string& message) {
      throw InputError(name + ":" + std::to_string(line) + ": " + message);
    };
    while (!row.empty() && (row.back() == ' ' || row.back() == ',')) row.remove_suffix(1);
    if (row.empty()) continue;
    std::vector<std::uint32_t>& tiles = rows.emplace_back();
    for (std::size_t begin = 0; begin <= row.size();) {
      const std::size_t comma = std::min(row.find_first_of(",;\t", begin), row.size());
      std::string_view word = row.substr(begin, comma - begin);
      while (word.starts_with(' ')) word.remove_prefix(1);
      while (word.ends_with(' ')) word.remove_suffix(1);
      begin = comma + 1;
      std::int64_t value = 0;
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (word.empty() || error != std::errc{} || stop != word.data() + word.size() ||
          value < -(std::int64_t{1} << 31) || value >= std::int64_t{1} << 32)
        fail("'" + std::string(word.substr(0, 20)) + "' is not the number of a tile");
      const auto bits = static_cast<std::uint32_t>(value);
      if (value != -1 && (bits & ~kFlips) == ~kFlips) fail("tiles are numbered up to 536,870,910");
      tiles.push_back(value == -1 ? 0 : bits + 1);
    }
    if (tiles.size() != rows.front().size())
      fail("has " + std::to_string(tiles.size()) + " tiles, and the first row has " +
           std::to_string(rows.front().size()));
  }
  if (rows.empty()) throw InputError(name + ": has no tiles");
  TiledMap map;
  const int width = static_cast<int>(rows.front().size()), height = static_cast<int>(rows.size());
  Stacks stacks(map, name, 1);
  map.grid.cells = Array3D<Label>({width, height, 1});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      map.grid.cells(x, height - 1 - y, 0) =
          stacks.number({rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]});
  }
  map.layers = {Encoding::Csv};
  describeStacks(map, stacks, {}, 1);
  return map;
}

TiledMap readTiledMap(const fs::path& path, const Progress& progress) {
  const std::string bytes = readFile(path, progress), name = path.string();
  if (lowerExtension(path) == ".csv") return parseTileRows(bytes, name, progress);
  TiledMap map = parseTiledMap(bytes, name, progress);
  std::error_code error;
  map.folder = fs::absolute(path, error).parent_path();
  return map;
}

void writeTiledMap(const fs::path& path, const LabelGrid& grid, const TiledMap& map,
                   const Progress& progress) {
  requireFlat(path, grid);
  if (grid.labelCount() > static_cast<int>(map.stacks.size()))
    throw InputError(path.string() + ": has labels that are no tiles of the map");
  std::string bytes;
  if (lowerExtension(path) == ".csv") {
    for (int y = grid.size().y - 1; y >= 0; --y) {
      for (int x = 0; x < grid.size().x; ++x) {
        std::int64_t shown = -1;
        for (const std::uint32_t tile : map.stacks[grid.cells(x, y, 0)])
          if (tile != 0) shown = std::int64_t{tile} - (map.slots.empty() ? 1 : 0);
        bytes += (x > 0 ? "," : "") + std::to_string(shown);
      }
      bytes += '\n';
    }
    return writeFile(path, bytes, progress);
  }
  if (map.slots.empty())
    throw InputError(path.string() + ": a .tmx is written of an example that is one; write a .csv");
  for (std::size_t i = 0; i < map.slots.size(); ++i) {
    bytes += map.text[i];
    const Slot& slot = map.slots[i];
    const auto layer = static_cast<std::size_t>(slot.layer);
    switch (slot.kind) {
      case Slot::Kind::Width:
        bytes += std::to_string(grid.size().x);
        break;
      case Slot::Kind::Height:
        bytes += std::to_string(grid.size().y);
        break;
      case Slot::Kind::Tiles:
        bytes += encodeTiles(tilesOf(grid, map, layer), map.layers[layer], grid.size().x);
        break;
      case Slot::Kind::Path:
        bytes += pathFrom(path, map.folder, slot.path);
        break;
    }
  }
  writeFile(path, bytes + map.text.back(), progress);
}

void writeLabelRows(const fs::path& path, const LabelGrid& grid, const Progress& progress) {
  requireFlat(path, grid);
  std::string bytes;
  for (int y = grid.size().y - 1; y >= 0; --y) {
    for (int x = 0; x < grid.size().x; ++x) {
      const Label label = grid.cells(x, y, 0);
      bytes += (x > 0 ? "," : "") +
               std::to_string(isEmpty(grid.labels[label]) ? -1 : static_cast<int>(label));
    }
    bytes += '\n';
  }
  writeFile(path, bytes, progress);
}

}  // namespace exemplar
