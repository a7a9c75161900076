// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <set>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "engine/model_request.h"
#include "engine/words.h"
#include "mesh/mesh_file.h"
#include "mesh/scene.h"
#include "synth/model/label_world.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStartFile = "start.vdb";

/// What an engine needs of the settings that speak of reading the example.
ReadOptions readingOf(const Settings& settings, Form form) {
  ReadOptions reading;
  reading.form = form;
  readingSettings(form).apply(settings, reading);
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

/// Refuses what no world can meet, before anything is read.
void checkRequest(const WorldRequest& request, const Engine& engine) {
  if (engine.name() != "model")
    throw InputError("the engine " + std::string(engine.name()) +
                     " makes no worlds; only model does, of labels and scenes of pieces");
  if (request.tile < 8 || request.tile > 1024)
    throw InputError("`tile` " + std::to_string(request.tile) + ": expected 8 to 1024 columns");
  if (request.window < 12 || request.window > 512)
    throw InputError("`window` " + std::to_string(request.window) + ": expected 12 to 512 columns");
  if (request.height && (*request.height < 1 || *request.height > 1024))
    throw InputError("`height` " + std::to_string(*request.height) + ": expected 1 to 1024 cells");
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
std::string keepExample(const Source& source, Settings& settings, const fs::path& folder,
                        const Progress& progress) {
  const SourceKind kind = sourceKind(source);
  const std::string ending = lowerExtension(source.path());
  const std::string stem = source.path().stem().string();
  if (const auto* grid = source.inMemory<LabelGrid>()) {
    writeLabelsVdb(folder / (stem + ".vdb"), *grid, progress);
    return stem + ".vdb";
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

std::uint64_t hashOfLabels(const LabelGrid& grid) {
  const Vec3i n = grid.size();
  std::string bytes;
  bytes.reserve(grid.cells.count() * sizeof(Label) + sizeof n);
  bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  bytes.append(reinterpret_cast<const char*>(grid.cells.values().data()),
               grid.cells.count() * sizeof(Label));
  return contentHash(bytes);
}

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

struct World::State {
  fs::path folder;
  WorldFile file;
  std::vector<Example> examples;
  std::vector<LabelGrid> grids;
  Adjacency adjacency;
  ModelOptions options;
  std::unique_ptr<WindowCache> cache;
  std::unique_ptr<LabelWorld> labels;

  void readExample(const Progress& progress);
  void begin(LabelGrid start, bool cached);
  Result resultOf(LabelGrid grid) const;
};

/// Reads the example that the world keeps, and what is asked of the engine.
void World::State::readExample(const Progress& progress) {
  const fs::path path = folder / "example" / file.example;
  if (contentHash(readFile(path)) != file.exampleHash)
    throw InputError(path.string() + ": is not what the world was made of; make the world anew");
  const Engine& engine = engineNamed(file.engine);
  const Source source(path);
  examples = readExamples({&source, 1}, readingOf(file.settings, engine.form()), progress);
  ModelSettings settings;
  Request request;
  request.settings = engineSettings(file.settings, engine.form());
  request.seed = file.seed;
  request = requestOf(request.settings);
  request.seed = file.seed;
  if (file.height == 0) file.height = cellsOfExample(examples.front()).z;
  request.extent.size = Vec3i{file.window, file.window, file.height};
  engine.check(request, 1);
  modelSettings().apply(request.settings, settings);
  options = modelOptions(request, settings, examples.front());
  requireLocal(options);
  adjacency = adjacencyOf(examples, adjacencyOptions(settings));
  grids = modelGrids(examples);
}

void World::State::begin(LabelGrid start, bool cached) {
  WindowCacheOptions keeping;
  if (cached) keeping.folder = folder / "cache";
  cache = std::make_unique<WindowCache>(file.id(), keeping);
  labels = std::make_unique<LabelWorld>(grids, adjacency, options, std::move(start),
                                        WindowLattice{.pitch = file.window}, *cache);
}

Result World::State::resultOf(LabelGrid grid) const {
  Result result;
  result.engine = file.engine;
  result.seed = file.seed;
  result.data = std::move(grid);
  return result;
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
  const fs::path path = folder / "example" / kStartFile;
  LabelGrid start = readLabelsVdb(path, progress);
  if (hashOfLabels(start) != state_->file.startHash || start.size().z != state_->file.height)
    throw InputError(path.string() + ": is not what the world begins with; make the world anew");
  state_->begin(std::move(start), cached);
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
  file.tile = request.tile;
  file.window = request.window;
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
  file.example =
      keepExample(request.example, file.settings, folder / "example", progress.part(0, 0.02));
  file.exampleHash = contentHash(readFile(folder / "example" / file.example));
  state->readExample(progress.part(0.02, 0.1));
  created.warnings = state->examples.front().warnings;

  ModelResult start =
      labelWorldStart(state->grids, state->adjacency, state->options, progress.part(0.1, 0.7));
  if (start.outcome != Outcome::Complete) {
    created.outcome = start.outcome;
    const std::string name = request.example.name();
    created.why = start.outcome == Outcome::Impossible
                      ? "no part of " + name +
                            " repeats over the plane, so that a world has nothing to begin with (" +
                            start.conflict.text + "); give synth a `size` instead"
                      : "no part of " + name +
                            " was found within the budget that repeats over the plane; try another "
                            "`seed` or a larger `budget`, or give synth a `size`";
    return created;
  }
  created.shareDifference = shareDifference(start.grid(), state->grids);
  std::set<Label> shown(start.grid().cells.values().begin(), start.grid().cells.values().end());
  std::set<Label> all;
  for (const LabelGrid& grid : state->grids)
    all.insert(grid.cells.values().begin(), grid.cells.values().end());
  created.labelsShown = static_cast<double>(shown.size()) / static_cast<double>(all.size());

  writeLabelsVdb(folder / "example" / kStartFile, start.grid());
  file.startHash = hashOfLabels(start.grid());
  file.fingerprint = machineFingerprint();
  state->begin(std::move(start.frames.front()), false);
  World world(std::move(state));
  auto began = std::chrono::steady_clock::now();
  world.state_->file.canary = hashOf(world.tile({0, 0}, progress.part(0.7, 0.9)));
  created.costs.coldSeconds = secondsSince(began);
  began = std::chrono::steady_clock::now();
  world.tile({1, 0}, progress.part(0.9, 1));
  created.costs.warmSeconds = secondsSince(began);
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
  PlaneBox box = columnsOfTiles(tiles, state_->file.tile);
  for (int axis = 0; axis < 2; ++axis) {
    box.begin[axis] -= columns;
    box.end[axis] += columns;
  }
  LabelGrid grid = state_->labels->region(box, progress);
  for (int axis = 0; axis < 2; ++axis) grid.origin[axis] -= columns * grid.cellSize[axis];
  return state_->resultOf(std::move(grid));
}

Result World::tileOf(const Result& result, const PlaneBox& tiles, const PlanePoint& tile) const {
  const LabelGrid& whole = result.labels();
  const int side = state_->file.tile;
  LabelGrid grid;
  grid.labels = whole.labels;
  grid.cellSize = whole.cellSize;
  grid.origin = whole.origin;
  grid.name = whole.name;
  grid.cells = Array3D<Label>({side, side, whole.size().z}, 0);
  const Vec3i from{static_cast<int>((tile.x - tiles.begin.x) * side),
                   static_cast<int>((tile.y - tiles.begin.y) * side), 0};
  forEachCell(grid.size(), [&](const Vec3i& p) { grid.cells[p] = whole.cells[from + p]; });
  return state_->resultOf(std::move(grid));
}

std::uint64_t World::hashOf(const Result& result) { return hashOfLabels(result.labels()); }

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

fs::path World::tilePath(const PlanePoint& tile, const std::string& ending) const {
  return state_->folder / "tiles" / "0" / std::to_string(tile.x) /
         (std::to_string(tile.y) + ending);
}

}  // namespace exemplar
