// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar compare: both families on one example at one size, measured by one ruler. A run that is
// finished is written at once and never made again.

#include <CLI/CLI.hpp>
#include <bit>
#include <memory>
#include <optional>

#include "apps/command.h"
#include "apps/comparison.h"
#include "apps/json.h"
#include "apps/report.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "measure/figures.h"
#include "mesh/image.h"
#include "mesh/mesh_file.h"
#include "sdf/vdb_file.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string example, folder, scale;
  std::vector<std::string> engines{"blocks", "optimize", "model"};
  std::uint64_t firstSeed = 0;
  int seeds = 3;
  ExampleOptions reading;
  PictureOptions picture;
  CommonOptions common;
};

/// "optimize-patch-9-0": the beginning of the names of a run's files.
std::string runName(std::string engine, std::uint64_t seed) {
  std::ranges::replace_if(
      engine, [](char c) { return c == ':' || c == '='; }, '-');
  return engine + "-" + std::to_string(seed);
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw InputError(folder.string() + ": cannot be made a folder; name one that can");
  }
}

/// What is kept of a run beside its figures; another number where that changes.
constexpr int kParts = 2;

/// What decides a run's result: a finished run with the same is not made again. The example counts
/// with its samples, so that an edited file is another one.
Json requestOf(const Options& options, const Example& example, const Vec3d& scale,
               const std::string& engine, std::uint64_t seed) {
  std::uint64_t hash = 1469598103934665603u;  // FNV-1a
  for (const float value : example.field.values.values()) {
    hash ^= std::bit_cast<std::uint32_t>(value);
    hash *= 1099511628211u;
  }
  return {{"version", EXEMPLAR_VERSION},
          {"example", options.example},
          {"samples", toJson(example.field.size())},
          {"hash", hash},
          {"scale", toJson(scale)},
          {"engine", engine},
          {"seed", seed},
          {"parts", kParts}};
}

/// A run that was finished before, if it was made by the same request and its files are there.
std::optional<Json> finishedRun(const fs::path& file, const Json& request, const fs::path& folder) {
  if (!fs::exists(file)) return std::nullopt;
  const Json run = Json::parse(readFile(file), nullptr, false);
  if (run.is_discarded() || !run.is_object() || run.value("request", Json()) != request)
    return std::nullopt;
  for (const char* part : {"mesh", "picture", "field", "origins", "view"})
    if (run.contains(part) && !fs::exists(folder / run.at(part).get<std::string>()))
      return std::nullopt;
  return run;
}

Json makeRun(const Options& options, const Example& example, const Vec3d& scale,
             const std::string& engine, std::uint64_t seed, const RenderOptions& picture,
             Terminal& terminal) {
  const fs::path folder = options.folder;
  const std::string name = runName(engine, seed);
  terminal.step(name);
  ComparedResult result = runEngine(parseEngine(engine), example, scale, seed, terminal.progress());
  terminal.stopIfInterrupted();
  Json run{{"engine", engine}, {"seed", seed}, {"status", result.status}};
  if (result.labels) run["labels"] = *result.labels;
  if (result.status != "complete") {
    run["why"] = result.why;
    return run;
  }
  run["samples"] = toJson(result.field.size());
  run["seconds"] = result.seconds;
  if (result.peakBytes) run["peak_memory_bytes"] = *result.peakBytes;
  if (result.violations) {
    run["adjacency_pairs"] = *result.pairs;
    run["adjacency_violations"] = *result.violations;
    if (result.unknownBlocks) run["unknown_blocks"] = *result.unknownBlocks;
  }
  MeasureInput input;
  // Pieces are what they are: they have no samples to come from.
  const Origins* origins = result.origins.count() > 0 ? &result.origins : nullptr;
  input.origins = origins;
  input.mesh = &result.mesh;
  terminal.step("measuring " + name);
  run["figures"] =
      toJson(figures(measure(example.field, result.field, input, {}, terminal.progress())));
  terminal.stopIfInterrupted();
  terminal.step("drawing " + name);
  const Image8 image = render(result.mesh, picture, terminal.progress());
  terminal.stopIfInterrupted();
  terminal.step("marking " + name);
  const ResultParts parts = resultParts(result.mesh, &example.field, &result.field, origins,
                                        picture, kManyViews, terminal.progress());
  terminal.stopIfInterrupted();
  run["marks"] = toJson(parts.marks);
  run["mesh"] = name + ".glb";
  run["picture"] = name + ".png";
  run["field"] = name + ".vdb";
  if (origins) run["origins"] = name + "-origins.vdb";
  writeMesh(folder / (name + ".glb"), result.mesh, options.reading.mesh);
  writePng(folder / (name + ".png"), image);
  writeVdb(folder / (name + ".vdb"), result.field);
  if (origins) writeOriginsVdb(folder / (name + "-origins.vdb"), result.origins, result.field);
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
  Json report = reportHead("comparison", comparison.at("example").get<std::string>(),
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
      if (page.bytes() < kReportBytes / 2) {
        page.addPicture(name, readPicture(folder / run.at("picture").get<std::string>()));
      }
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
                              "meshes lie beside this page.");
  }
  requireMemory(3.0 * static_cast<double>(page.bytes()), "report.html", "give fewer --seeds");
  return page.html(report);
}

