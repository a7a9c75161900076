// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/terrain_comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "core/memory.h"
#include "engine/compared_seeds.h"
#include "engine/json.h"
#include "engine/measured.h"
#include "engine/page.h"
#include "engine/words.h"
#include "maps/height_map_file.h"
#include "maps/map.h"
#include "measure/figures.h"
#include "measure/terrain_diversity.h"
#include "mesh/image.h"
#include "preview/relief.h"
#include "sdf/height_map.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// Streams of pictures are where so many cells drain through.
constexpr std::uint32_t kStreams = 200;
/// How many seeds of an engine a picture shows side by side.
constexpr std::size_t kShownSeeds = 3;

/// What an engine made of the example with one seed.
struct Run {
  ComparedTerrain said;
  HeightMap heights;
  std::optional<std::uint64_t> peakBytes;
};

/// A picture of heights, 0 at the lowest; without holes, in which nothing can be painted.
Example asPicture(const Example& heights) {
  Grid<float> plane = heights.heights().heights;
  fillHoles(plane);
  const HeightRange range = *rangeOf(plane);
  const float span = range.relief() > 0 ? static_cast<float>(range.relief()) : 1;
  for (float& h : plane.values()) h = (h - static_cast<float>(range.low)) / span;
  Example example;
  example.source = heights.source;
  example.reading = heights.reading;
  example.kind = SourceKind::Picture;
  example.description = heights.description;
  MapLayer layer{"height", {}, 16};
  layer.planes.push_back(std::move(plane));
  example.data = Map{{std::move(layer)}};
  return example;
}

HeightMap heightsOf(const Map& map, const HeightMap& like) {
  HeightMap made = like;
  made.heights = map.layers.front().planes.front();
  made.corner.reset();
  const HeightRange range = *rangeOf(like.heights);
  for (float& h : made.heights.values())
    h = static_cast<float>(range.low) + h * static_cast<float>(range.relief());
  return made;
}

class Comparison {
 public:
  Comparison(const Source& source, const ReadOptions& reading, const ComparisonOptions& options,
             const Progress& progress)
      : source_(source), reading_(reading), options_(options) {
    reading_.form = Form::Heights;
    example_ = readExample(source, reading_, progress);
    const Vec3d scale = options.scale.value_or(Vec3d{2, 2, 1});
    scale_ = {scale.x, scale.y, 1};
  }

  const Example& example() const { return example_; }
  const Vec3d& scale() const { return scale_; }

  Run run(const ComparedEngine& compared, std::uint64_t seed, const Progress& progress) {
    Run run;
    run.said.engine = compared.name;
    run.said.seed = seed;
    const bool peak = resetPeakResident();
    try {
      const Example given = exampleFor(compared, progress.part(0, 0.1));
      Request request;
      request.seed = seed;
      request.extent.scale = scale_;
      request.settings = compared.settings;
      if (given.form() == Form::Map) request.settings.set("kind", "heights");
      const auto began = std::chrono::steady_clock::now();
      const Result result = compared.engine->run({&given, 1}, request, progress.part(0.1, 0.7));
      run.said.seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      if (result.outcome == Outcome::Cancelled) throw Cancelled();
      run.said.status = outcomeName(result.outcome);
      if (result.outcome != Outcome::Complete) {
        run.said.why = result.conflict ? result.conflict->text : result.why;
        return run;
      }
      if (peak) run.peakBytes = peakResidentBytes();
      measureRun(result, given, run, progress.part(0.7, 1));
    } catch (const InputError& error) {
      run.said.status = "refused";
      run.said.why = error.what();
    }
    return run;
  }

 private:
  Example exampleFor(const ComparedEngine& compared, const Progress& progress) const {
    switch (compared.engine->form()) {
      case Form::Heights:
        return example_;
      case Form::Map:
        return asPicture(example_);
      case Form::Field: {
        ReadOptions reading = reading_;
        reading.form = Form::Field;
        return readExample(source_, reading, progress);
      }
      default:
        throw InputError("makes no heights; compare terrain, layered, geometry or blocks");
    }
  }

