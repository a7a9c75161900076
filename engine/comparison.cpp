// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/comparison.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "core/memory.h"
#include "engine/compared_seeds.h"
#include "engine/engines.h"
#include "engine/json.h"
#include "engine/measured.h"
#include "engine/page.h"
#include "engine/realize.h"
#include "engine/words.h"
#include "measure/mesh_result.h"
#include "measure/novelty.h"
#include "measure/rolled_distance.h"
#include "mesh/footprint.h"
#include "mesh/image.h"
#include "sdf/vdb_file.h"
#include "voxelize/violations.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// What is kept of a run beside its figures; another number where that changes.
constexpr int kParts = 4;

/// What one engine made of the example with one seed.
struct Run {
  std::string status, why;
  DistanceField field;
  Origins origins;                         ///< none of pieces
  TriangleMesh mesh;                       ///< straight, as the field is
  double seconds = 0;                      ///< of synthesis alone
  std::optional<std::uint64_t> peakBytes;  ///< resident while it ran, surface included
  std::optional<std::int64_t> labels;      ///< kinds of blocks or pieces
  /// Pairs of neighbors and those of them that the example does not show: of pieces on their grid;
  /// else with the example cut into blocks that tile, and the result read in these, of which it
  /// says the share that the example has not.
  std::optional<std::int64_t> pairs, violations;
  std::optional<double> unknownBlocks;
  std::optional<Content> content;  ///< of pieces
};

double secondsSince(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// The example as the engine works on it.
Example exampleFor(const ComparedEngine& compared, const Example& example,
                   const Progress& progress) {
  if (compared.engine->form() == Form::Field) return example;
  ReadOptions reading = example.reading;
  if (compared.engine->form() == Form::Polygons) {
    reading.form = Form::Polygons;
    readingSettings(Form::Polygons).apply(compared.settings, reading);
    return readExample(example.source, reading, progress);
  }
  reading.form = Form::Labels;
  readingSettings(Form::Labels).apply(compared.settings, reading);
  // A scene of pieces is taken by its pieces unless blocks of its field are asked for.
  const bool blocks = std::ranges::any_of(compared.settings.given(), [](const auto& given) {
    return given.first.starts_with("field-");
  });
  if (example.kind == SourceKind::Pieces && !blocks) {
    reading.resolution.reset();
    return readExample(example.source, reading, progress);
  }
  return labeled(example, reading.blocks, progress);
}

Request requestFor(const ComparedEngine& compared, const Example& example, const Example& given,
                   const Vec3d& scale, std::uint64_t seed) {
  Request request;
  request.seed = seed;
  request.extent.scale = scale;
  for (const auto& [key, text] : compared.settings.given()) {
    if (std::ranges::find(compared.engine->settings(), key, &Setting::key) !=
        compared.engine->settings().end())
      request.settings.add(key, text);
  }
  if (const auto* labeled = std::get_if<LabeledField>(&given.content)) {
    // Whole blocks, as nearly as they come to the size of a field's result.
    const Vec3i wanted = scaledSize(example.field().size(), scale, "samples");
    Vec3i cells;
    for (int axis = 0; axis < 3; ++axis) {
      const double blocks = static_cast<double>(wanted[axis]) / labeled->blocks.stride[axis];
      cells[axis] = std::max(1, static_cast<int>(std::lround(blocks)));
    }
    request.extent = {.scale = {}, .size = cells};
  }
  return request;
}

/// The field of a result of pieces: its mesh, sampled where that of geometry synthesis would be.
void samplePieces(const Result& result, const Example& example, const Example& pieces,
                  const Progress& progress, Run& run) {
  run.mesh = realizeLabels(result.labels(), pieces, progress.part(0, 0.3));
  const LabelGrid &made = result.labels(), &grid = pieces.labels();
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis)
    size[axis] = static_cast<int>(
        std::lround(made.size()[axis] * grid.cellSize[axis] / example.field().voxelSize));
  run.field = sampleMeshResult(run.mesh, example.field(), {.size = size}, progress.part(0.3, 1));
  const AdjacencyViolations violations = findViolations(made, grid);
  run.pairs = violations.pairs;
  run.violations = violations.count;
  run.content = measureContent(grid, made, progress);
}

/// The field of a result of polygons: its surface, sampled.
void samplePolygons(const Result& result, const Example& example, const Example& given,
                    const Progress& progress, Run& run) {
  run.mesh = realize(result, {&given, 1}, {}, progress.part(0, 0.3)).mesh;
  run.field = sampleMeshResult(run.mesh, example.field(), {}, progress.part(0.3, 1));
}

