// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar compare: engines on one example at one size, measured by one ruler. A run that is
// finished is written at once and never made again.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/help.h"
#include "core/error.h"
#include "engine/comparison.h"
#include "engine/request.h"
#include "engine/terrain_comparison.h"
#include "engine/words.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, folder;
  std::vector<std::string> engines;  // by default those that suit the example
  std::uint64_t firstSeed = 0;
  int seeds = 3;
  Settings settings;
  PictureOptions picture;
};

/// A figure to two digits; "none" where there was nothing to measure.
std::string readable(const std::optional<double>& figure) {
  if (!figure) return "none";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", *figure);
  return text;
}

void say(const ComparedRun& run, Terminal& terminal) {
  std::string text = "seed " + std::to_string(run.seed) + ": ";
  if (run.status == "complete") {
    text += readableSeconds(run.seconds) + ", lp_dense " + readable(run.lpDense) + ", coverage " +
            readable(run.coverage) + ", multiscale " + readable(run.multiscale) +
            ", rolled distance " + readable(run.rolled);
    if (!run.doubts.empty()) text += "; doubts: " + joined(run.doubts, "and");
  } else {
    text += run.status + ": " + run.why;
  }
  terminal.say(run.engine, text + (run.again ? " (made before)" : ""));
}

/// Likeness against novelty: each engine's means, and how many of its results have both.
void sayFrontier(const std::vector<ComparedRun>& runs, Terminal& terminal) {
  std::vector<std::string> engines;
  for (const ComparedRun& run : runs)
    if (std::ranges::find(engines, run.engine) == engines.end()) engines.push_back(run.engine);
  for (const std::string& engine : engines) {
    double likeness = 0, novelty = 0;
    int results = 0, both = 0;
    for (const ComparedRun& run : runs) {
      if (run.engine != engine || !run.multiscale || !run.rolled) continue;
      likeness += *run.multiscale;
      novelty += *run.rolled;
      both += run.frontier == "new_and_alike";
      ++results;
    }
    if (results == 0) continue;
    terminal.say("frontier", engine + ": likeness " + readable(likeness / results) +
                                 " (multiscale; 1 is a fresh sample), novelty " +
                                 readable(novelty / results) +
                                 " (rolled distance; 0 is a copy): " + std::to_string(both) +
                                 " of " + std::to_string(results) + " new and alike");
  }
}

/// Terrain's figures, each beside the example's or its halves'.
void say(const ComparedTerrain& run, Terminal& terminal) {
  std::string text = "seed " + std::to_string(run.seed) + ": ";
  if (run.status == "complete") {
    const TerrainLikeness& t = run.likeness;
    text += readableSeconds(run.seconds) + ", slopes " + readable(t.slopes.result) + " (floor " +
            readable(t.slopes.floor) + "), curvature " + readable(t.curvature.result) + " (" +
            readable(t.curvature.floor) + "), flooded " + readable(t.result.floodedShare) +
            " (example " + readable(t.example.floodedShare) + "), copied shapes " +
            readable(t.copiedShapes.result) + " (floor " + readable(t.copiedShapes.floor) + ")";
  } else {
    text += run.status + ": " + run.why;
  }
  terminal.say(run.engine, text);
}

void compareEngines(const Options& options, Terminal& terminal) {
  const bool isTerrain = sourceKind(Source(options.example)) == SourceKind::HeightMap;
  std::vector<std::string> engines = options.engines;
  if (engines.empty()) {
    engines = isTerrain ? std::vector<std::string>{"terrain", "layered", "geometry"}
                        : std::vector<std::string>{"blocks", "geometry", "model"};
  }
  ComparisonOptions comparison;
  for (const std::string& engine : engines) {
    try {
      comparison.engines.push_back(parseComparedEngine(engine));
    } catch (const InputError& error) {
      throw InputError("--engines " + engine + ": " + error.what());
    }
  }
  comparison.folder = options.folder;
  comparison.picture = renderOptions(options.picture);
  Warnings ofPictures;
  comparison.picture.warnings = &ofPictures;
  comparison.firstSeed = options.firstSeed;
  comparison.seeds = options.seeds;
  comparison.scale = requestOf(options.settings).extent.scale;
  comparison.compared = [&](const ComparedSeeds& seeds) {
    terminal.say(seeds.engine, "Div of " + std::to_string(seeds.results) + " seeds " +
                                   readable(seeds.diversity) + ", after the best roll " +
                                   readable(seeds.rolledDiversity));
    for (const auto& [a, b] : seeds.equal)
      terminal.warn(seeds.engine + ": seeds " + std::to_string(a) + " and " + std::to_string(b) +
                    " gave one result, moved or not" +
                    (isTerrain ? "" : "; try other axes (`stationary`)"));
  };
  comparison.wrote = [&](const std::filesystem::path& path) { terminal.noteFile(path); };
  ReadOptions reading = readingOf(options.settings, Form::Field);
  reading.wanted = Extent{.scale = comparison.scale, .size = {}};
  comparison.mesh = reading.mesh;
  if (isTerrain) {
    compareTerrain(
        options.example, reading, comparison,
        [&](const ComparedTerrain& run) { say(run, terminal); }, terminal.progress());
  } else {
    const Example example = readExample(options.example, reading, terminal.progress().part(0, 0.1));
    terminal.say("example", options.example + ": " + example.description);
    for (const std::string& warning : example.warnings) terminal.warn(warning);
    std::vector<ComparedRun> runs;
    compare(
        example, comparison,
        [&](const ComparedRun& run) {
          say(run, terminal);
          runs.push_back(run);
        },
        terminal.progress().part(0.1, 1));
    sayFrontier(runs, terminal);
  }
  for (const std::string& warning : ofPictures) terminal.warn(warning);
  for (const auto& [label, name] :
       {std::pair{"figures", "compare.json"}, {"report", "report.html"}}) {
    const std::string path = (comparison.folder / name).string();
    terminal.wrote(label, path, path);
  }
}

}  // namespace

Command addCompareCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("compare", "Run several engines on one example and measure them alike");
  command->add_option("EXAMPLE", options->example, "a mesh, a volume, a height map or a scene")
      ->required();
  command
      ->add_option(
          "-o,--output", options->folder,
          "the folder for meshes, pictures, compare.json and report.html; what it holds of "
          "the same comparison is not made again (but of height maps)")
      ->required();
  command->add_option("--seeds", options->seeds, "how many seeds each engine gets")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", options->firstSeed, "the first of them")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--engines", options->engines,
                   "which: those of synth, or overlap (model on blocks that overlap; slow on solid "
                   "fields); each as often as you like with other settings of its own, as in "
                   "geometry,geometry:levels=2,model:field-block=12:field-tolerance=1")
      ->delimiter(',')
      ->option_text("blocks,geometry,model; of a height map terrain,layered,geometry");
  SettingOptions rows;
  for (const Setting& setting : requestSettings())
    if (setting.key == "scale") rows.add("Results", "", {&setting, 1});
  rows.install(*command, options->settings);
  addReadingOptions(*command, Form::Field, options->settings);
  addPictureOptions(*command, options->picture);
  command->footer(examplesFooter({"compare chainmail -o chainmail_compared --seeds 2",
                                  "compare wall.obj -o walls -s 3,1,1 --engines geometry,blocks",
                                  "compare terrain.tif -o terrains --seeds 5"}));
  return {command, addCommonOptions(*command),
          [options](Terminal& terminal) { compareEngines(*options, terminal); }};
}

}  // namespace exemplar
