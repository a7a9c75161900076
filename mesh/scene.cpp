// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/platform.h"
#include "mesh/mesh_formats.h"
#include "mesh/procedural/piece_scenes.h"
#include "mesh/procedural/processes.h"
#include "mesh/toml_text.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// A scene file's table: gives values by name, checks their ranges, and knows which were asked for.
class SceneFile {
 public:
  SceneFile(std::string_view bytes, const std::string& name)
      : path_(name), table_(parseToml(bytes, name)) {}

  double number(const std::string& key, double standard, double low, double high) {
    const toml::node* node = find(key);
    if (!node) return standard;
    const auto value = node->value<double>();
    if (!value || !(*value >= low && *value <= high)) failRange(*node, key, low, high, "a number");
    return *value;
  }

  int integer(const std::string& key, int standard, int low, int high) {
    const toml::node* node = find(key);
    if (!node) return standard;
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value || *value < low || *value > high) failRange(*node, key, low, high, "a whole number");
    return static_cast<int>(*value);
  }

  std::uint64_t seed(const std::string& key) {
    return static_cast<std::uint64_t>(integer(key, 0, 0, 2147483647));
  }

  std::string word(const std::string& key) {
    const toml::node* node = find(key);
    if (!node) throw InputError(path_ + ": '" + key + "' is missing");
    const auto value = node->value<std::string>();
    if (!value) fail(*node, "'" + key + "' must be a string");
    return *value;
  }

  Vec3d triple(const std::string& key, const Vec3d& standard, double low, double high) {
    const toml::node* node = find(key);
    if (!node) return standard;
    const toml::array* array = node->as_array();
    if (!array || array->size() != 3)
      fail(*node, "'" + key + "' must be three numbers, as in [2, 2, 1]");
    Vec3d triple;
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = array->get(axis)->value<double>();
      if (!value || !(*value >= low && *value <= high))
        failRange(*node, key, low, high, "three numbers, each");
      triple[axis] = *value;
    }
    return triple;
  }

  [[noreturn]] void failKey(const std::string& key, const std::string& what) {
    fail(*find(key), what);
  }

  /// Refuses keys that nothing asked for.
  void requireNothingElse() const {
    for (const auto& [key, node] : table_) {
      if (known_.contains(std::string(key.str()))) continue;
      std::string names;
      for (const std::string& name : known_) names += (names.empty() ? "" : ", ") + name;
      fail(node, "unknown key '" + std::string(key.str()) + "'; known are " + names);
    }
  }

 private:
  const toml::node* find(const std::string& key) {
    known_.insert(key);
    return table_.get(key);
  }
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    throw InputError(path_ + ":" + std::to_string(node.source().begin.line) + ": " + what);
  }
  [[noreturn]] void failRange(const toml::node& node, const std::string& key, double low,
                              double high, const std::string& what) const {
    std::string text = "'" + key + "' must be " + what + " from ";
    appendNumber(text, static_cast<float>(low));
    text += " to ";
    appendNumber(text, static_cast<float>(high));
    fail(node, text);
  }

  std::string path_;
  toml::table table_;
  std::set<std::string> known_;
};

using Reader =
    std::function<ProcessSample(SceneFile&, const Vec3d&, std::uint64_t, const Progress&)>;