/// Counts the pairs of blocks that the example does not show: for every engine in the same way, by
/// the result's samples alone.
void countViolations(const DistanceField& example, const Progress& progress, Run& run) {
  try {
    const FieldBlocks blocks = cutIntoBlocks(example, {}, progress.part(0, 0.5));
    const RecognizedBlocks found =
        recognizeBlocks(run.field, example, blocks, progress.part(0.5, 1));
    const AdjacencyViolations violations = findViolations(found.grid, blocks.grid);
    run.pairs = violations.pairs;
    run.violations = violations.count;
    run.unknownBlocks =
        static_cast<double>(found.unknown) / static_cast<double>(found.grid.cells.count());
  } catch (const InputError&) {
    // Too many kinds of blocks, or a result smaller than one: nothing is counted.
  }
}

Run runEngine(const ComparedEngine& compared, const Example& example, const Vec3d& scale,
              std::uint64_t seed, const Progress& progress) {
  Run run;
  const bool peak = resetPeakResident();
  auto began = std::chrono::steady_clock::now();
  try {
    const Example given = exampleFor(compared, example, progress.part(0, 0.1));
    const bool pieces = std::holds_alternative<ModelPieces>(given.content);
    if (pieces) began = std::chrono::steady_clock::now();
    if (given.form() == Form::Labels) run.labels = given.labels().labelCount();
    const Request request = requestFor(compared, example, given, scale, seed);
    const Result result = compared.engine->run({&given, 1}, request, progress.part(0.1, 0.6));
    run.seconds = secondsSince(began);
    if (result.outcome == Outcome::Cancelled) throw Cancelled();
    run.status = outcomeName(result.outcome);
    if (result.outcome != Outcome::Complete) {
      run.why = result.conflict ? result.conflict->text : result.why;
      return run;
    }
    if (result.form() == Form::Polygons) {
      samplePolygons(result, example, given, progress.part(0.6, 0.9), run);
    } else if (pieces) {
      samplePieces(result, example, given, progress.part(0.6, 0.9), run);
    } else {
      SampledResult made = *sampled(result, given);
      run.field = std::move(made.field);
      run.origins = std::move(made.origins);
    }
  } catch (const InputError& error) {
    run.status = "refused";
    run.why = error.what();
    return run;
  }
  if (run.mesh.triangles.empty()) {
    try {
      Result whole;
      whole.data = run.field;
      whole.origins = run.origins;
      run.mesh = realize(whole, {&example, 1}, {}, progress.part(0.6, 0.9)).mesh;
      turn(run.mesh, example.turn.back());
    } catch (const InputError& error) {
      // All solid or all air.
      run.status = "empty";
      run.why = error.what();
      return run;
    }
  }
  if (peak) run.peakBytes = peakResidentBytes();
  if (!run.violations) countViolations(example.field(), progress.part(0.9, 1), run);
  return run;
}

/// "geometry-patch-9-0": the beginning of the names of a run's files.
std::string runName(std::string engine, std::uint64_t seed) {
  std::ranges::replace_if(
      engine, [](char c) { return c == ':' || c == '=' || c == ',' || c == '/'; }, '-');
  return engine + "-" + std::to_string(seed);
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    throw InputError(folder.string() + ": cannot be made a folder; name one that can");
}

/// A hash (FNV-1a) of all that a result can take from the example.
std::uint64_t hashOf(const Example& example) {
  std::uint64_t hash = 1469598103934665603u;
  const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 1099511628211u; };
  for (const float value : example.field().values.values())
    add(std::bit_cast<std::uint32_t>(value));
  if (!example.mesh) return hash;
  const TriangleMesh& mesh = *example.mesh;
  for (const Vec3d& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(p[axis]));
  for (const auto& color : mesh.colors)
    for (const float c : color) add(std::bit_cast<std::uint32_t>(c));
  for (const std::uint32_t material : mesh.triangleMaterials) add(material);
  for (const Material& material : mesh.materials) {
    for (const float c : material.baseColor) add(std::bit_cast<std::uint32_t>(c));
    for (const char c : material.name) add(static_cast<unsigned char>(c));
  }
  return hash;
}

