// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world_tileset.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "core/vec.h"
#include "engine/json.h"
#include "engine/world_levels.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostInOneFile = 4096;
constexpr std::int64_t kSideOfPart = 64;

/// The box of a .glb, z up, as the accessors of its positions state it.
Box3d boxOfGlb(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  char header[20];
  std::uint32_t length = 0;
  if (file.read(header, sizeof header)) std::memcpy(&length, header + 12, sizeof length);
  std::error_code error;
  if (std::memcmp(header, "glTF", 4) != 0 || length > fs::file_size(path, error) || error)
    throw InputError(path.string() + ": is no .glb; delete it, and make it again");
  std::string text(length, '\0');
  file.read(text.data(), length);
  Box3d box;
  try {
    const Json json = Json::parse(text);
    for (const Json& primitive : json.at("meshes").at(0).at("primitives")) {
      const Json& accessor =
          json.at("accessors").at(primitive.at("attributes").at("POSITION").get<std::size_t>());
      for (const char* end : {"min", "max"}) {
        const auto p = accessor.at(end).get<std::vector<double>>();
        box.add({p.at(0), -p.at(2), p.at(1)});
      }
    }
    const Json& node = json.at("nodes").at(0);
    if (node.contains("translation")) {
      const auto p = node.at("translation").get<std::vector<double>>();
      const Vec3d shift{p.at(0), -p.at(2), p.at(1)};
      box = {box.min + shift, box.max + shift};
    }
  } catch (const std::exception& e) {
    throw InputError(path.string() + ": cannot be read: " + e.what());
  }
  return box;
}

void addBox(Box3d& box, const Box3d& more) {
  box.add(more.min);
  box.add(more.max);
}

Json boxJson(const Box3d& box) {
  const Vec3d c = 0.5 * (box.min + box.max), h = 0.5 * (box.max - box.min);
  return {{"box", {c.x, c.y, c.z, h.x, 0, 0, 0, h.y, 0, 0, 0, h.z}}};
}

/// A tile's box where it lies, and its numbers.
struct Placed {
  PlanePoint tile;
  Box3d box;
};

class Tileset {
 public:
  Tileset(const World& world, std::vector<Placed> tiles)
      : world_(world), size_(world.tileSize()), tiles_(std::move(tiles)) {}

  std::int64_t write() {
    std::int64_t files = 1;
    // Of many tiles, squares with a file of their own.
    if (tiles_.size() > kMostInOneFile) {
      std::map<PlanePoint, std::vector<Placed>> parts;
      for (const Placed& tile : tiles_)
        parts[{floorDivide(tile.tile.x, kSideOfPart), floorDivide(tile.tile.y, kSideOfPart)}]
            .push_back(tile);
      std::vector<Placed> squares;
      fs::create_directories(world_.folder() / "tilesets");
      for (auto& [part, list] : parts) {
        Placed square{part, {}};
        for (const Placed& tile : list) addBox(square.box, tile.box);
        const std::string name = std::to_string(part.x) + "_" + std::to_string(part.y) + ".json";
        writeFile(world_.folder() / "tilesets" / name,
                  file(node(list, 1, "../", [&](const Placed& tile, const Vec3d& frame) {
                    return leaf(tile, frame, "../");
                  })));
        squares.push_back(std::move(square));
        ++files;
      }
      writeFile(world_.folder() / "tileset.json",
                file(node(squares, kSideOfPart, "", [&](const Placed& square, const Vec3d&) {
                  const std::string name =
                      std::to_string(square.tile.x) + "_" + std::to_string(square.tile.y) + ".json";
                  return Json{{"boundingVolume", boxJson(square.box)},
                              {"geometricError", kSideOfPart * size_.x},
                              {"content", {{"uri", "tilesets/" + name}}}};
                })));
    } else {
      writeFile(world_.folder() / "tileset.json",
                file(node(tiles_, 1, "", [&](const Placed& tile, const Vec3d& frame) {
                  return leaf(tile, frame, "");
                })));
    }
    return files;
  }

 private:
  Vec3d cornerOf(const PlanePoint& tile) const {
    return {static_cast<double>(tile.x) * size_.x, static_cast<double>(tile.y) * size_.y, 0};
  }

