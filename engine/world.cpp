// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "engine/words.h"
#include "engine/world_content.h"
#include "maps/height_map_file.h"
#include "mesh/mesh_file.h"
#include "mesh/scene.h"
#include "synth/terrain/height_world.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// What an engine needs of the settings that speak of reading the example.
ReadOptions readingOf(const Settings& settings, Form form) {
  ReadOptions reading;
  reading.form = form;
  readingSettings(form).apply(settings, reading);
  // The example that a world keeps says these itself.
  if (form == Form::Heights) reading.cellSize = reading.heightScale = std::nullopt;
  checkReading(reading);
  return reading;
}

/// The settings that are asked of the engine: not those of reading, and not the seed.
Settings engineSettings(const Settings& settings, Form form) {
  Settings own = settings;
  for (const Setting& setting : readingSettings(form).settings()) own.remove(setting.key);
  own.remove("seed");
  return own;
}

struct Sizes {
  int tile, window;  ///< where nothing is said
  int leastWindow, mostWindow;
};
/// Of the worlds of an engine; nothing where it makes none.
std::optional<Sizes> worldSizes(const Engine& engine) {
  if (engine.name() == "model") return Sizes{72, 36, 12, 512};
  if (engine.name() == "terrain") return Sizes{256, 384, kLeastHeightWindow, kMostHeightWindow};
  return std::nullopt;
}

/// Refuses what no world can meet, before anything is read.
void checkRequest(const WorldRequest& request, const Engine& engine) {
  const std::optional<Sizes> sizes = worldSizes(engine);
  if (!sizes)
    throw InputError("the engine " + std::string(engine.name()) +
                     " makes no worlds; model does, of labels and scenes of pieces, and terrain, "
                     "of height maps");
  if (request.tile && (*request.tile < 8 || *request.tile > kMostTileSide))
    throw InputError("`tile` " + std::to_string(*request.tile) + ": expected 8 to " +
                     std::to_string(kMostTileSide) + " columns");
  if (request.window &&
      (*request.window < sizes->leastWindow || *request.window > sizes->mostWindow)) {
    throw InputError("`window` " + std::to_string(*request.window) + ": expected " +
                     std::to_string(sizes->leastWindow) + " to " +
                     std::to_string(sizes->mostWindow) + " columns");
  }
  if (request.height && (*request.height < 1 || *request.height > 1024))
    throw InputError("`height` " + std::to_string(*request.height) + ": expected 1 to 1024 cells");
  if (request.height && engine.form() == Form::Heights)
    throw InputError("`height`: heights have no layers; leave it out");
  checkSettings(engine, request.settings);
  for (const char* key : {"scale", "size"})
    if (request.settings.has(key))
      throw InputError("`" + std::string(key) +
                       "`: a world has no end; leave it out, or say how "
                       "high it is with `height`");
  for (const Setting& setting : engine.settings()) {
    if (setting.type == SettingType::File && request.settings.has(setting.key))
      throw InputError("`" + setting.key +
                       "`: a world holds no file but its example; leave it out");
  }
  for (const std::string& text : request.settings.texts("side")) {
    for (const char* side : {"left=", "right=", "front=", "back="})
      if (text.starts_with(side))
        throw InputError("`side` " + text + ": a world has a bottom and a top alone");
  }
}