/// What decides a run's result and its picture: a finished run with the same is not made again. The
/// example counts with its samples and materials, so that an edited file is another one.
Json requestJson(const Example& example, const ComparisonOptions& options, std::uint64_t hash,
                 const Vec3d& scale, const std::string& engine, std::uint64_t seed) {
  const RenderOptions& picture = options.picture;
  return {{"version", EXEMPLAR_VERSION},
          {"example", example.name()},
          {"samples", toJson(example.field().size())},
          {"hash", hash},
          {"scale", toJson(scale)},
          {"engine", engine},
          {"seed", seed},
          {"picture",
           {picture.width, picture.height, picture.samples, picture.view.azimuth,
            picture.view.elevation}},
          {"up", static_cast<int>(options.mesh.up)},
          {"parts", kParts}};
}

/// A run that was finished before, if it was made by the same request and its files are there.
std::optional<Json> finishedRun(const fs::path& file, const Json& request, const fs::path& folder) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    Json run = Json::parse(readFile(file));
    if (run.at("request") != request) return std::nullopt;
    const bool complete = run.at("status") == "complete";
    for (const char* key : {"engine", "seed"}) run.at(key);
    for (const char* key : {"seconds", "figures", "mesh", "picture", "field"})
      if (complete) run.at(key);
    if (!complete) run.at("why");
    for (const char* part : {"mesh", "picture", "field", "origins", "view"}) {
      if (run.contains(part) && !fs::exists(folder / run.at(part).get<std::string>()))
        return std::nullopt;
    }
    return run;
  } catch (const Json::exception&) {
    return std::nullopt;  // damaged, or of an older version
  }
}

/// Makes, measures, draws and writes one run.
Json makeRun(const Example& example, const ComparisonOptions& options,
             const ComparedEngine& compared, const Vec3d& scale, std::uint64_t seed,
             const Progress& progress) {
  const std::string name = runName(compared.name, seed);
  const RenderOptions picture = straightPicture(options.picture, example.turn);
  Run made = runEngine(compared, example, scale, seed, progress.part(0, 0.5));
  Json run{{"engine", compared.name}, {"seed", seed}, {"status", made.status}};
  if (made.labels) run["labels"] = *made.labels;
  if (made.status != "complete") {
    run["why"] = made.why;
    return run;
  }
  run["samples"] = toJson(made.field.size());
  run["seconds"] = made.seconds;
  if (made.peakBytes) run["peak_memory_bytes"] = *made.peakBytes;
  if (made.violations) {
    run["adjacency_pairs"] = *made.pairs;
    run["adjacency_violations"] = *made.violations;
    if (made.unknownBlocks) run["unknown_blocks"] = *made.unknownBlocks;
  }
  MeasureInput input;
  // Pieces are what they are: they have no samples to come from.
  const Origins* origins = made.origins.count() > 0 ? &made.origins : nullptr;
  input.origins = origins;
  input.mesh = &made.mesh;
  progress.report("measuring " + name, 0.5);
  run["figures"] =
      toJson(figures(measure(example.field(), made.field, input, {}, progress.part(0.5, 0.7))));
  if (made.content) run["figures"].update(toJson(figures(*made.content)));
  progress.report("drawing " + name, 0.7);
  const Image8 image = render(made.mesh, picture, progress.part(0.7, 0.8));
  progress.report("marking " + name, 0.8);
  const PageParts parts = pageParts(made.mesh, &example.field(), &made.field, origins, picture,
                                    kManyViews, progress.part(0.8, 1));
  run["marks"] = toJson(parts.marks);
  run["mesh"] = name + ".glb";
  run["picture"] = name + ".png";
  run["field"] = name + ".vdb";
  if (origins) run["origins"] = name + "-origins.vdb";
  const fs::path& folder = options.folder;
  turn(made.mesh, example.turn);
  writeMesh(folder / (name + ".glb"), made.mesh, options.mesh);
  writePng(folder / (name + ".png"), image);
  writeVdb(folder / (name + ".vdb"), made.field, {.turn = example.turn});
  if (origins) {
    writeOriginsVdb(folder / (name + "-origins.vdb"), made.origins, made.field,
                    {.turn = example.turn, .scale = scale});
  }
  if (!parts.view.empty()) {
    run["view"] = name + "-view.json";
    writeFile(folder / (name + "-view.json"), parts.view);
  }
  return run;
}

Image8 readPicture(const fs::path& path) { return decodeImage(readFile(path), path.string()); }