  void measureRun(const Result& result, const Example& given, Run& run,
                  const Progress& progress) const {
    if (result.form() == Form::Map) {
      const HeightMap& wanted = example_.heights();
      run.heights = heightsOf(result.map(), wanted);
      run.said.likeness = measureTerrain(
          wanted.heights, run.heights.heights,
          {.cellSize = wanted.cellSize, .meters = wanted.cellSizeKnown}, nullptr, progress);
      return;
    }
    run.heights = result.form() == Form::Heights
                      ? result.heights()
                      : sdfToHeightMap(result.field(), progress.part(0, 0.1));
    run.said.likeness = *measureTerrain(result, {&given, 1}, progress.part(0.1, 1));
  }

  Source source_;
  ReadOptions reading_;
  const ComparisonOptions& options_;
  Example example_;
  Vec3d scale_;
};

std::string fileName(std::string engine) {
  std::ranges::replace_if(
      engine, [](char c) { return c == ':' || c == '=' || c == ',' || c == '/'; }, '-');
  return engine;
}

/// Maps side by side at one scale, with their streams, in two lights.
Image8 relief(std::span<const HeightMap* const> maps, const RenderOptions& picture,
              const Progress& progress) {
  std::vector<ReliefMap> shown;
  for (const HeightMap* map : maps) shown.push_back({&map->heights, map->cellSize});
  ReliefOptions options{.azimuths = {1.75 * std::numbers::pi, 0.25 * std::numbers::pi}};
  options.streamCells = kStreams;
  options.longest = std::max(picture.width, picture.height);
  return renderRelief(shown, options, progress);
}

/// An engine's results of several seeds.
struct Seeds {
  std::string engine;
  std::vector<std::uint64_t> seeds;
  std::vector<TerrainLayout> layouts;
  std::vector<HeightMap> shown;  // the first ones

  void add(Run&& run) {
    seeds.push_back(run.said.seed);
    layouts.emplace_back(run.heights.heights);
    if (shown.size() < kShownSeeds) shown.push_back(std::move(run.heights));
  }
  ComparedSeeds compared(const Progress& progress) const {
    return comparedSeeds(engine, seeds, [&](std::size_t a, std::size_t b) {
      const TerrainDistance distance = distanceBetween(layouts[a], layouts[b], progress);
      return SeedDistance{distance.plain, distance.moved};
    });
  }
};

/// The example beside one map of each.
std::vector<const HeightMap*> besideExample(const HeightMap& example,
                                            std::span<const HeightMap> maps) {
  std::vector<const HeightMap*> all{&example};
  for (const HeightMap& map : maps) all.push_back(&map);
  return all;
}

/// Writes a picture into the folder.
using WritePicture = std::function<void(const std::string& name, const Image8& image)>;

/// Says how far the seeds of each engine are apart and draws them. Returns each engine's first
/// result.
std::vector<HeightMap> finishSeeds(std::vector<Seeds>& made, const HeightMap& example,
                                   const ComparisonOptions& options, Json& report,
                                   const WritePicture& write, const Progress& progress) {
  std::vector<HeightMap> firsts;
  for (Seeds& seeds : made) {
    if (seeds.seeds.size() > 1) {
      const ComparedSeeds compared = seeds.compared(progress.part(0, 0));
      addSeeds(compared, "their layout", report);
      if (options.compared) options.compared(compared);
      write(fileName(seeds.engine) + "-seeds.png",
            relief(besideExample(example, seeds.shown), options.picture, progress.part(0, 1)));
    }
    if (!seeds.shown.empty()) firsts.push_back(std::move(seeds.shown.front()));
  }
  return firsts;
}