/// The example as one file that needs no other: meshes that name others become .glb. Returns its
/// name, and takes from `settings` what that has settled.
std::string keepExample(const Source& source, Form form, Settings& settings, const fs::path& folder,
                        const Progress& progress) {
  const SourceKind kind = sourceKind(source);
  const std::string ending = lowerExtension(source.path());
  const std::string stem = source.path().stem().string();
  if (const auto* grid = source.inMemory<LabelGrid>()) {
    writeLabelsVdb(folder / (stem + ".vdb"), *grid, progress);
    return stem + ".vdb";
  }
  if (form == Form::Heights) {
    // With what the settings and a file beside it say of it.
    ReadOptions reading;
    readingSettings(form).apply(settings, reading);
    reading.form = form;
    Example example = readExample(source, reading, progress);
    std::get<HeightMap>(example.data).cellSizeKnown = true;
    writeHeightMap(folder / (stem + ".tif"), example.heights());
    return stem + ".tif";
  }
  if (kind == SourceKind::Mesh && ending != ".glb" && ending != ".stl" && ending != ".off") {
    MeshFileOptions options;
    if (settings.text("up") == "y") options.up = UpAxis::Y;
    if (settings.text("up") == "z") options.up = UpAxis::Z;
    settings.remove("up");
    writeMesh(folder / (stem + ".glb"), readTriangles(source, options, progress));
    return stem + ".glb";
  }
  const std::string name = stem + ending;
  if (ending == ".toml" && !source.inMemory<std::string>()) {
    writeFile(folder / name, readFile(findScene(source.name())));
  } else {
    writeFile(folder / name, readBytes(source));
  }
  return name;
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

struct World::State {
  fs::path folder;
  WorldFile file;
  std::vector<Example> examples;
  std::unique_ptr<WindowCache> cache;
  std::unique_ptr<WorldContent> content;

  void readExample(const Progress& progress);
  void begin(bool cached, const Progress& progress);
  /// The columns of a range of tiles, and those that they share with the next ones.
  PlaneBox columnsOf(const PlaneBox& tiles) const;
};

/// Reads the example that the world keeps, and what is asked of the engine.
void World::State::readExample(const Progress& progress) {
  const fs::path path = folder / "example" / file.example;
  if (contentHash(readFile(path)) != file.exampleHash)
    throw InputError(path.string() + ": is not what the world was made of; make the world anew");
  const Engine& engine = engineNamed(file.engine);
  const Source source(path);
  examples = readExamples({&source, 1}, readingOf(file.settings, engine.form()), progress);
  Request request = requestOf(engineSettings(file.settings, engine.form()));
  request.seed = file.seed;
  content = engine.form() == Form::Heights ? heightWorldContent(examples, file, request)
                                           : labelWorldContent(examples, file, request);
}

void World::State::begin(bool cached, const Progress& progress) {
  WindowCacheOptions keeping;
  if (cached) keeping.folder = folder / "cache";
  cache = std::make_unique<WindowCache>(file.id(), keeping);
  content->begin(*cache, progress);
}

PlaneBox World::State::columnsOf(const PlaneBox& tiles) const {
  PlaneBox box = columnsOfTiles(tiles, file.tile);
  box.end.x += content->shared();
  box.end.y += content->shared();
  return box;
}

World::World(std::unique_ptr<State> state) : state_(std::move(state)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

World::World(const fs::path& folder, bool cached, const Progress& progress)
    : state_(std::make_unique<State>()) {
  state_->folder = folder;
  state_->file = readWorldFile(folder);
  state_->readExample(progress);
  state_->content->readStart(folder / "example", progress);
  if (state_->content->startHash() != state_->file.startHash)
    throw InputError((folder / "example").string() +
                     ": what the world begins with is not what it was; make the world anew");
  state_->begin(cached, progress);
}

namespace {

/// The folder of a world that is being made; what was written there goes again unless it is kept.
class Draft {
 public:
  explicit Draft(const fs::path& folder) : folder_(folder), wasThere_(fs::exists(folder)) {
    std::error_code error;
    fs::create_directories(folder / "example", error);
    if (error) throw InputError(folder.string() + ": cannot be made: " + error.message());
  }
  ~Draft() {
    if (kept_) return;
    std::error_code ignored;
    fs::remove_all(folder_ / "example", ignored);
    if (!wasThere_) fs::remove(folder_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  void keep() { kept_ = true; }

 private:
  fs::path folder_;
  bool wasThere_, kept_ = false;
};

}  // namespace

World::Created World::create(const fs::path& folder, const WorldRequest& request,
                             const Progress& progress) {
  const Engine& engine =
      request.engine.empty() ? engineFor(request.example) : engineNamed(request.engine);
  checkRequest(request, engine);
  requireThere(request.example);

  auto state = std::make_unique<State>();
  state->folder = folder;
  WorldFile& file = state->file;
  file.program = EXEMPLAR_VERSION;
  file.engine = engine.name();
  file.seed = requestOf(request.settings).seed;
  const Sizes usual = *worldSizes(engine);
  file.tile = request.tile.value_or(usual.tile);
  file.window = request.window.value_or(usual.window);
  file.height = request.height.value_or(0);
  file.settings = request.settings;
  file.settings.remove("seed");

  Created created;
  const bool there = fs::exists(worldFilePath(folder));
  if (there) {
    // The same request gives the same world.
    const WorldFile was = readWorldFile(folder);
    file.example = was.example;
    file.exampleHash = was.exampleHash;
    file.startHash = was.startHash;
    if (!request.height) file.height = was.height;
    if (file.settings.has("up") && !was.settings.has("up")) file.settings.remove("up");
    if (file.id() != was.id() || request.example.path().stem() != fs::path(was.example).stem())
      throw InputError(folder.string() +
                       ": holds another world already; choose another folder, or delete it");
    created.world.emplace(folder, false, progress);
    created.wasThere = true;
    return created;
  }
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error))
    throw InputError(folder.string() + ": is not empty, and holds no world; choose another folder");
  Draft draft(folder);
  file.example = keepExample(request.example, engine.form(), file.settings, folder / "example",
                             progress.part(0, 0.02));
  file.exampleHash = contentHash(readFile(folder / "example" / file.example));
  state->readExample(progress.part(0.02, 0.1));
  created.warnings = state->examples.front().warnings;

  WorldContent::Start start = state->content->makeStart(folder / "example", request.example.name(),
                                                        progress.part(0.1, 0.6));
  created.outcome = start.outcome;
  created.why = std::move(start.why);
  if (created.outcome != Outcome::Complete) return created;
  created.notes = std::move(start.notes);
  created.warnings.insert(created.warnings.end(), start.warnings.begin(), start.warnings.end());

  file.startHash = state->content->startHash();
  file.fingerprint = machineFingerprint();
  state->begin(false, progress.part(0.6, 0.7));
  World world(std::move(state));
  auto began = std::chrono::steady_clock::now();
  world.state_->file.canary = hashOf(world.tile({0, 0}, progress.part(0.7, 0.9)));
  created.costs.coldSeconds = secondsSince(began);
  // One whose last windows are new; smaller tiles share them.
  const int window = world.file().window, side = world.file().tile;
  began = std::chrono::steady_clock::now();
  world.tile({1 + (window - 1) / side, 0}, progress.part(0.9, 1));
  const double share = std::min(1.0, static_cast<double>(side) / window);
  created.costs.warmSeconds = share * share * secondsSince(began);
  writeWorldFile(folder, world.file());
  draft.keep();
  created.world.emplace(std::move(world));
  return created;
}

Result World::tile(const PlanePoint& tile, const Progress& progress) const {
  return tiles({tile, {tile.x + 1, tile.y + 1}}, progress);
}

Result World::tiles(const PlaneBox& tiles, const Progress& progress) const {
  return around(tiles, 0, progress);
}

Result World::around(const PlaneBox& tiles, int columns, const Progress& progress) const {
  for (int axis = 0; axis < 2; ++axis) {
    if (tiles.begin[axis] < -kMostTiles || tiles.end[axis] > kMostTiles)
      parseTileRange(tileRangeText(tiles));  // says which there are
  }
  PlaneBox box = state_->columnsOf(tiles);
  for (int axis = 0; axis < 2; ++axis) {
    box.begin[axis] -= columns;
    box.end[axis] += columns;
  }
  Result result = state_->content->region(box, progress);
  if (result.form() == Form::Labels && columns > 0) {
    auto& grid = std::get<LabelGrid>(result.data);
    for (int axis = 0; axis < 2; ++axis) grid.origin[axis] -= columns * grid.cellSize[axis];
  }
  return result;
}

Result World::tileOf(const Result& result, const PlaneBox& tiles, const PlanePoint& tile) const {
  return state_->content->partOf(result, state_->columnsOf(tiles),
                                 state_->columnsOf({tile, {tile.x + 1, tile.y + 1}}));
}

std::uint64_t World::hashOf(const Result& result) {
  return result.form() == Form::Heights ? contentHashOf(result.heights().heights)
                                        : contentHashOf(result.labels());
}

int World::shared() const { return state_->content->shared(); }

void World::requireSameBytes(const Progress& progress) const {
  const std::string fingerprint = machineFingerprint();
  if (fingerprint == state_->file.fingerprint) return;
  const fs::path known = state_->folder / "verified" / hashText(contentHash(fingerprint));
  const std::string right = hashText(state_->file.canary);
  std::error_code error;
  if (fs::exists(known, error) && readFile(known) == right) return;
  if (hashOf(tile({0, 0}, progress)) != state_->file.canary)
    throw InputError(state_->folder.string() + ": this machine (" + fingerprint +
                     ") makes other tiles than the world's maker (" + state_->file.fingerprint +
                     "); they would not fit; use the same program on the same kind of machine");
  fs::create_directories(known.parent_path(), error);
  writeFile(known, right);
}

const WorldFile& World::file() const { return state_->file; }
const fs::path& World::folder() const { return state_->folder; }
std::span<const Example> World::examples() const { return state_->examples; }

Vec3d World::tileSize() const {
  const Example& example = state_->examples.front();
  const double side = state_->file.tile;
  if (example.form() == Form::Heights) return Vec3d{side, side, 0} * example.heights().cellSize;
  const Vec3d& cell = example.labels().cellSize;
  return {side * cell.x, side * cell.y, state_->file.height * cell.z};
}

fs::path World::tilePath(const PlanePoint& tile, const std::string& ending) const {
  return state_->folder / "tiles" / "0" / std::to_string(tile.x) /
         (std::to_string(tile.y) + ending);
}

}  // namespace exemplar
