// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world_tileset.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "core/vec.h"
#include "engine/json.h"

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
                  file(node(list, 1, [&](const Placed& tile) { return leaf(tile, "../"); })));
        squares.push_back(std::move(square));
        ++files;
      }
      writeFile(world_.folder() / "tileset.json",
                file(node(squares, kSideOfPart, [&](const Placed& square) {
                  const std::string name =
                      std::to_string(square.tile.x) + "_" + std::to_string(square.tile.y) + ".json";
                  return Json{{"boundingVolume", boxJson(square.box)},
                              {"geometricError", kSideOfPart * size_.x},
                              {"content", {{"uri", "tilesets/" + name}}}};
                })));
    } else {
      writeFile(world_.folder() / "tileset.json",
                file(node(tiles_, 1, [&](const Placed& tile) { return leaf(tile, ""); })));
    }
    return files;
  }

 private:
  Json leaf(const Placed& tile, const std::string& back) const {
    // Column by column; the box is the tile's own.
    const Vec3d at{static_cast<double>(tile.tile.x) * size_.x,
                   static_cast<double>(tile.tile.y) * size_.y, 0};
    return {{"boundingVolume", boxJson({tile.box.min - at, tile.box.max - at})},
            {"geometricError", 0},
            {"transform", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, at.x, at.y, 0, 1}},
            {"content",
             {{"uri", back + "tiles/0/" + std::to_string(tile.tile.x) + "/" +
                          std::to_string(tile.tile.y) + ".glb"}}}};
  }

  /// A tree of squares over some tiles, each `side` tiles wide.
  template <class Leaf>
  Json node(const std::vector<Placed>& tiles, std::int64_t side, const Leaf& leaf) const {
    PlaneBox all{tiles.front().tile, tiles.front().tile};
    for (const Placed& tile : tiles) {
      for (int axis = 0; axis < 2; ++axis) {
        all.begin[axis] = std::min(all.begin[axis], tile.tile[axis]);
        all.end[axis] = std::max(all.end[axis], tile.tile[axis] + 1);
      }
    }
    const auto longest = static_cast<std::uint64_t>(std::max(all.size(0), all.size(1)));
    return square(tiles, all.begin, static_cast<std::int64_t>(std::bit_ceil(longest)), side, leaf);
  }

  template <class Leaf>
  Json square(const std::vector<Placed>& tiles, const PlanePoint& first, std::int64_t across,
              std::int64_t side, const Leaf& leaf) const {
    if (across == 1) return leaf(tiles.front());
    Box3d box;
    for (const Placed& tile : tiles) addBox(box, tile.box);
    Json children = Json::array();
    const std::int64_t half = across / 2;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const PlanePoint begin{first.x + quarter % 2 * half, first.y + quarter / 2 * half};
      std::vector<Placed> inside;
      for (const Placed& tile : tiles)
        if (PlaneBox{begin, {begin.x + half, begin.y + half}}.contains(tile.tile))
          inside.push_back(tile);
      if (!inside.empty()) children.push_back(square(inside, begin, half, side, leaf));
    }
    return {{"boundingVolume", boxJson(box)},
            {"geometricError", static_cast<double>(across * side) * size_.x},
            {"refine", "ADD"},
            {"children", std::move(children)}};
  }

  /// A file of a tree; one of a single tile is worth loading, too.
  std::string file(Json root) const {
    root["refine"] = "ADD";
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
