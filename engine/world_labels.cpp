// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Worlds of labels, by model synthesis.

#include <cstdio>
#include <optional>
#include <set>

#include "core/cells.h"
#include "core/error.h"
#include "core/hash.h"
#include "engine/model_request.h"
#include "engine/words.h"
#include "engine/world_content.h"
#include "synth/model/label_world.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

constexpr const char* kStartFile = "start.vdb";

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

class LabelWorldContent final : public WorldContent {
 public:
  LabelWorldContent(std::span<const Example> examples, WorldFile& file, const Request& request)
      : engine_(file.engine), seed_(file.seed), pitch_(file.window) {
    ModelSettings settings;
    if (file.height == 0) file.height = cellsOfExample(examples.front()).z;
    height_ = file.height;
    Request own = request;
    own.extent.size = Vec3i{file.window, file.window, file.height};
    engineNamed(file.engine).check(own, examples.size());
    modelSettings().apply(own.settings, settings);
    options_ = modelOptions(own, settings, examples.front());
    requireLocal(options_);
    adjacency_ = adjacencyOf(examples, adjacencyOptions(settings));
    grids_ = modelGrids(examples);
  }

  Start makeStart(const std::filesystem::path& folder, const std::string& name,
                  const Progress& progress) override {
    Start made;
    ModelResult start = labelWorldStart(grids_, adjacency_, options_, progress);
    made.outcome = start.outcome;
    if (start.outcome == Outcome::Impossible) {
      made.why = "no part of " + name +
                 " repeats over the plane, so that a world has nothing to begin with (" +
                 start.conflict.text + "); give synth a `size` instead";
    } else if (start.outcome != Outcome::Complete) {
      made.why = "no part of " + name +
                 " was found within the budget that repeats over the plane; try another "
                 "`seed` or a larger `budget`, or give synth a `size`";
    }
    if (!made.why.empty()) return made;
    describe(start.grid(), made);
    writeLabelsVdb(folder / kStartFile, start.grid());
    start_ = std::move(start.frames.front());
    return made;
  }

  void readStart(const std::filesystem::path& folder, const Progress& progress) override {
    start_ = readLabelsVdb(folder / kStartFile, progress);
    if (start_.size().z != height_)
      throw InputError((folder / kStartFile).string() +
                       ": is not what the world begins with; make the world anew");
  }

  std::uint64_t startHash() const override { return contentHashOf(start_); }

  void begin(WindowCache& cache, const Progress&) override {
    world_ = std::make_unique<LabelWorld>(grids_, adjacency_, options_, start_,
                                          WindowLattice{.pitch = pitch_}, cache);
  }

  Result region(const PlaneBox& box, const Progress& progress) const override {
    return resultOf(world_->region(box, progress));
  }

  Result partOf(const Result& region, const PlaneBox& box, const PlaneBox& part) const override {
    const LabelGrid& whole = region.labels();
    LabelGrid grid;
    grid.labels = whole.labels;
    grid.cellSize = whole.cellSize;
    grid.origin = whole.origin;
    grid.name = whole.name;
    grid.cells = Array3D<Label>(
        {static_cast<int>(part.size(0)), static_cast<int>(part.size(1)), whole.size().z}, 0);
    const Vec3i from{static_cast<int>(part.begin.x - box.begin.x),
                     static_cast<int>(part.begin.y - box.begin.y), 0};
    forEachCell(grid.size(), [&](const Vec3i& p) { grid.cells[p] = whole.cells[from + p]; });
    return resultOf(std::move(grid));
  }

 private:
  /// How much of the examples a start shows.
  void describe(const LabelGrid& start, Start& made) const {
    const std::set<Label> shown(start.cells.values().begin(), start.cells.values().end());
    std::set<Label> all;
    for (const LabelGrid& grid : grids_)
      all.insert(grid.cells.values().begin(), grid.cells.values().end());
    const double share = static_cast<double>(shown.size()) / static_cast<double>(all.size());
    made.notes.emplace_back("start",
                            percent(share) +
                                " of the example's labels; shares of labels differ from the "
                                "example's by " +
                                percent(shareDifference(start, grids_)));
    if (share < 0.9)
      made.warnings.push_back("this world shows " + percent(share) +
                              " of the example's labels; the others only fit beside the example's "
                              "sides");
  }

  Result resultOf(LabelGrid grid) const {
    Result result;
    result.engine = engine_;
    result.seed = seed_;
    result.data = std::move(grid);
    return result;
  }

  std::string engine_;
  std::uint64_t seed_;
  int pitch_, height_ = 0;
  std::vector<LabelGrid> grids_;
  Adjacency adjacency_;
  ModelOptions options_;
  LabelGrid start_;
  std::unique_ptr<LabelWorld> world_;
};

}  // namespace

std::unique_ptr<WorldContent> labelWorldContent(std::span<const Example> examples, WorldFile& file,
                                                const Request& request) {
  return std::make_unique<LabelWorldContent>(examples, file, request);
}

std::uint64_t contentHashOf(const LabelGrid& grid) {
  const Vec3i n = grid.size();
  std::string bytes;
  bytes.reserve(grid.cells.count() * sizeof(Label) + sizeof n);
  bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  bytes.append(reinterpret_cast<const char*>(grid.cells.values().data()),
               grid.cells.count() * sizeof(Label));
  return contentHash(bytes);
}

}  // namespace exemplar