/// The page: the comparison, with views and pictures of as many runs as there is room for.
std::string comparisonPage(const Json& comparison, const fs::path& folder,
                           const std::string& exampleView, const RenderOptions& picture) {
  Json report = pageHead("comparison", comparison.at("example").get<std::string>(),
                         comparison.at("description"), picture);
  report["example"]["samples"] = comparison.at("samples");
  for (const char* key : {"voxel_size", "scale", "notes", "figures"})
    report[key] = comparison.at(key);
  ReportPage page;
  page.addPicture("example", readPicture(folder / "example.png"));
  if (!exampleView.empty()) page.addView("example", exampleView);
  int left = 0;
  // The pictures first: they are small, and show what a view cannot where there is none.
  for (Json run : comparison.at("runs")) {
    if (run.contains("picture")) {
      const std::string name = fs::path(run.at("picture").get<std::string>()).stem().string();
      if (page.bytes() < kReportBytes / 2)
        page.addPicture(name, readPicture(folder / run.at("picture").get<std::string>()));
      run["picture"] = name;
    }
    report["runs"].push_back(std::move(run));
  }
  for (Json& run : report["runs"]) {
    if (!run.contains("view")) continue;
    std::string view = readFile(folder / run.at("view").get<std::string>());
    const std::string name = run.at("picture");
    run["view"] = name;
    if (page.bytes() + view.size() <= kReportBytes) {
      page.addView(name, std::move(view));
    } else {
      ++left;
    }
  }
  if (left > 0) {
    report["notes"].push_back("To keep this page small, " + std::to_string(left) +
                              " of the results are shown as pictures, or by figures alone; their "
                              "meshes are beside this page.");
  }
  requireMemory(3.0 * static_cast<double>(page.bytes()), "report.html", "compare fewer seeds");
  return page.html(report);
}

Json comparisonHead(const Example& example, const Vec3d& scale) {
  Json head{
      {"example", example.name()},
      {"description", example.description},
      {"picture", "example.png"},
      {"samples", toJson(example.field().size())},
      {"voxel_size", example.field().voxelSize},
      {"scale", toJson(scale)},
      {"notes",
       {"Every engine ran on the same samples, with default settings except those its name states; "
        "the same code measured all results.",
        "model keeps the adjacencies of the example's blocks exactly, up to the tolerance within "
        "which blocks are one label; the other engines keep none exactly and trade mismatch off "
        "everywhere.",
        "model takes a bundled scene of pieces by its pieces, whose adjacencies are then counted; "
        "of anything else it takes blocks of samples.",
        "model's results are whole blocks, so their size may differ by less than half a block.",
        "seconds are of synthesis alone, on all cores in use."}},
      {"figures", figureMeanings()},
      {"seeds", Json::array()},
      {"runs", Json::array()}};
  return head;
}

ComparedRun readable(const Json& run, bool again) {
  ComparedRun result;
  result.engine = run.at("engine").get<std::string>();
  result.seed = run.at("seed").get<std::uint64_t>();
  result.status = run.at("status").get<std::string>();
  result.again = again;
  if (result.status != "complete") {
    result.why = run.at("why").get<std::string>();
    return result;
  }
  result.seconds = run.at("seconds").get<double>();
  const Json& figures = run.at("figures");
  const auto figure = [&](const char* group, const char* key) -> std::optional<double> {
    const auto all = figures.find(group);
    if (all == figures.end()) return std::nullopt;
    const auto value = all->find(key);
    if (value == all->end() || !value->is_number()) return std::nullopt;
    return value->get<double>();
  };
  result.lpDense = figure("likeness", "lp_dense");
  result.coverage = figure("likeness", "coverage");
  result.multiscale = figure("likeness", "multiscale");
  result.rolled = figure("novelty", "distance_to_rolled_example");
  if (const auto frontier = figures.find("frontier");
      frontier != figures.end() && frontier->value("kind", Json()).is_string())
    result.frontier = frontier->at("kind").get<std::string>();
  if (const auto doubts = figures.find("doubts"); doubts != figures.end())
    for (const auto& [name, doubted] : doubts->items())
      if (doubted.is_boolean() && doubted.get<bool>()) result.doubts.push_back(name);
  return result;
}

/// How far an engine's results are apart, by their files.
ComparedSeeds seedsOfFields(const std::string& engine, const Json& runs, const fs::path& folder,
                            const Progress& progress) {
  std::vector<Occupancy> results;
  std::vector<std::uint64_t> seeds;
  for (const Json& run : runs) {
    if (run.at("engine") != engine || run.at("status") != "complete") continue;
    results.emplace_back(readVdb(folder / run.at("field").get<std::string>()));
    seeds.push_back(run.at("seed").get<std::uint64_t>());
    // Meshes that were sampled where nobody said their size may differ in it.
    if (results.back().size() == results.front().size()) continue;
    results.pop_back();
    seeds.pop_back();
  }
  return comparedSeeds(engine, seeds, [&](std::size_t a, std::size_t b) {
    return SeedDistance{1 - intersectionOverUnion(results[a], results[b]),
                        rolledDistance(results[a], results[b], {}, progress).distance};
  });
}

}  // namespace

