// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar synth: the main path. Read, synthesize, realize, write.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "apps/command.h"
#include "apps/help.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "core/memory.h"
#include "core/platform.h"
#include "engine/engine.h"
#include "engine/json.h"
#include "engine/measured.h"
#include "engine/output.h"
#include "engine/page.h"
#include "engine/realize.h"
#include "engine/words.h"
#include "mesh/image.h"
#include "preview/relief.h"
#include "sdf/vdb_file.h"

namespace exemplar {
namespace {

struct Options {
  std::vector<std::string> examples, with, outputs;
  std::string engine, preview, stats, origins, report, layers, pieces;
  int results = 1;
  bool open = false;
  Settings settings;
  PictureOptions picture;
};

/// The options with the files that one of several results goes to: `o.glb` is `o_000.glb`,
/// `o_001.glb` and so on.
Options numbered(const Options& options, int result) {
  Options own = options;
  if (options.results == 1) return own;
  char number[16];
  std::snprintf(number, sizeof number, "%03d", result);
  for (std::string& output : own.outputs) output = channelPath(output, number).string();
  for (std::string* file : {&own.preview, &own.stats, &own.origins, &own.report, &own.layers})
    if (!file->empty()) *file = channelPath(*file, number).string();
  return own;
}

/// What the command line asks for, checked before any file is read.
struct Plan {
  const Engine* engine;
  std::vector<Source> sources;
  ReadOptions reading;
  Request request;
  SurfaceOptions surface;
  OutputOptions output;
  RenderOptions picture;
};

/// The engine that is named, or that the example asks for. The methods of geometry synthesis were
/// once named by --method, and still may be.
const Engine& engineOf(const Options& options, Settings& settings) {
  const std::string method = settings.text("method");
  const bool named = options.engine != "auto" && !options.engine.empty();
  const Source first(options.examples.front());
  const Engine& engine = named             ? engineNamed(options.engine, first)
                         : !method.empty() ? engineNamed("geometry")
                                           : engineFor(first, settings);
  if (engine.name() != "geometry" || method.empty()) return engine;
  if (method != "optimize" && method != "blocks")
    throw InputError("`method` " + method + ": expected optimize or blocks");
  settings.remove("method");
  return method == "blocks" ? engineNamed("blocks") : engine;
}

/// Where the example's layers are written beside the result's: `l.png`, `l_example.png`.
std::filesystem::path exampleLayersPath(const std::filesystem::path& layers) {
  return layers.parent_path() / (layers.stem().string() + "_example" + layers.extension().string());
}

/// Refuses outputs that would overwrite each other, or what they are made from, and folders that
/// cannot be written.
void checkOutputs(const Options& options, Form form, int lods) {
  using Paths = std::vector<std::filesystem::path>;
  for (const std::string& output : options.outputs) requireOutput(output, outputEndings(form));
  if (!options.preview.empty()) requireOutput(options.preview, ".png");
  if (!options.stats.empty()) requireOutput(options.stats, ".json");
  if (!options.origins.empty()) requireOutput(options.origins, ".vdb");
  if (!options.report.empty()) requireOutput(options.report, ".html");
  if (!options.layers.empty()) requireOutput(options.layers, ".png");
  if (!options.pieces.empty()) requireOutput(options.pieces, ".glb");
  Paths inputs(options.examples.begin(), options.examples.end());
  inputs.insert(inputs.end(), options.with.begin(), options.with.end());
  for (const char* key :
       {"keep", "guide", "mix-map", "on", "mask", "base", "detail-of", "layers-from", "paint", "inpaint"})
    if (options.settings.has(key)) inputs.emplace_back(options.settings.text(key));
  std::vector<std::pair<std::string, std::string>> channels;
  if (form == Form::Map) channels = readingOf(options.settings, form).channels;
  for (const auto& [name, file] : channels) inputs.emplace_back(file);
  Paths files;
  for (int result = 0; result < options.results; ++result) {
    const Options own = numbered(options, result);
    const Paths outputs = filesOf(own.outputs, lods);
    files.insert(files.end(), outputs.begin(), outputs.end());
    for (const auto& [name, file] : channels)
      for (const std::string& output : own.outputs) files.push_back(channelPath(output, name));
    for (const std::string* file :
         {&own.preview, &own.stats, &own.origins, &own.report, &own.layers})
      if (!file->empty()) files.emplace_back(*file);
    if (!own.layers.empty()) files.push_back(exampleLayersPath(own.layers));
  }
  if (!options.pieces.empty()) files.emplace_back(options.pieces);
  requireDistinct(files, inputs);
}

Plan planOf(const Options& options) {
  Plan plan;
  Settings settings = options.settings;
  PictureOptions picture = options.picture;
  // --size was once the picture's, too: 640x480.
  if (settings.text("size").find('x') != std::string::npos) {
    picture.size = settings.text("size");
    settings.remove("size");
  }
  plan.picture = renderOptions(picture);
  plan.engine = &engineOf(options, settings);
  const Form form = plan.engine->form();
  checkSettings(*plan.engine, settings);

  surfaceSettings(form).apply(settings, plan.surface);
  checkOutputs(options, form, plan.surface.lods);
  if (!options.layers.empty() && form != Form::Map)
    throw InputError("--write-layers: only the engine layered has layers; leave it out");
  if (!options.report.empty() && form == Form::Map)
    throw InputError("--report: a page shows surfaces, and a map has none; leave it out");
  if (!options.origins.empty() && form != Form::Field)
    throw InputError("--origins: only results of distance fields have them; leave it out");
  if (!options.pieces.empty() && form != Form::Labels)
    throw InputError("--pieces: only model synthesis places pieces; leave it out");
  if (!options.report.empty() && settings.has("frames"))
    throw InputError("--report: a page shows one frame; leave out `frames` or --report");

  for (const auto* paths : {&options.examples, &options.with})
    plan.sources.insert(plan.sources.end(), paths->begin(), paths->end());
  plan.reading = readingOf(settings, form);
  plan.output = {plan.reading.mesh, plan.surface.instances, plan.picture, {}};
  for (const std::string& output : options.outputs)
    requireOutputKind(output, settings.has("frames"), plan.surface.instances);
  requireSurface(plan.surface, plan.sources.size());
  // What is left is asked of the engine.
  for (const auto& table : {readingSettings(form).settings(), surfaceSettings(form).settings()})
    for (const Setting& setting : table) settings.remove(setting.key);
  plan.request = requestOf(settings, plan.reading);
  if (form == Form::Field) plan.reading.wanted = plan.request.extent;
  plan.engine->check(plan.request, plan.sources.size());
  for (const Source& source : plan.sources) requireThere(source);
  return plan;
}

/// What a run took, for its summary and its figures.
struct Times {
  Stopwatch total;
  double read = 0, synthesis = 0;
};

/// Refuses what cannot be written, or would overwrite what the examples name, before it is made.
void checkExtent(const Options& options, const Plan& plan, std::span<const Example> examples) {
  for (int result = 0; result < options.results; ++result)
    requireKept(numbered(options, result).outputs, plan.surface.lods, examples);
  const Vec3i size = plan.engine->extentOf(examples, plan.request);
  for (const std::string& output : options.outputs)
    requireOutputFits(output, examples.front(), size);
  requireSurface(plan.surface, examples);
}

std::vector<Example> read(const Options& options, const Plan& plan, Terminal& terminal) {
  std::vector<Example> examples =
      readExamples(plan.sources, plan.reading, terminal.progress().part(0, 0.15));
  for (const Example& example : examples) {
    terminal.say("example", example.name() + ": " + example.description);
    for (const std::string& warning : example.warnings) terminal.warn(warning);
  }
  checkExtent(options, plan, examples);
  return examples;
}

/// A complete result; with `detail`, of `examples` that are sampled more finely, too.
Result synthesize(const Plan& plan, std::vector<Example>& examples, Terminal& terminal,
                  const Progress& progress) {
  Result result = plan.engine->run(examples, plan.request, progress.part(0.15, 0.6));
  if (result.outcome == Outcome::Cancelled) throw Cancelled();
  if (result.outcome != Outcome::Complete) throw Unfinished(result.why, result.conflict);
  if (plan.surface.detail > 1) {
    examples = refined(examples, plan.surface.detail, progress.part(0.6, 0.65));
    result = withDetail(result, examples, plan.surface.detail, progress.part(0.65, 0.7));
  }
  for (const auto& [label, note] : result.notes) terminal.say(label, note);
  for (const std::string& warning : result.warnings) terminal.warn(warning);
  return result;
}

/// The surface, where anything that is to be written takes it.
std::optional<Surface> surfaceFor(const Options& options, const Plan& plan, const Result& result,
                                  std::span<const Example> examples, const Progress& progress) {
  if (result.form() == Form::Map) return std::nullopt;
  const bool heights = result.form() == Form::Heights;
  const bool needed = std::ranges::any_of(options.outputs, [&](const std::string& output) {
    return needsSurface(output, result, plan.output);
  });
  if (!needed && (options.preview.empty() || heights) && options.report.empty())
    return std::nullopt;
  return realize(result, examples, plan.surface, progress);
}

/// A page of the example, the result and their figures.
void writeReport(const Options& options, const Plan& plan, std::span<const Example> examples,
                 const Result& result, const Surface& surface, double seconds,
                 const Progress& progress) {
  const Example& example = examples.front();
  Json run = {{"engine", result.engine}, {"seed", result.seed}, {"seconds", seconds}};
  if (const auto measures = measure(result, examples, &surface.mesh, progress.part(0, 0.4)))
    run["figures"] = toJson(figures(*measures));
  if (const auto content = measureContent(result, examples, progress.part(0.4, 0.4)))
    run["figures"].update(toJson(figures(*content)));
  run["peak_memory_bytes"] = peakResidentBytes();
  if (example.form() == Form::Labels) run["labels"] = example.labels().labelCount();
  const TriangleMesh whole =
      example.form() != Form::Field
          ? pictured(example, progress.part(0.4, 0.5))
          : pictured(example.source, example.reading, progress.part(0.4, 0.5));
  const std::optional<SampledResult> samples = sampled(result, example);
  const auto* labeled = std::get_if<LabeledField>(&example.content);
  ResultPage page{options.report, example.source.path(), example.description, whole, surface.mesh};
  page.turn = example.turn;
  if (samples) {
    page.exampleField = labeled ? &labeled->field : &example.field();
    page.field = &samples->field;
    page.origins = &samples->origins;
  }
  writePage(page, std::move(run), plan.picture, progress.part(0.5, 1));
}

/// The example and the result as relief at one scale, with their streams, in light from the
/// northwest and, below, from the northeast.
Image8 reliefOf(const HeightMap& example, const HeightMap& result, const RenderOptions& picture,
                const Progress& progress) {
  const ReliefMap maps[] = {{&example.heights, example.cellSize},
                            {&result.heights, result.cellSize}};
  ReliefOptions options{.azimuths = {1.75 * std::numbers::pi, 0.25 * std::numbers::pi}};
  options.streamCells =
      static_cast<std::uint32_t>(std::max<std::size_t>(2, example.heights.count() / 400));
  options.longest = std::max(picture.width, picture.height);
  return renderRelief(maps, options, progress);
}

/// How large the result was asked to be, in sizes of the example.
Vec3d scaleOf(const Plan& plan, const Result& result, std::span<const Example> examples) {
  const Extent& extent = plan.request.extent;
  if (!extent.size) return extent.scale.value_or(examples.front().hints.scale);
  Vec3d scale = cast<double>(*extent.size);
  const Vec3i was = examples.front().field().size();
  const int factor = std::max(1, result.field().size().x / extent.size->x);
  for (int axis = 0; axis < 3; ++axis) scale[axis] *= static_cast<double>(factor) / was[axis];
  return scale;
}

void writeStats(const Options& options, std::span<const Example> examples, const Result& result,
                const std::optional<Surface>& surface, const Times& times, const Terminal& terminal,
                const Progress& progress) {
  Json stats = {{"example", options.examples.front()},
                {"output", options.outputs.front()},
                {"outputs", options.outputs},
                {"engine", result.engine},
                {"seed", result.seed},
                {"outcome", outcomeName(result.outcome)}};
  stats.update(toJson(result.statistics));
  if (surface) stats["mesh"] = toJson(surface->health);
  if (result.layers) {
    stats.update(
        toJson(figures(measureLayers(*result.exampleLayers, false, *result.layers, progress))));
  }
  if (const auto terrain = measureTerrain(result, examples, progress))
    stats.update(toJson(figures(*terrain)));
  stats["warnings"] = terminal.warnings();
  const double total = times.total.seconds();
  stats["seconds"] = {{"read", times.read},
                      {"synthesis", times.synthesis},
                      {"surface_and_picture", total - times.read - times.synthesis},
                      {"total", total}};
  stats["peak_rss_bytes"] = peakResidentBytes();
  writeFile(options.stats, jsonText(stats, 2) + "\n");
}

/// The result first; what goes with it must not cost it.
void write(const Options& options, Plan plan, std::span<const Example> examples,
           const Result& result, const std::optional<Surface>& surface, const Times& times,
           Terminal& terminal, const Progress& progress) {
  plan.output.wrote = [&](const std::filesystem::path& path) { terminal.noteFile(path, "frame"); };
  const auto say = [&](const Written& written) {
    if (result.laterFrames.empty() || lowerExtension(written.path) == ".gif") {
      terminal.wrote(written.label, written.path, written.text);
    } else {
      terminal.say(written.label, written.text);
    }
    for (const std::string& warning : written.warnings) terminal.warn(warning);
  };
  const auto count = static_cast<double>(options.outputs.size());
  for (std::size_t n = 0; n < options.outputs.size(); ++n) {
    const Progress part = progress.part(0.85 + 0.05 * static_cast<double>(n) / count,
                                        0.85 + 0.05 * static_cast<double>(n + 1) / count);
    const std::string& output = options.outputs[n];
    say(writeResult(output, result, examples, surface ? &*surface : nullptr, plan.output,
                    part.part(0, 0.8)));
    if (!surface) continue;
    for (const Written& lod : writeLods(output, *surface, plan.output, part.part(0.8, 1))) say(lod);
  }
  if (!options.origins.empty()) {
    writeOriginsVdb(
        options.origins, result.origins, result.field(),
        {.turn = turnOf(result, examples.front()), .scale = scaleOf(plan, result, examples)});
    terminal.wrote("origins", options.origins, options.origins);
  }
  if (!options.layers.empty()) {
    const int layers = layerCount(*result.exampleLayers);
    writeLayerMap(options.layers, gridOf(*result.layers), layers);
    terminal.wrote("layers", options.layers, options.layers);
    const std::filesystem::path ofExample = exampleLayersPath(options.layers);
    writeLayerMap(ofExample, gridOf(*result.exampleLayers), layers);
    terminal.wrote("layers", ofExample.string(), ofExample.string() + ", the example's");
  }
  if (!options.preview.empty() && result.form() == Form::Map) {
    writeMapLayer(options.preview, result.map().layers.front());
    terminal.wrote("picture", options.preview, options.preview);
  } else if (!options.preview.empty() && result.form() == Form::Heights) {
    writePng(options.preview, reliefOf(examples.front().heights(), result.heights(), plan.picture,
                                       progress.part(0.9, 0.95)));
    terminal.wrote("picture", options.preview,
                   options.preview + ": shaded relief, the example beside the result");
  } else if (!options.preview.empty()) {
    writePng(options.preview, render(surface->mesh, plan.picture, progress.part(0.9, 0.95)));
    terminal.wrote("picture", options.preview, options.preview);
  }
  if (!options.report.empty()) {
    writeReport(options, plan, examples, result, *surface, times.synthesis, progress.part(0.95, 1));
    terminal.wrote("report", options.report, options.report);
  }
  for (const std::string& warning : *plan.picture.warnings) terminal.warn(warning);
  if (!options.stats.empty()) {
    writeStats(options, examples, result, surface, times, terminal, progress.part(0.95, 1));
    terminal.wrote("stats", options.stats, options.stats);
  }
}

/// One result of examples that were read: synthesize, realize, write. `progress` counts from 0.15.
void makeResult(const Options& options, const Plan& plan, std::vector<Example>& examples,
                Times times, Terminal& terminal, const Progress& progress) {
  const double before = times.total.seconds();
  const Result result = synthesize(plan, examples, terminal, progress);
  times.synthesis = times.total.seconds() - before;
  terminal.say("result", readableExtent(result) + " in " + readableSeconds(times.synthesis) +
                             ", seed " + std::to_string(result.seed));

  const std::optional<Surface> surface =
      surfaceFor(options, plan, result, examples, progress.part(0.7, 0.85));
  if (surface && surface->contoured > surface->health.triangles) {
    terminal.say("simplified", withThousands(surface->contoured) + " triangles to " +
                                   withThousands(surface->health.triangles));
  }
  write(options, plan, examples, result, surface, times, terminal, progress);
}

/// The main path, from file to file.
void synth(const Options& options, Terminal& terminal) {
  Times times;
  Plan plan = planOf(options);
  Warnings ofPictures;
  plan.picture.warnings = plan.output.picture.warnings = &ofPictures;

  std::vector<Example> examples = read(options, plan, terminal);
  times.read = times.total.seconds();
  if (!options.pieces.empty()) {
    const Written library = writePieceLibrary(options.pieces, examples.front(), {});
    terminal.wrote(library.label, library.path, library.text);
  }

  const int count = options.results;
  for (int n = 0; n < count; ++n) {
    // What comes after reading, 0.15 to 1, is each result's share of it.
    const double end = 0.15 + 0.85 * (n + 1) / count;
    const Progress progress = terminal.progress().part(end - 1.0 / count, end);
    std::vector<Example> own;  // detail refines them
    if (count > 1 && plan.surface.detail > 1) own = examples;
    makeResult(numbered(options, n), plan, own.empty() ? examples : own, times, terminal, progress);
    ++plan.request.seed;
  }

  if (options.open) {
    const Options first = numbered(options, 0);
    const std::string& shown = !first.report.empty()    ? first.report
                               : !first.preview.empty() ? first.preview
                                                        : first.outputs.front();
    if (!platform::openOnDesktop(shown)) terminal.warn("--open: nothing here opens " + shown);
  }
  terminal.say("done", readableSeconds(times.total.seconds()) + ", " +
                           readableBytes(static_cast<double>(peakResidentBytes())) +
                           " of memory at its peak");
}

void addSettings(CLI::App& command, Settings& into) {
  SettingOptions options;
  options.add("Request", "", requestSettings());
  options.add("Reading a mesh, volume or height map as distances", "distances",
              readingSettings(Form::Field).settings());
  options.add("Reading labels, or a mesh or picture cut into labels", "labels",
              readingSettings(Form::Labels).settings());
  for (const Engine* engine : engines()) {
    const std::string name(engine->name());
    options.add("Engine " + name + ": " + std::string(engine->meaning()), name, engine->settings());
  }
  options.add("Reading a mesh as polygons", "polygons", readingSettings(Form::Polygons).settings());
  options.add("Reading a picture as a map", "maps", readingSettings(Form::Map).settings());
  options.add("Reading a height map for terrain", "heights",
              readingSettings(Form::Heights).settings());
  options.add("The result's surface", "", surfaceSettings(Form::Field).settings());
  options.add("The result's surface", "", surfaceSettings(Form::Labels).settings());
  options.add("The result's surface", "", surfaceSettings(Form::Polygons).settings());
  options.install(command, into);
}

}  // namespace

Command addSynthCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("synth", "Synthesize more of an example");
  command
      ->add_option("EXAMPLE", options->examples,
                   "a mesh, a volume, a height map, a grid of labels, a picture or a scene (see "
                   "exemplar --help); several are mixed, or, with --frames, are the frames of one "
                   "that changes over time")
      ->required();
  command
      ->add_option("-o,--output", options->outputs,
                   std::string("what to write (may be repeated); its ending chooses the format: of "
                               "distances ") +
                       outputEndings(Form::Field) + ", of labels " + outputEndings(Form::Labels) +
                       ", of polygons " + outputEndings(Form::Polygons) + ", of maps " +
                       outputEndings(Form::Map) + ", of terrain " + outputEndings(Form::Heights))
      ->required()
      ->allow_extra_args(false);
  command
      ->add_option("-n,--results", options->results,
                   "how many results, each of the next seed; their files are numbered: o_000.glb, "
                   "o_001.glb, ... (1)")
      ->check(CLI::Range(1, 1000))
      ->option_text("N");
  std::string names;
  for (const Engine* engine : engines()) names += "|" + std::string(engine->name());
  command
      ->add_option("--engine", options->engine,
                   "what makes it (auto: model for labels and scenes of pieces, continuous "
                   "for scenes of solids, terrain for height maps, else geometry)")
      ->option_text("auto" + names);
  command
      ->add_option("--with", options->with,
                   "another example, to mix with the first (may be repeated)")
      ->allow_extra_args(false);
  command->add_option("--preview", options->preview, "also write a picture of the result (.png)");
  command->add_option("--stats", options->stats, "also write figures of the run (.json)");
  command->add_option("--origins", options->origins,
                      "also write where each sample of the result came from (.vdb)");
  command->add_option(
      "--pieces", options->pieces,
      "also write the pieces that a .json or .csv of cells names, each once (.glb)");
  command->add_option("--report", options->report,
                      "also write a page with surfaces that turn, figures and marks (.html)");
  command->add_option(
      "--write-layers", options->layers,
      "also write which layer shows at each pixel, of the result and of the example "
      "(NAME.png, NAME_example.png): to edit them and give them back");
  command->add_flag("--open", options->open,
                    "open the page, else the picture, else the result, as the desktop does");
  addSettings(*command, options->settings);
  addPictureOptions(*command, options->picture, "--picture-size");
  command->footer(examplesFooter({"synth chainmail -o more.glb --preview more.png",
                                  "synth wall.obj -o wall_more.obj -s 3,1,1 --seed 7",
                                  "synth castle -o town.glb -o town.vox --size 40,40,12"}));
  return {command, addCommonOptions(*command),
          [options](Terminal& terminal) { synth(*options, terminal); }};
}

}  // namespace exemplar