/// Reads the parameters of each kind of process, all of them before anything is made, and makes it.
const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> all{
      {"chainmail",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         ChainmailProcess p;
         p.columns = file.integer("columns", p.columns, 1, 64);
         p.rows = 2 * file.integer("row_pairs", p.rows / 2, 1, 64);
         p.ringRadius = file.number("ring_radius", p.ringRadius, 1, 100);
         p.wireRadius =
             file.number("wire_radius", p.wireRadius, 0.05 * p.ringRadius, 0.21 * p.ringRadius);
         p.tilt = file.number("tilt", p.tilt, 0.4, 0.65);
         p.jitter = file.number("jitter", p.jitter, 0, 0.02);
         file.requireNothingElse();
         return makeChainmail(p, extent, seed, progress);
       }},
      {"balls",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         BallsProcess p;
         p.side = file.number("side", p.side, 8, 1024);
         p.radius = file.number("radius", p.radius, p.side / 32, p.side / 2);
         p.colors = file.integer("colors", p.colors, 1, 5);
         file.requireNothingElse();
         return makeBalls(p, extent, seed, progress);
       }},
      {"grid",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         GridProcess p;
         p.cells = file.integer("cells", p.cells, 1, 32);
         p.cell = file.number("cell", p.cell, 1, 1000);
         p.rodRadius = file.number("rod_radius", p.rodRadius, 0.03 * p.cell, p.cell / 4);
         p.ballRadius = file.number("ball_radius", p.ballRadius, p.rodRadius, p.cell / 2);
         p.jitter = file.number("jitter", p.jitter, 0, p.cell / 8);
         file.requireNothingElse();
         return makeGrid(p, extent, seed, progress);
       }},
      {"fibers",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         FibersProcess p;
         p.side = file.number("side", p.side, 8, 1024);
         p.spacing = file.number("spacing", p.spacing, p.side / 64, p.side);
         p.waviness = file.number("waviness", p.waviness, 0, p.spacing / 4);
         p.maxRadius =
             file.number("max_radius", p.maxRadius, 0.01 * p.spacing, 0.5 * p.spacing - p.waviness);
         p.minRadius = file.number("min_radius", std::min(p.minRadius, p.maxRadius),
                                   0.01 * p.spacing, p.maxRadius);
         file.requireNothingElse();
         return makeFibers(p, extent, seed, progress);
       }},
      {"metal",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         MetalProcess p;
         p.side = file.number("side", p.side, 8, 512);
         p.grain = file.number("grain", p.grain, p.side / 32, p.side / 2);
         p.relief = file.number("relief", p.relief, 0.1, p.side);
         p.depth = file.number("depth", p.depth, 0.5, p.side);
         file.requireNothingElse();
         return makeMetal(p, extent, seed, progress);
       }},
      {"terrain",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         TerrainProcess p;
         p.side = file.number("side", p.side, 8, 512);
         p.relief = file.number("relief", p.relief, 0.1, p.side);
         p.valley = file.number("valley", p.valley, 8, p.side);
         p.depth = file.number("depth", p.depth, 0.5, p.side);
         p.steps = file.integer("steps", p.steps, 1, 1000);
         file.requireNothingElse();
         return makeTerrain(p, extent, seed, progress);
       }},
      {"grass",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         GrassProcess p;
         p.side = file.number("side", p.side, 8, 512);
         p.spacing = file.number("spacing", p.spacing, p.side / 64, p.side);
         p.width = file.number("width", p.width, 0.1, p.side / 4);
         p.thickness = file.number("thickness", p.thickness, 0.05, p.width);
         p.length = file.number("length", p.length, p.width, p.side);
         p.soil = file.number("soil", p.soil, 0.5, p.side);
         file.requireNothingElse();
         return makeGrass(p, extent, seed, progress);
       }},
      {"bricks",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         BricksProcess p;
         p.columns = file.integer("columns", p.columns, 1, 64);
         p.courses = 2 * file.integer("course_pairs", p.courses / 2, 1, 64);
         p.length = file.number("length", p.length, 2, 512);
         p.height = file.number("height", p.height, p.length / 16, p.length);
         p.joint = file.number("joint", p.joint, 0.1 * p.height, 0.5 * p.height);
         p.relief = file.number("relief", p.relief, 0.05 * p.height, 2 * p.height);
         p.jitter = file.number("jitter", p.jitter, 0, 0.1);
         file.requireNothingElse();
         return makeBricks(p, extent, seed, progress);
       }},
      {"scales",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         ScalesProcess p;
         p.columns = file.integer("columns", p.columns, 1, 64);
         p.rows = 2 * file.integer("row_pairs", p.rows / 2, 1, 64);
         p.width = file.number("width", p.width, 2, 512);
         p.length = file.number("length", p.length, 0.5 * p.width, 1.5 * p.width);
         p.lift = file.number("lift", p.lift, 0.1, 0.5);
         p.jitter = file.number("jitter", p.jitter, 0, 0.1);
         file.requireNothingElse();
         return makeScales(p, extent, seed, progress);
       }},
      {"bark",
       [](SceneFile& file, const Vec3d& extent, std::uint64_t seed, const Progress& progress) {
         BarkProcess p;
         p.side = file.number("side", p.side, 8, 512);
         p.plate = file.number("plate", p.plate, p.side / 32, p.side / 2);
         p.grain = file.number("grain", p.grain, 1, 6);
         p.relief = file.number("relief", p.relief, 0.1, p.side);
         p.depth = file.number("depth", p.depth, 0.5, p.side);
         file.requireNothingElse();
         return makeBark(p, extent, seed, progress);
       }},
  };
  return all;
}