/// A figure to two digits; "none" where there was nothing to measure.
std::string readableFigure(const Json& group, const char* key) {
  const auto value = group.find(key);
  if (value == group.end() || !value->is_number()) return "none";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value->get<double>());
  return text;
}

void say(const Json& run, bool again, Terminal& terminal) {
  std::string text = "seed " + std::to_string(run.at("seed").get<std::uint64_t>()) + ": ";
  if (run.at("status") == "complete") {
    const Json& likeness = run.at("figures").at("likeness");
    text += readableSeconds(run.at("seconds").get<double>());
    for (const char* key : {"lp_dense", "coverage"})
      text += std::string(", ") + key + " " + readableFigure(likeness, key);
  } else {
    text += run.at("status").get<std::string>() + ": " + run.at("why").get<std::string>();
  }
  terminal.say(run.at("engine").get<std::string>(), text + (again ? " (made before)" : ""));
}

void compare(const Options& options) {
  const ThreadLimit limit(options.common.threads);
  Terminal terminal(options.common.quiet);
  for (const std::string& engine : options.engines) parseEngine(engine);
  const RenderOptions picture = renderOptions(options.picture);
  const fs::path folder = options.folder;
  makeFolder(folder);
  const Example example = loadExample(options.example, options.reading, terminal.progress());
  terminal.stopIfInterrupted();
  terminal.say("example", options.example + ": " + example.description);
  const Vec3d scale = options.scale.empty() ? example.scale : parseTriple(options.scale, "--scale");

  terminal.step("drawing the example");
  const TriangleMesh exampleMesh =
      loadForPicture(options.example, options.reading, terminal.progress());
  writePng(folder / "example.png", render(exampleMesh, picture, terminal.progress()));
  const std::string view =
      exampleView(exampleMesh, &example.field, picture, kManyViews, terminal.progress());
  terminal.stopIfInterrupted();

  Json comparison{
      {"example", options.example},
      {"description", example.description},
      {"picture", "example.png"},
      {"samples", toJson(example.field.size())},
      {"voxel_size", example.field.voxelSize},
      {"scale", toJson(scale)},
      {"notes",
       {"Every engine ran on the same samples, at its defaults but for what its name says; the "
        "same "
        "code measured all results.",
        "model keeps the adjacencies of the example's blocks exactly, up to the tolerance within "
        "which blocks are one label; blocks and optimize keep none exactly and trade mismatch off "
        "everywhere.",
        "model takes a bundled scene of pieces by its pieces, whose adjacencies are then counted; "
        "of anything else it takes blocks of samples.",
        "model's results are whole blocks, so their size may differ by less than half a block.",
        "seconds are of synthesis alone, on all cores in use."}},
      {"figures", Json::array()},
      {"runs", Json::array()}};
  for (const Figure& figure : figures(Measures{}))
    comparison["figures"].push_back(
        {{"group", figure.group}, {"key", figure.key}, {"meaning", figure.meaning}});
  for (int s = 0; s < options.seeds; ++s) {
    for (const std::string& engine : options.engines) {
      const std::uint64_t seed = options.firstSeed + static_cast<std::uint64_t>(s);
      const Json request = requestOf(options, example, scale, engine, seed);
      const fs::path file = folder / (runName(engine, seed) + ".json");
      std::optional<Json> run = finishedRun(file, request, folder);
      const bool again = run.has_value();
      if (!again) {
        run = makeRun(options, example, scale, engine, seed, picture, terminal);
        (*run)["request"] = request;
        writeFile(file, run->dump(2) + "\n");
      }
      say(*run, again, terminal);
      run->erase("request");
      comparison["runs"].push_back(std::move(*run));
    }
  }
  writeFile(folder / "compare.json", comparison.dump(2) + "\n");
  writeFile(folder / "report.html", comparisonPage(comparison, folder, view, picture));
  terminal.say("figures", (folder / "compare.json").string());
  terminal.say("report", (folder / "report.html").string());
}

}  // namespace

CommandRun addCompareCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "compare", "Run geometry and model synthesis on one example and measure both");
  command->add_option("EXAMPLE", options->example, "a mesh, a volume, a height map or a scene")
      ->required();
  command
      ->add_option(
          "-o,--output", options->folder,
          "the folder for meshes, pictures, compare.json and report.html; what it holds of "
          "the same comparison is not made again")
      ->required();
  command->add_option("--seeds", options->seeds, "how many seeds each engine gets")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", options->firstSeed, "the first of them")->capture_default_str();
  command
      ->add_option("--engines", options->engines,
                   "which: blocks, optimize, model, overlap (model on blocks that overlap; slow on "
                   "solid fields); each as often as you like with other settings, as in "
                   "optimize,optimize:patch=9,model:block=12:tolerance=1")
      ->delimiter(',')
      ->option_text("blocks,optimize,model");
  command->add_option("--scale", options->scale,
                      "the results' size as a multiple of the example's: X,Y,Z or one number");
  addExampleOptions(*command, options->reading);
  addPictureOptions(*command, options->picture);
  addCommonOptions(*command, options->common);
  return [options] { compare(*options); };
}

}  // namespace exemplar
