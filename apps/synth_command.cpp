// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar synth: the main path. An example becomes a field, the field more of itself, and that a
// mesh with the example's materials.

#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "apps/command.h"
#include "apps/json.h"
#include "apps/report.h"
#include "apps/synth_control.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "measure/collapse.h"
#include "measure/figures.h"
#include "measure/novelty.h"
#include "measure/occupancy.h"
#include "mesh/mesh_file.h"
#include "reconstruct/copy_triangles.h"
#include "reconstruct/reconstruct.h"
#include "sdf/vdb_file.h"
#include "synth/geometry/blocks.h"
#include "synth/geometry/detail.h"
#include "synth/geometry/optimize.h"

namespace exemplar {
namespace {

enum class Method { Blocks, Optimize };
enum class Surface { Contour, Copy };

struct Options {
  std::string example, output, scale, preview, stats, origins, report;
  std::string engine = "geometry";
  Method method = Method::Optimize;
  Surface surface = Surface::Contour;
  BlockSeeding seeding = BlocksOptions{}.seeding;
  std::optional<int> block, levels;
  std::uint64_t seed = 0;
  SynthControl control;
  ExampleOptions reading;
  PictureOptions picture;
  CommonOptions common;
};

constexpr const char* kOutputEndings = ".obj .ply .stl .off .glb .vdb .png .pgm .asc";

/// The result's size in samples.
Vec3i resultSize(const Example& example, const Vec3d& scale) {
  const Vec3i size = scaledSize(example.field.size(), scale, "samples");
  // The field, its origins, the search and the surface, about, for each sample.
  requireMemory(80.0 * static_cast<double>(volume(size)), "a result of " + readableSize(size),
                "use a lower --resolution or a smaller --scale");
  return size;
}

SynthesisResult synthesize(const Options& options, const Examples& examples, const Vec3i& size,
                           Json& stats, Terminal& terminal) {
  if (options.method == Method::Optimize) {
    OptimizeOptions optimize =
        optimizeOptions(options.control, examples, size, options.reading, terminal.progress());
    optimize.seed = options.seed;
    optimize.levels = options.levels;
    const std::vector<const DistanceField*> fields = examples.fields();
    const bool found = !optimize.stationary;
    optimize.stationary = stationaryAxes(fields, optimize);
    const StationaryAxes& axes = *optimize.stationary;
    stats["stationary"] = readableAxes(axes.x, axes.y, axes.z);
    terminal.say("stationary", readableAxes(axes.x, axes.y, axes.z) +
                                   (found ? ", found from the example (--stationary)" : ""));
    return synthesizeOptimized(fields, optimize, terminal.progress());
  }
  if (options.control.asksForOptimize()) {
    throw InputError(
        "--stationary, --periodic, --keep, --guide, --with and --rotations need --method optimize");
  }
  BlocksOptions blocks;
  blocks.size = size;
  blocks.seed = options.seed;
  blocks.block = options.block.value_or(examples.first().block);
  blocks.iterations = options.levels.value_or(blocks.iterations);
  blocks.seeding = options.seeding;
  return synthesizeBlocks(examples.first().field, blocks, terminal.progress());
}

/// Says so where the result is all solid, all empty or one part repeated, and what to change.
void warnOfCollapse(const Examples& examples, const SynthesisResult& made, Json& stats,
                    Terminal& terminal) {
  const DistanceField &example = examples.first().field, &result = made.field;
  const Occupancy before(example), after(result);
  CollapseSigns signs;
  signs.exampleOccupancy = solidFraction(before);
  signs.resultOccupancy = solidFraction(after);
  signs.exampleSurface = surfaceDensity(before);
  signs.resultSurface = surfaceDensity(after);
  if (examples.all.size() == 1) signs.usedShare = surfaceUse(before, made.origins).usedShare;
  const Collapse collapse = detectCollapse(signs);
  stats["collapse"] = collapseName(collapse);
  if (collapse == Collapse::None) return;
  terminal.say("warning",
               collapseSentence(collapse, signs) +
                   "; try another --seed, one of --levels less, or another --stationary");
}

struct SoundMesh {
  TriangleMesh mesh;
  MeshHealth health;
};

/// The surface, closed and with the examples' materials, or copied triangle by triangle.
SoundMesh reconstruct(const Options& options, const Examples& examples,
                      const SynthesisResult& result, Terminal& terminal) {
  const Example& example = examples.first();
  if (options.surface == Surface::Copy) {
    if (!example.mesh || examples.all.size() > 1) {
      throw InputError("--surface copy: " +
                       std::string(example.mesh ? "there are several examples"
                                                : "the example has no triangles to copy") +
                       "; use --surface contour");
    }
    terminal.step("copying the example's triangles");
    CopiedTriangles copied =
        copyTriangles(result.field, result.origins, *example.mesh, example.field);
    return {std::move(copied.mesh), copied.health};
  }
  terminal.step("making the surface");
  ReconstructOptions surface;
  surface.blend = 0;  // the seams of the field are evened out already
  surface.contour.wraps = parseAxes(options.control.periodic, "--periodic");
  Reconstruction made = reconstructSurface(result.field, result.origins, examples.views(), surface,
                                           terminal.progress());
  return {std::move(made.mesh), made.health};
}

Json toJson(const MeshHealth& health) {
  return {{"triangles", health.triangles},
          {"vertices", health.vertices},
          {"components", health.components},
          {"closed", health.closed()},
          {"manifold", health.manifold()},
          {"oriented", health.oriented()},
          {"boundary_edges", health.boundaryEdges},
          {"non_manifold_edges", health.nonManifoldEdges},
          {"non_manifold_vertices", health.nonManifoldVertices},
          {"misoriented_edges", health.misorientedEdges},
          {"degenerate_triangles", health.degenerateTriangles},
          {"volume", health.signedVolume}};
}

/// A page of the example, the result and their figures.
void writeReport(const Options& options, const Examples& examples, const SynthesisResult& result,
                 const TriangleMesh& mesh, double seconds, const RenderOptions& picture,
                 Terminal& terminal) {
  const Example& example = examples.first();
  terminal.step("measuring");
  MeasureInput input;
  input.origins = &result.origins;
  input.mesh = &mesh;
  Json run = {{"engine", options.method == Method::Blocks ? "blocks" : "optimize"},
              {"seed", options.seed},
              {"seconds", seconds}};
  run["figures"] =
      toJson(figures(measure(example.field, result.field, input, {}, terminal.progress())));
  run["peak_memory_bytes"] = peakResidentBytes();
  terminal.step("making the report");
  const TriangleMesh whole = loadForPicture(options.example, options.reading, terminal.progress());
  ResultReport report{options.report, options.example, example.description, whole, mesh};
  report.exampleField = &example.field;
  report.field = &result.field;
  report.origins = &result.origins;
  writeResultReport(report, std::move(run), picture, terminal.progress());
  terminal.stopIfInterrupted();
  terminal.say("report", options.report);
}

/// The main path, from file to file.
void synth(const Options& options) {
  const Stopwatch total;
  const ThreadLimit limit(options.common.threads);
  Terminal terminal(options.common.quiet);
  requireOutput(options.output, kOutputEndings);
  if (!options.preview.empty()) requireOutput(options.preview, ".png");
  if (!options.stats.empty()) requireOutput(options.stats, ".json");
  if (!options.origins.empty()) requireOutput(options.origins, ".vdb");
  if (!options.report.empty()) requireOutput(options.report, ".html");
  const RenderOptions picture = renderOptions(options.picture);

  Examples examples(loadExample(options.example, options.reading, terminal.progress()),
                    options.control, options.reading, terminal.progress());
  const Example& example = examples.first();
  for (const Example& each : examples.all) {
    terminal.say("example", each.path.string() + ": " + each.description);
  }
  const double readSeconds = total.seconds();

  const Vec3d scale = options.scale.empty() ? example.scale : parseTriple(options.scale, "--scale");
  const Vec3i size = resultSize(example, scale);
  Json stats = {{"example", options.example},
                {"output", options.output},
                {"method", options.method == Method::Blocks ? "blocks" : "optimize"},
                {"seed", options.seed},
                {"example_samples", toJson(example.field.size())},
                {"result_samples", toJson(size)},
                {"voxel_size", example.field.voxelSize}};
  const Stopwatch synthesis;
  SynthesisResult result = synthesize(options, examples, size, stats, terminal);
  if (result.status == SynthesisStatus::Cancelled) throw Interrupted();
  stats["matches"] = result.matches;
  warnOfCollapse(examples, result, stats, terminal);
  if (options.control.detail > 1) {
    terminal.step("pulling finer detail");
    examples.refine(options.control.detail, options.reading, terminal.progress());
    result =
        addDetail(examples.fields(), result.origins, options.control.detail, terminal.progress());
    if (result.status == SynthesisStatus::Cancelled) throw Interrupted();
    stats["detail"] = options.control.detail;
  }
  const double synthesisSeconds = synthesis.seconds();
  terminal.say("result", readableSize(result.field.size()) + " in " +
                             readableSeconds(synthesisSeconds) + ", seed " +
                             std::to_string(options.seed));

  const Stopwatch surface;
  const bool meshOut = isMeshFile(options.output);
  if (meshOut || !options.preview.empty() || !options.report.empty()) {
    const auto [mesh, health] = reconstruct(options, examples, result, terminal);
    stats["mesh"] = toJson(health);
    Image8 image;
    if (!options.preview.empty()) image = render(mesh, picture, terminal.progress());
    terminal.stopIfInterrupted();
    if (meshOut) {
      terminal.step("writing " + options.output);
      writeMesh(options.output, mesh, options.reading.mesh);
      terminal.say("mesh", options.output + ": " + readableHealth(health));
    }
    if (!options.preview.empty()) {
      writePng(options.preview, image);
      terminal.say("picture", options.preview);
    }
    if (!options.report.empty()) {
      writeReport(options, examples, result, mesh, synthesisSeconds, picture, terminal);
    }
  }
  if (isHeightMapFile(options.output)) {
    writeHeightMap(options.output, sdfToHeightMap(result.field), example.heights);
    terminal.say("heights", options.output);
  }
  if (lowerExtension(options.output) == ".vdb") {
    writeVdb(options.output, result.field, parseAxes(options.control.periodic, "--periodic"));
    terminal.say("field", options.output);
  }
  if (!options.origins.empty()) {
    writeOriginsVdb(options.origins, result.origins, result.field);
    terminal.say("origins", options.origins);
  }

  stats["seconds"] = {{"read", readSeconds},
                      {"synthesis", synthesisSeconds},
                      {"surface_and_picture", surface.seconds()},
                      {"total", total.seconds()}};
  stats["peak_rss_bytes"] = peakResidentBytes();
  if (!options.stats.empty()) {
    writeFile(options.stats, stats.dump(2) + "\n");
    terminal.say("stats", options.stats);
  }
  terminal.say("done", readableSeconds(total.seconds()) + ", " +
                           readableBytes(static_cast<double>(peakResidentBytes())) +
                           " of memory at its peak");
}

}  // namespace

CommandRun addSynthCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("synth", "Synthesize more of an example");
  command
      ->add_option("EXAMPLE", options->example,
                   "a mesh, a volume, a height map or a scene (see exemplar --help)")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   std::string("what to write; its ending chooses the format: ") + kOutputEndings)
      ->required();
  command->add_option("--scale", options->scale,
                      "the result's size as a multiple of the example's: X,Y,Z or one number "
                      "(the example's own choice, mostly 2,2,1)");
  command->add_option("--seed", options->seed, "another seed, another result")
      ->capture_default_str();
  command
      ->add_option("--engine", options->engine,
                   "geometry (this: distance fields) or model (labels and pieces, with options of "
                   "its own: exemplar synth --engine model --help)")
      ->check(CLI::IsMember({"geometry", "model"}))
      ->capture_default_str();
  command
      ->add_option("--method", options->method,
                   "optimize (overlapping patches; the default) or blocks (Lagae 2004)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Method>{
          {"blocks", Method::Blocks}, {"optimize", Method::Optimize}}))
      ->option_text("blocks|optimize");
  command->add_option("--block", options->block, "blocks: samples a side at the finest level (16)")
      ->check(CLI::Range(2, 256));
  command->add_option("--levels", options->levels, "levels of resolution (3 for blocks)")
      ->check(CLI::Range(1, 8));
  command
      ->add_option("--seeding", options->seeding,
                   "blocks: what samples not made yet count as: random ones of the example (as "
                   "published), or nothing (masked)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, BlockSeeding>{
          {"random", BlockSeeding::Random}, {"masked", BlockSeeding::Masked}}))
      ->option_text("random|masked");
  command
      ->add_option("--surface", options->surface,
                   "contour the new field (closed, manifold), or copy the example's triangles")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Surface>{{"contour", Surface::Contour}, {"copy", Surface::Copy}}))
      ->option_text("contour|copy");
  command->add_option("--preview", options->preview, "also write a picture of the result (.png)");
  command->add_option("--stats", options->stats, "also write figures of the run (.json)");
  command->add_option("--origins", options->origins,
                      "also write where each sample of the result came from (.vdb)");
  command->add_option("--report", options->report,
                      "also write a page with surfaces that turn, figures and what shows (.html)");
  addControlOptions(*command, options->control);
  addExampleOptions(*command, options->reading);
  addPictureOptions(*command, options->picture);
  addCommonOptions(*command, options->common);
  return [options] { synth(*options); };
}

}  // namespace exemplar