  /// Column by column, from `frame` on, where what is above it begins.
  static Json moved(const Vec3d& at, const Vec3d& frame) {
    return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, at.x - frame.x, at.y - frame.y, 0, 1};
  }

  Json leaf(const Placed& tile, const Vec3d& frame, const std::string& back) const {
    // The box is the tile's own.
    const Vec3d at = cornerOf(tile.tile);
    return {{"boundingVolume", boxJson({tile.box.min - at, tile.box.max - at})},
            {"geometricError", 0},
            {"transform", moved(at, frame)},
            {"content",
             {{"uri", back + "tiles/0/" + std::to_string(tile.tile.x) + "/" +
                          std::to_string(tile.tile.y) + ".glb"}}}};
  }

  /// A tree of squares over some tiles, each `side` tiles wide. Squares lie as those of the coarser
  /// levels of detail do, at multiples of their sides, but for the whole.
  template <class Leaf>
  Json node(const std::vector<Placed>& tiles, std::int64_t side, const std::string& back,
            const Leaf& leaf) const {
    PlaneBox all{tiles.front().tile, tiles.front().tile};
    for (const Placed& tile : tiles) {
      for (int axis = 0; axis < 2; ++axis) {
        all.begin[axis] = std::min(all.begin[axis], tile.tile[axis]);
        all.end[axis] = std::max(all.end[axis], tile.tile[axis] + 1);
      }
    }
    const auto longest = static_cast<std::uint64_t>(std::max(all.size(0), all.size(1)));
    auto across = static_cast<std::int64_t>(std::bit_ceil(longest));
    const PlanePoint first{floorDivide(all.begin.x, across) * across,
                           floorDivide(all.begin.y, across) * across};
    if (all.end.x > first.x + across || all.end.y > first.y + across) across *= 2;
    return square({tiles, first, across, side, back, {0, 0, 0}}, leaf);
  }

  /// A square of a tree: its tiles, its first one's number, how many it is wide, and the rest.
  struct Square {
    std::vector<Placed> tiles;
    PlanePoint first;
    std::int64_t across = 1, side = 1;
    std::string back;
    Vec3d frame;  ///< where what is above it begins
  };

  /// The coarser tile that shows all of a square, its box in the world, and its error.
  struct Coarser {
    std::string name;
    Box3d box;
    double error = 0;
  };
  std::optional<Coarser> coarserOf(const Square& s) const {
    const int level = std::countr_zero(static_cast<std::uint64_t>(s.across));
    if (s.side != 1 || level > kMostLevels) return std::nullopt;
    if (static_cast<std::int64_t>(s.tiles.size()) != s.across * s.across) return std::nullopt;
    const PlanePoint tile{floorDivide(s.first.x, s.across), floorDivide(s.first.y, s.across)};
    if (tile.x * s.across != s.first.x || tile.y * s.across != s.first.y) return std::nullopt;
    const std::optional<double> error = levelError(world_, level, tile);
    if (!error) return std::nullopt;
    const Box3d box = boxOfGlb(levelPath(world_, level, tile, ".glb"));
    const Vec3d at = cornerOf(s.first);
    return Coarser{"tiles/" + std::to_string(level) + "/" + std::to_string(tile.x) + "/" +
                       std::to_string(tile.y) + ".glb",
                   {box.min + at, box.max + at},
                   *error};
  }

  template <class Leaf>
  Json square(const Square& s, const Leaf& leaf) const {
    if (s.across == 1) return leaf(s.tiles.front(), s.frame);
    Box3d box;
    for (const Placed& tile : s.tiles) addBox(box, tile.box);
    const std::optional<Coarser> coarser = coarserOf(s);
    if (coarser) addBox(box, coarser->box);
    const Vec3d frame = coarser ? cornerOf(s.first) : s.frame;
    Json children = Json::array();
    const std::int64_t half = s.across / 2;
    double error = coarser ? coarser->error : 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const PlanePoint begin{s.first.x + quarter % 2 * half, s.first.y + quarter / 2 * half};
      Square part{{}, begin, half, s.side, s.back, frame};
      for (const Placed& tile : s.tiles)
        if (PlaneBox{begin, {begin.x + half, begin.y + half}}.contains(tile.tile))
          part.tiles.push_back(tile);
      if (part.tiles.empty()) continue;
      children.push_back(square(part, leaf));
      error = std::max(error, children.back()["geometricError"].template get<double>());
    }
    Json node{
        {"boundingVolume", boxJson({box.min - frame, box.max - frame})},
        {"geometricError", coarser ? error : static_cast<double>(s.across * s.side) * size_.x},
        {"refine", coarser ? "REPLACE" : "ADD"},
        {"children", std::move(children)}};
    if (coarser) {
      node["transform"] = moved(frame, s.frame);
      node["content"] = {{"uri", s.back + coarser->name}};
    }
    return node;
  }

  /// A file of a tree; one of a single tile is worth loading, too.
  std::string file(Json root) const {
    if (!root.contains("refine")) root["refine"] = "ADD";
    const double error = std::max(root["geometricError"].get<double>(), size_.x);
    return jsonText(Json{{"asset", {{"version", "1.1"}, {"generator", "exemplar"}}},
                         {"geometricError", error},
                         {"root", std::move(root)}},
                    1) +
           "\n";
  }

  const World& world_;
  Vec3d size_;  // of a tile, world units
  std::vector<Placed> tiles_;
};

}  // namespace

WrittenTileset writeTileset(const World& world, const std::vector<ListedTile>& tiles) {
  const Vec3d size = world.tileSize();
  std::vector<Placed> placed;
  for (const ListedTile& listed : tiles) {
    if (std::ranges::find(listed.endings, ".glb") == listed.endings.end()) continue;
    const Vec3d at{static_cast<double>(listed.tile.x) * size.x,
                   static_cast<double>(listed.tile.y) * size.y, 0};
    const Box3d box = boxOfGlb(world.tilePath(listed.tile, ".glb"));
    placed.push_back({listed.tile, {box.min + at, box.max + at}});
  }
  WrittenTileset written{static_cast<std::int64_t>(placed.size()), 0};
  if (!placed.empty()) written.files = Tileset(world, std::move(placed)).write();
  return written;
}

}  // namespace exemplar