/// The kinds that are made of model pieces.
const std::map<std::string, ProcessSample (*)()>& pieceKinds() {
  static const std::map<std::string, ProcessSample (*)()> all{
      {"canyon", makeCanyon},   {"castle", makeCastle}, {"city", makeCity},
      {"cluster", makeCluster}, {"forest", makeForest}, {"gears", makeGears},
      {"library", makeLibrary}, {"paths", makePaths},
  };
  return all;
}

/// The folders that may hold bundled scenes, the user's choice first.
std::vector<fs::path> sceneFolders() {
  std::vector<fs::path> folders;
  if (const char* own = std::getenv("EXEMPLAR_SCENES")) folders.emplace_back(own);
  // Where an installed command finds its own, wherever it was moved to.
  if (const auto program = platform::programFile())
    folders.push_back(program->parent_path().parent_path() / "share/exemplar/scenes");
#ifdef EXEMPLAR_SOURCE_SCENES
  folders.emplace_back(EXEMPLAR_SOURCE_SCENES);
#endif
  folders.emplace_back(EXEMPLAR_INSTALLED_SCENES);
  return folders;
}

}  // namespace

Scene readScene(const fs::path& path, const SceneOptions& options, const Progress& progress) {
  return readScene(readFile(path), path.string(), options, progress);
}

Scene readScene(std::string_view bytes, const std::string& name, const SceneOptions& options,
                const Progress& progress) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(options.extent[axis] >= 1 && options.extent[axis] <= 16)) {
      throw InputError("a scene's extent must be 1 to 16 along each axis");
    }
  }
  SceneFile file(bytes, name);
  Scene scene;
  scene.name = fs::path(name).stem().string();
  const std::string kind = file.word("kind");
  const auto reader = readers().find(kind);
  const auto pieces = pieceKinds().find(kind);
  if (reader == readers().end() && pieces == pieceKinds().end()) {
    std::string names;
    for (const auto& [known, read] : readers()) names += (names.empty() ? "" : ", ") + known;
    for (const auto& [known, make] : pieceKinds()) names += ", " + known;
    file.failKey("kind", "unknown kind '" + kind + "'; known are " + names);
  }
  scene.resolution = file.integer("resolution", scene.resolution, 8, 1024);
  scene.scale = file.triple("scale", scene.scale, 0.01, 64);
  scene.block = file.integer("block", scene.block, 2, 256);
  const std::uint64_t seed = file.seed("seed");
  ProcessSample sample;
  if (reader != readers().end()) {
    sample = reader->second(file, options.extent, options.seed.value_or(seed), progress);
  } else {
    file.requireNothingElse();
    if (options.extent != Vec3d{1, 1, 1}) {
      throw InputError(name +
                       ": a scene made of model pieces has one size; synthesize a larger one");
    }
    sample = pieces->second();
  }
  scene.mesh = std::move(sample.mesh);
  scene.box = sample.box;
  scene.cell = sample.cell;
  validate(scene.mesh, name);
  return scene;
}

bool isPieceScene(const fs::path& path) {
  try {
    const fs::path found = findScene(path.string());
    return pieceKinds().contains(SceneFile(readFile(found), found.string()).word("kind"));
  } catch (const InputError&) {
    return false;
  }
}

fs::path findScene(const std::string& name) {
  const fs::path asked(name);
  std::error_code error;
  if (fs::exists(asked, error) && lowerExtension(asked) == ".toml") return asked;
  const std::string folder = asked.parent_path().string();
  if (folder.empty() || folder == "scenes") {
    const fs::path file = asked.stem().string() + ".toml";
    for (const fs::path& scenes : sceneFolders())
      if (fs::exists(scenes / file, error)) return scenes / file;
  }
  if (lowerExtension(asked) == ".toml" || !folder.empty()) return asked;
  const std::vector<std::string> known = bundledScenes();
  std::string names;
  for (const std::string& one : known) names += (names.empty() ? "" : ", ") + one;
  throw InputError(name + ": no such scene; the bundled ones are " +
                   (names.empty() ? "missing" : names));
}

std::vector<std::string> bundledScenes() {
  std::set<std::string> names;
  for (const fs::path& folder : sceneFolders()) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace exemplar