ComparedEngine parseComparedEngine(const std::string& text) {
  const std::vector<std::string> words = split(text, ':');
  ComparedEngine compared;
  compared.name = text;
  if (words[0] == "optimize") {
    compared.engine = &geometryEngine();
  } else if (words[0] == "overlap") {
    // Of those tried the strictest that can go on with a terrain.
    compared.engine = &modelEngine();
    compared.settings = {{"field-overlap", "2"}, {"field-tolerance", "1"}};
  } else {
    compared.engine = &engineNamed(words[0]);
  }
  for (std::size_t w = 1; w < words.size(); ++w) {
    const auto [key, value] = keyAndValue(words[w], words[0], "NAME:KEY=VALUE");
    compared.settings.set(key, value);
  }
  const std::vector<Setting> all = settingsOf(*compared.engine);
  for (const auto& [key, value] : compared.settings.given()) {
    const bool known = std::ranges::find(all, key, &Setting::key) != all.end();
    const bool own = key.starts_with("field-") ||
                     std::ranges::find(compared.engine->settings(), key, &Setting::key) !=
                         compared.engine->settings().end();
    if (known && !own)
      throw InputError("`" + key + "`: is the same for all engines that are compared");
  }
  checkSettings(*compared.engine, compared.settings);
  return compared;
}

void compare(const Example& example, const ComparisonOptions& options,
             const std::function<void(const ComparedRun&)>& finished, const Progress& progress) {
  const fs::path& folder = options.folder;
  makeFolder(folder);
  const Vec3d scale = options.scale.value_or(example.hints.scale);
  scaledSize(example.field().size(), scale, "samples");
  progress.report("drawing the example", 0);
  TriangleMesh mesh = pictured(example.source, example.reading, progress.part(0, 0.02));
  turn(mesh, example.turn.back());
  const RenderOptions picture = straightPicture(options.picture, example.turn);
  const auto wrote = [&](const fs::path& path) {
    if (options.wrote) options.wrote(path);
  };
  writePng(folder / "example.png", render(mesh, picture, progress.part(0.02, 0.04)));
  wrote(folder / "example.png");
  const std::string view =
      exampleView(mesh, &example.field(), picture, kManyViews, progress.part(0.04, 0.06));

  Json comparison = comparisonHead(example, scale);
  const std::uint64_t hash = hashOf(example);
  const std::size_t runs = options.engines.size() * static_cast<std::size_t>(options.seeds);
  std::size_t done = 0;
  for (int s = 0; s < options.seeds; ++s) {
    for (const ComparedEngine& compared : options.engines) {
      const std::uint64_t seed = options.firstSeed + static_cast<std::uint64_t>(s);
      const Json request = requestJson(example, options, hash, scale, compared.name, seed);
      const fs::path file = folder / (runName(compared.name, seed) + ".json");
      std::optional<Json> run = finishedRun(file, request, folder);
      const bool again = run.has_value();
      const double from = 0.06 + 0.9 * static_cast<double>(done++) / static_cast<double>(runs);
      const Progress part = progress.part(from, from + 0.9 / static_cast<double>(runs));
      if (!again) {
        run = makeRun(example, options, compared, scale, seed, part);
        (*run)["request"] = request;
        writeFile(file, jsonText(*run, 2) + "\n");
        wrote(file);
      }
      if (finished) finished(readable(*run, again));
      run->erase("request");
      comparison["runs"].push_back(std::move(*run));
    }
  }
  for (const ComparedEngine& compared : options.engines) {
    progress.report("comparing seeds", 0.96);
    const ComparedSeeds seeds =
        seedsOfFields(compared.name, comparison.at("runs"), folder, progress.part(0.96, 0.96));
    if (seeds.results < 2) continue;
    addSeeds(seeds, "their solid", comparison);
    if (options.compared) options.compared(seeds);
  }
  progress.report("writing the report", 0.96);
  writeFile(folder / "compare.json", jsonText(comparison, 2) + "\n");
  writeFile(folder / "report.html", comparisonPage(comparison, folder, view, picture));
}

}  // namespace exemplar
