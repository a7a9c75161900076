// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar synth: the main path. An example becomes a field, the field more of itself, and that a
// mesh with the example's materials.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "mesh/mesh_file.h"
#include "reconstruct/copy_triangles.h"
#include "reconstruct/field_to_mesh.h"
#include "reconstruct/transfer.h"
#include "sdf/vdb_file.h"
#include "synth/geometry/blocks.h"
#include "synth/geometry/optimize.h"

namespace exemplar {
namespace {

enum class Method { Blocks, Optimize };
enum class Surface { Contour, Copy };

struct Options {
  std::string example, output, scale, preview, stats, origins;
  std::string engine = "geometry";
  Method method = Method::Optimize;
  Surface surface = Surface::Contour;
  BlockSeeding seeding = BlocksOptions{}.seeding;
  std::optional<int> block, levels;
  std::uint64_t seed = 0;
  ExampleOptions reading;
  PictureOptions picture;
  CommonOptions common;
};

constexpr const char* kOutputEndings = ".obj .ply .stl .off .glb .vdb .png .pgm .asc";

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// The result's size in samples: the example's, scaled, at least one a side.
Vec3i resultSize(const Example& example, const Vec3d& scale) {
  Vec3i size;
  for (int axis = 0; axis < 3; ++axis) {
    const double n = std::round(example.field.size()[axis] * scale[axis]);
    if (!(n >= 1 && n <= 32767)) {
      throw InputError("--scale: the result would be " + std::to_string(n) +
                       " samples long; expected 1 to 32767");
    }
    size[axis] = static_cast<int>(n);
  }
  // The field, its origins, the search and the surface, about, for each sample.
  requireMemory(80.0 * static_cast<double>(volume(size)), "a result of " + readableSize(size),
                "use a lower --resolution or a smaller --scale");
  return size;
}

SynthesisResult synthesize(const Options& options, const Example& example, const Vec3i& size,
                           const Progress& progress) {
  if (options.method == Method::Optimize) {
    return synthesizeOptimized(
        example.field, {.size = size, .seed = options.seed, .levels = options.levels}, progress);
  }
  BlocksOptions blocks;
  blocks.size = size;
  blocks.seed = options.seed;
  blocks.block = options.block.value_or(example.block);
  blocks.iterations = options.levels.value_or(blocks.iterations);
  blocks.seeding = options.seeding;
  return synthesizeBlocks(example.field, blocks, progress);
}

TriangleMesh reconstruct(const Options& options, const Example& example,
                         const SynthesisResult& result, Terminal& terminal) {
  if (options.surface == Surface::Copy) {
    if (!example.mesh) {
      throw InputError(
          "--surface copy: the example has no triangles to copy; use --surface contour");
    }
    terminal.step("copying the example's triangles");
    return copyTriangles(result.field, result.origins, *example.mesh, example.field).mesh;
  }
  terminal.step("contouring");
  TriangleMesh mesh = fieldToMesh(result.field);
  if (example.mesh) {
    terminal.step("pulling materials and colours through the origins");
    transferAppearance(mesh, result.field, result.origins, *example.mesh, example.field);
  }
  return mesh;
}

nlohmann::ordered_json toJson(const Vec3i& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json toJson(const MeshHealth& health) {
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

/// The main path, from file to file.
void synth(const Options& options) {
  const Stopwatch total;
  const ThreadLimit limit(options.common.threads);
  Terminal terminal(options.common.quiet);
  requireOutput(options.output, kOutputEndings);
  if (!options.preview.empty()) requireOutput(options.preview, ".png");
  if (!options.stats.empty()) requireOutput(options.stats, ".json");
  if (!options.origins.empty()) requireOutput(options.origins, ".vdb");
  const RenderOptions picture = renderOptions(options.picture);

  const Example example = loadExample(options.example, options.reading, terminal.progress());
  terminal.say("example", options.example + ": " + example.description);
  const double readSeconds = total.seconds();

  const Vec3d scale = options.scale.empty() ? example.scale : parseTriple(options.scale, "--scale");
  const Vec3i size = resultSize(example, scale);
  const Stopwatch synthesis;
  const SynthesisResult result = synthesize(options, example, size, terminal.progress());
  if (result.status == SynthesisStatus::Cancelled) throw Interrupted();
  const double synthesisSeconds = synthesis.seconds();
  terminal.say("result", readableSize(size) + " in " + readableSeconds(synthesisSeconds) +
                             ", seed " + std::to_string(options.seed));

  nlohmann::ordered_json stats = {
      {"example", options.example},
      {"output", options.output},
      {"method", options.method == Method::Blocks ? "blocks" : "optimize"},
      {"seed", options.seed},
      {"example_samples", toJson(example.field.size())},
      {"result_samples", toJson(size)},
      {"voxel_size", example.field.voxelSize},
      {"matches", result.matches}};

  const Stopwatch surface;
  const bool meshOut = isMeshFile(options.output);
  if (meshOut || !options.preview.empty()) {
    const TriangleMesh mesh = reconstruct(options, example, result, terminal);
    const MeshHealth health = meshHealth(mesh);
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
  }
  if (isHeightMapFile(options.output)) {
    writeHeightMap(options.output, sdfToHeightMap(result.field), example.heights);
    terminal.say("heights", options.output);
  }
  if (lowerExtension(options.output) == ".vdb") {
    writeVdb(options.output, result.field);
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
  addExampleOptions(*command, options->reading);
  addPictureOptions(*command, options->picture);
  addCommonOptions(*command, options->common);
  return [options] { synth(*options); };
}

}  // namespace exemplar
