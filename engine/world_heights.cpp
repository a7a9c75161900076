// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Worlds of heights, by terrain synthesis.

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/hash.h"
#include "engine/terrain_control.h"
#include "engine/world_content.h"
#include "maps/height_map_file.h"
#include "synth/terrain/height_world.h"

namespace exemplar {
namespace {

constexpr const char* kStartFile = "start.tif";

/// Integers for heights of a world, the same for all its tiles: the example's where those hold all
/// that it can be, else steps of a power of two.
HeightSteps stepsFor(const std::optional<HeightSteps>& own, const HeightRange& range) {
  if (own && own->largest == 65535 && own->offset <= range.low &&
      own->offset + 65535 * own->size >= range.high)
    return *own;
  HeightSteps steps;
  steps.size = std::exp2(std::ceil(std::log2(std::max(range.relief(), 1e-30) / 65533)));
  steps.offset = std::floor(range.low / steps.size) * steps.size;
  return steps;
}

class HeightWorldContent final : public WorldContent {
 public:
  HeightWorldContent(std::span<const Example> examples, WorldFile& file, const Request& request)
      : engine_(file.engine), seed_(file.seed), lattice_(heightLattice(file.window)) {
    file.height = 1;
    options_ = localTerrainOptions(request);
    Request own = request;
    own.extent.size = Vec3i{file.window, file.window, 1};
    engineNamed(file.engine).check(own, examples.size());
    example_ = examples.front().heights();
    for (const Example& example : examples) heights_.push_back(example.heights().heights);
    example_.heights = {};
    example_.corner.reset();
  }

  Start makeStart(const std::filesystem::path& folder, const std::string&,
                  const Progress& progress) override {
    HeightMap start{
        heightWorldStart(heights_, options_, lattice_, progress), example_.cellSize, true, {}, {}};
    writeHeightMap(folder / kStartFile, start);
    start_ = std::move(start.heights);
    Start made;
    made.notes.emplace_back("water", "runs to one point in every " +
                                         std::to_string(start_.width()) + " x " +
                                         std::to_string(start_.height()));
    return made;
  }

  void readStart(const std::filesystem::path& folder, const Progress& progress) override {
    start_ = readHeightMap(folder / kStartFile, {}, progress).heights;
    if (start_.width() != start_.height() ||
        std::ranges::any_of(start_.values(), [](float h) { return std::isnan(h); }))
      throw InputError((folder / kStartFile).string() +
                       ": is not what the world begins with; make the world anew");
  }

  std::uint64_t startHash() const override { return contentHashOf(start_); }

  void begin(WindowCache& cache, const Progress& progress) override {
    example_.steps = stepsFor(example_.steps, heightWorldRange(heights_, start_));
    world_ = std::make_unique<HeightWorld>(heights_, options_, start_, lattice_, cache, progress);
  }

  int shared() const override { return 1; }

  Result region(const PlaneBox& box, const Progress& progress) const override {
    HeightWorld::Region made = world_->region(box, progress);
    return resultOf(box.begin, std::move(made.heights), std::move(made.origins));
  }

  Result partOf(const Result& region, const PlaneBox& box, const PlaneBox& part) const override {
    const int width = static_cast<int>(part.size(0)), height = static_cast<int>(part.size(1));
    const int left = static_cast<int>(part.begin.x - box.begin.x);
    const int top = static_cast<int>(box.end.y - part.end.y);
    Grid<float> heights(width, height);
    Grid<HeightOrigin> origins(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        heights(x, y) = region.heights().heights(left + x, top + y);
        origins(x, y) = region.heightOrigins(left + x, top + y);
      }
    }
    return resultOf(part.begin, std::move(heights), std::move(origins));
  }

 private:
  Result resultOf(const PlanePoint& southwest, Grid<float> heights,
                  Grid<HeightOrigin> origins) const {
    Result result;
    result.engine = engine_;
    result.seed = seed_;
    HeightMap map = example_;
    map.heights = std::move(heights);
    map.corner = MapCorner{static_cast<double>(southwest.x) * map.cellSize,
                           static_cast<double>(southwest.y) * map.cellSize};
    result.data = std::move(map);
    result.heightOrigins = std::move(origins);
    return result;
  }

  std::string engine_;
  std::uint64_t seed_;
  WindowLattice lattice_;
  HeightMap example_;  // all but its heights
  std::vector<Grid<float>> heights_;
  TerrainSynthesisOptions options_;
  Grid<float> start_;
  std::unique_ptr<HeightWorld> world_;
};

}  // namespace

std::unique_ptr<WorldContent> heightWorldContent(std::span<const Example> examples, WorldFile& file,
                                                 const Request& request) {
  return std::make_unique<HeightWorldContent>(examples, file, request);
}

std::uint64_t contentHashOf(const Grid<float>& heights) {
  const int size[2] = {heights.width(), heights.height()};
  std::string bytes;
  bytes.reserve(heights.count() * sizeof(float) + sizeof size);
  bytes.append(reinterpret_cast<const char*>(size), sizeof size);
  bytes.append(reinterpret_cast<const char*>(heights.values().data()),
               heights.count() * sizeof(float));
  return contentHash(bytes);
}

}  // namespace exemplar