/// What the report says before any run: the example, what figures mean, how to read them.
Json headOf(const Comparison& comparison, const ComparisonOptions& options) {
  const Example& example = comparison.example();
  const HeightMap& heights = example.heights();
  Json report = pageHead("comparison", example.name(), example.description, options.picture);
  report["example"]["samples"] = {heights.width(), heights.height(), 1};
  report["voxel_size"] = heights.cellSize;
  report["scale"] = toJson(comparison.scale());
  report["notes"] = {
      "Measured as terrain, by heights alone; pictures show the example beside the result at one "
      "scale, lit from the northwest and the northeast, with the streams that 200 cells drain "
      "into.",
      "terrain works on the heights, layered on a picture of them.",
      "Engines on distances work on a volume of the example and are measured at its resolution, "
      "against the example at that resolution (`resolution`).",
      "seconds are of synthesis alone, on all cores in use."};
  report["figures"] = Json::array();
  for (const Figure& figure : figures(TerrainLikeness{})) {
    report["figures"].push_back(
        {{"group", figure.group}, {"key", figure.key}, {"meaning", figure.meaning}});
  }
  return report;
}

}  // namespace

void compareTerrain(const Source& source, const ReadOptions& reading,
                    const ComparisonOptions& options,
                    const std::function<void(const ComparedTerrain&)>& finished,
                    const Progress& progress) {
  const fs::path& folder = options.folder;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw InputError(folder.string() + ": cannot be made a folder; name one that can");
  Comparison comparison(source, reading, options, progress.part(0, 0.02));
  const HeightMap& example = comparison.example().heights();
  for (const std::string& warning : comparison.example().warnings)
    warn(options.picture.warnings, warning);
  const auto wrote = [&](const std::string& name) {
    if (options.wrote) options.wrote(folder / name);
  };
  const auto write = [&](const std::string& name, const Image8& image) {
    writePng(folder / name, image);
    wrote(name);
  };
  const HeightMap* alone[] = {&example};
  const Image8 ofExample = relief(alone, options.picture, progress.part(0.02, 0.04));
  write("example.png", ofExample);

  ReportPage page;
  page.addPicture("example", ofExample);
  Json report = headOf(comparison, options);
  std::vector<Seeds> made;
  for (const ComparedEngine& compared : options.engines)
    made.push_back({compared.name, {}, {}, {}});
  const std::size_t runs = options.engines.size() * static_cast<std::size_t>(options.seeds);
  std::size_t done = 0;
  for (int s = 0; s < options.seeds; ++s) {
    for (std::size_t e = 0; e < options.engines.size(); ++e) {
      const ComparedEngine& compared = options.engines[e];
      const std::uint64_t seed = options.firstSeed + static_cast<std::uint64_t>(s);
      const double from = 0.05 + 0.9 * static_cast<double>(done++) / static_cast<double>(runs);
      const Progress part = progress.part(from, from + 0.9 / static_cast<double>(runs));
      Run run = comparison.run(compared, seed, part.part(0, 0.9));
      Json json{{"engine", compared.name}, {"seed", seed}, {"status", run.said.status}};
      if (run.said.status == "complete") {
        const std::string name = fileName(compared.name) + "-" + std::to_string(seed);
        json["seconds"] = run.said.seconds;
        if (run.peakBytes) json["peak_memory_bytes"] = *run.peakBytes;
        json["figures"] = toJson(figures(run.said.likeness));
        json["picture"] = name;
        json["heights"] = name + ".tif";
        json["cell_size"] = run.heights.cellSize;
        const HeightMap* both[] = {&example, &run.heights};
        const Image8 image = relief(both, options.picture, part.part(0.9, 1));
        write(name + ".png", image);
        writeHeightMap(folder / (name + ".tif"), run.heights, {}, {});
        wrote(name + ".tif");
        if (page.bytes() < kReportBytes / 2) page.addPicture(name, image);
        if (finished) finished(run.said);
        made[e].add(std::move(run));
      } else {
        json["why"] = run.said.why;
        if (finished) finished(run.said);
      }
      report["runs"].push_back(std::move(json));
    }
  }
  const std::vector<HeightMap> firsts =
      finishSeeds(made, example, options, report, write, progress.part(0.95, 0.96));
  if (!firsts.empty()) {
    const Image8 image =
        relief(besideExample(example, firsts), options.picture, progress.part(0.96, 0.98));
    write("compare.png", image);
  }
  progress.report("writing the report", 0.98);
  writeFile(folder / "compare.json", jsonText(report, 2) + "\n");
  writeFile(folder / "report.html", page.html(report));
}

}  // namespace exemplar
