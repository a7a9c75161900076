// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar synth --engine model: an example becomes labels, the labels more of themselves, and
// these what the example was: a grid of labels, a picture, or the example's model pieces.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "apps/command.h"
#include "apps/json.h"
#include "apps/label_example.h"
#include "apps/report.h"
#include "apps/terminal.h"
#include "apps/words.h"
#include "core/error.h"
#include "core/file.h"
#include "core/memory.h"
#include "mesh/gif.h"
#include "mesh/image.h"
#include "mesh/mesh_file.h"
#include "synth/model/synthesize.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

struct Options {
  std::vector<std::string> examples;
  std::string output, size, scale, preview, stats, report, block;
  std::string engine = "model";
  std::vector<std::string> sides, pins, counts, connected, weights, weightMaps, offsets;
  std::string periodic, mirror, mask;
  std::vector<std::string> mirroredX, mirroredY, turned;
  int turns = 1;
  std::optional<int> frames;
  bool instances = false;
  ModelOptions model;
  LabelReading reading;
  PictureOptions picture;
  CommonOptions common;
};

Vec3i resultSize(const Options& options, const LabelExample& example) {
  if (!options.size.empty() && !options.scale.empty()) {
    throw InputError("--size and --scale say the same thing; give one of the two");
  }
  if (!options.size.empty()) return parseCells(options.size, "--size");
  const Vec3d scale = options.scale.empty() ? example.scale : parseTriple(options.scale, "--scale");
  return scaledSize(cellsOfSize(example), scale, "cells");
}

void readSides(const Options& options, const LabelGrid& grid, ModelOptions& model) {
  const std::map<std::string, Side> names{{"left", Side::MinX},   {"right", Side::MaxX},
                                          {"front", Side::MinY},  {"back", Side::MaxY},
                                          {"bottom", Side::MinZ}, {"top", Side::MaxZ}};
  for (const std::string& text : options.sides) {
    const auto [name, rule] =
        keyAndValue(text, "--side", "SIDE=free, SIDE=example or SIDE=LABEL,...");
    const auto side = names.find(name);
    if (side == names.end() && name != "all") {
      throw InputError("--side " + text +
                       ": expected left, right, front, back, bottom, top or all");
    }
    SideRule parsed;
    if (rule == "free") {
      parsed.kind = SideRule::Kind::Free;
    } else if (rule != "example") {
      parsed.kind = SideRule::Kind::Labels;
      parsed.labels = parseLabels(rule, grid, "--side " + text);
    }
    for (int s = 0; s < 6; ++s) {
      if (side == names.end() || static_cast<int>(side->second) == s) model.sides[s] = parsed;
    }
  }
}

void readAxes(const std::string& text, const std::string& option, bool* axes, int count) {
  for (const char c : text) {
    const int axis = c - 'x';
    if (axis < 0 || axis >= count) {
      throw InputError(option + " " + text + ": expected letters of " +
                       std::string("xyz").substr(0, static_cast<std::size_t>(count)));
    }
    axes[axis] = true;
  }
}

/// Adds what the user says that labels become, "LABEL=LABEL", to a table of a symmetry. A mirror
/// image's image is the label itself.
void readImages(const std::vector<std::string>& texts, const std::string& option, bool mirror,
                const LabelGrid& grid, std::vector<Label>& table) {
  for (const std::string& text : texts) {
    const auto [from, to] = keyAndValue(text, option, "LABEL=LABEL");
    const std::vector<Label> a = parseLabels(from, grid, option), b = parseLabels(to, grid, option);
    if (a.size() != 1 || b.size() != 1) {
      throw InputError(option + " " + text + ": expected one label on each side");
    }
    if (table.empty()) {
      for (int label = 0; label < grid.labelCount(); ++label) {
        table.push_back(static_cast<Label>(label));
      }
    }
    table[a[0]] = b[0];
    if (mirror) table[b[0]] = a[0];
  }
}

/// A map of the result: a picture's grey, 0..1, for each cell of a layer seen from above, or, from
/// a grid of the result's own size, the number in each cell.
Array3D<float> readMap(const std::string& path, const Vec3i& size, const std::string& option) {
  if (lowerExtension(path) != ".png") {
    const LabelGrid grid = readLabels(path);
    if (grid.size() != size) {
      throw InputError(option + ": " + path + " has " + readableCells(grid.size()) +
                       ", and the result " + readableCells(size));
    }
    Array3D<float> map(size);
    for (std::size_t n = 0; n < map.count(); ++n) {
      map.values()[n] = static_cast<float>(grid.cells.values()[n]);
    }
    return map;
  }
  const Image16 image = readPng16(path);
  // The picture may be larger or smaller, but not of another shape: within a pixel or a cell.
  const double width = static_cast<double>(image.height) * size.x / size.y;
  if (std::abs(width - image.width) > 1 + width / std::min(size.x, size.y)) {
    throw InputError(option + ": " + path + " has " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " pixels, and the result " +
                     std::to_string(size.x) + " x " + std::to_string(size.y) +
                     " cells seen from above: not of one shape");
  }
  Array3D<float> map({size.x, size.y, 1});
  const auto sample = [&](int x, int y) {
    const std::uint16_t* p = image.at(x, y);
    const bool gray = image.channels < 3;
    const double v = gray ? p[0] : 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    return v / 65535;
  };
  // The mean of the pixels over a cell; a picture smaller than the result gives its nearest ones.
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      const int x0 = static_cast<int>(std::int64_t{x} * image.width / size.x);
      const int x1 = static_cast<int>((std::int64_t{x} + 1) * image.width / size.x);
      const int row = size.y - 1 - y;
      const int y0 = static_cast<int>(std::int64_t{row} * image.height / size.y);
      const int y1 = static_cast<int>((std::int64_t{row} + 1) * image.height / size.y);
      double sum = 0;
      int pixels = 0;
      for (int j = y0; j < std::max(y1, y0 + 1); ++j) {
        for (int i = x0; i < std::max(x1, x0 + 1); ++i, ++pixels) sum += sample(i, j);
      }
      map(x, y, 0) = static_cast<float>(sum / pixels);
    }
  }
  return map;
}

ModelOptions modelOptions(const Options& options, const LabelExample& example) {
  ModelOptions model = options.model;
  const LabelGrid& grid = example.grid;
  model.size = resultSize(options, example);
  if (!options.block.empty()) model.block = parseCells(options.block, "--block");
  // A picture is a window into something larger: it ends anywhere.
  if (example.image) model.sides.fill(SideRule{SideRule::Kind::Free, {}});
  if (example.field) {
    const std::array<bool, 6> cut = cutSides(example.field->example.field);
    for (std::size_t side = 0; side < cut.size(); ++side)
      if (cut[side]) model.sides[side].kind = SideRule::Kind::Free;
  }
  readSides(options, grid, model);
  readAxes(options.periodic, "--periodic", model.periodic.data(), 3);
  bool mirror[2] = {false, false};
  readAxes(options.mirror, "--mirror", mirror, 2);
  model.symmetry.mirrorX = mirror[0];
  model.symmetry.mirrorY = mirror[1];
  model.symmetry.turns = options.turns;
  if (example.pieces) {
    model.symmetry.mirroredX = example.pieces->mirroredX;
    model.symmetry.mirroredY = example.pieces->mirroredY;
    model.symmetry.turned = example.pieces->turned;
  }
  readImages(options.mirroredX, "--mirrored-x", true, grid, model.symmetry.mirroredX);
  readImages(options.mirroredY, "--mirrored-y", true, grid, model.symmetry.mirroredY);
  readImages(options.turned, "--turned", false, grid, model.symmetry.turned);
  for (const std::string& text : options.pins) {
    const auto [cell, labels] = keyAndValue(text, "--pin", "X,Y,Z=LABEL,...");
    const std::vector<double> xyz = parseNumbers(cell, 3, "--pin " + text);
    PinnedCell& pin = model.pins.emplace_back();
    for (int axis = 0; axis < 3; ++axis) pin.cell[axis] = wholeNumber(xyz[axis], "--pin " + text);
    pin.labels = parseLabels(labels, grid, "--pin " + text);
  }
  for (const std::string& text : options.weights) {
    const auto [labels, value] = keyAndValue(text, "--weight", "LABEL,...=NUMBER");
    const double weight = parseNumbers(value, 1, "--weight " + text)[0];
    if (weight < 0) throw InputError("--weight " + text + ": a weight is 0 or more");
    if (model.weights.empty()) model.weights.assign(grid.labels.size(), 1.0);
    for (const Label label : parseLabels(labels, grid, "--weight " + text)) {
      model.weights[label] = weight;
    }
  }
  for (const std::string& text : options.weightMaps) {
    const auto [labels, path] = keyAndValue(text, "--weight-map", "LABEL,...=PICTURE.png");
    model.weightMaps.push_back({parseLabels(labels, grid, "--weight-map " + text),
                                readMap(path, model.size, "--weight-map")});
  }
  if (!options.mask.empty()) {
    const Array3D<float> map = readMap(options.mask, model.size, "--mask");
    model.mask = Array3D<std::uint8_t>(model.size);
    for (std::size_t n = 0; n < model.mask.count(); ++n) {
      const Vec3i c = model.mask.ijk(n);
      model.mask.values()[n] = map(c.x, c.y, std::min(c.z, map.size().z - 1)) >= 0.5f;
    }
  }
  for (const std::string& text : options.counts) {
    const auto [labels, range] = keyAndValue(text, "--count", "LABEL,...=LEAST..MOST");
    const std::size_t dots = range.find("..");
    CountLimit& limit = model.counts.emplace_back();
    limit.labels = parseLabels(labels, grid, "--count " + text);
    const std::string least = range.substr(0, dots);
    if (!least.empty()) {
      limit.least = wholeNumber(parseNumbers(least, 1, "--count " + text)[0], "--count " + text);
    }
    const std::string most = dots == std::string::npos ? least : range.substr(dots + 2);
    if (!most.empty()) {
      limit.most = wholeNumber(parseNumbers(most, 1, "--count " + text)[0], "--count " + text);
    }
  }
  for (const std::string& text : options.connected) {
    model.connected.push_back(parseLabels(text, grid, "--connect"));
  }
  return model;
}

AdjacencyOptions adjacencyOptions(const Options& options) {
  AdjacencyOptions adjacency;
  for (const std::string& text : options.offsets) {
    const std::vector<double> xyz = parseNumbers(text, 3, "--offset " + text);
    CellOffset& offset = adjacency.offsets.emplace_back();
    offset.x = wholeNumber(xyz[0], "--offset " + text);
    offset.y = wholeNumber(xyz[1], "--offset " + text);
    offset.z = wholeNumber(xyz[2], "--offset " + text);
  }
  return adjacency;
}

/// The path of one frame of a sequence: `roll.txt` becomes `roll_007.txt`.
std::filesystem::path framePath(const std::filesystem::path& path, std::size_t frame) {
  char number[16];
  std::snprintf(number, sizeof number, "_%03zu", frame);
  return path.parent_path() / (path.stem().string() + number + path.extension().string());
}

/// A flat grid as its picture, with cells of several pixels; any other one rendered.
Image8 frameImage(const LabelGrid& grid, const LabelExample& example, const RenderOptions& picture,
                  const Progress& progress) {
  if (grid.size().z != 1) return render(labelsToMesh(grid, example), picture, progress);
  const Image8 small =
      example.image ? imageFromLabels(grid, *example.image) : imageFromLabels(grid);
  const int zoom = std::max(1, 256 / std::max(small.width, small.height));
  Image8 large{small.width * zoom, small.height * zoom, small.channels, {}};
  large.pixels.reserve(static_cast<std::size_t>(large.width) * large.height * large.channels);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) {
      const std::uint8_t* pixel = small.at(x / zoom, y / zoom);
      large.pixels.insert(large.pixels.end(), pixel, pixel + small.channels);
    }
  }
  return large;
}

/// Writes a result that changes over time: as an animation, or as a file for each frame.
void writeFrames(const Options& options, const std::vector<LabelGrid>& frames,
                 const LabelExample& example, const RenderOptions& picture, Terminal& terminal) {
  if (lowerExtension(options.output) == ".gif") {
    std::vector<Image8> images;
    for (const LabelGrid& grid : frames) {
      terminal.step("drawing frame " + std::to_string(images.size() + 1));
      images.push_back(frameImage(grid, example, picture, terminal.progress()));
      terminal.stopIfInterrupted();
    }
    writeGif(options.output, images);
    terminal.say("written", options.output + ": " + std::to_string(frames.size()) + " frames");
    return;
  }
  for (std::size_t n = 0; n < frames.size(); ++n) {
    writeLabelResult(framePath(options.output, n), frames[n], example, options.instances,
                     options.reading.mesh);
  }
  terminal.say("written", framePath(options.output, 0).string() + " to " +
                              framePath(options.output, frames.size() - 1).string());
}

/// A page of the example, the result and, where labels stand for a distance field, their figures.
void writeReport(const Options& options, const LabelExample& example, const LabelGrid& grid,
                 double seconds, const RenderOptions& picture, Terminal& terminal) {
  terminal.step("making the report");
  ExampleOptions reading;
  reading.resolution = example.field ? options.reading.resolution : std::nullopt;
  reading.sceneSeed = options.reading.sceneSeed;
  reading.mesh = options.reading.mesh;
  reading.cellSize = options.reading.pointDistance;
  reading.heightScale = options.reading.heightScale;
  writeLabelReport(options.report, example, reading, grid,
                   {{"engine", "model"},
                    {"seed", options.model.seed},
                    {"seconds", seconds},
                    {"peak_memory_bytes", peakResidentBytes()},
                    {"labels", example.grid.labelCount()}},
                   picture, terminal.progress());
  terminal.stopIfInterrupted();
  terminal.say("report", options.report);
}

void synth(const Options& options) {
  const Stopwatch total;
  const ThreadLimit limit(options.common.threads);
  Terminal terminal(options.common.quiet);
  requireOutput(options.output, std::string(kLabelOutputEndings) + " .gif");
  if (!options.preview.empty()) requireOutput(options.preview, ".png");
  if (!options.stats.empty()) requireOutput(options.stats, ".json");
  if (!options.report.empty()) requireOutput(options.report, ".html");
  const RenderOptions picture = renderOptions(options.picture);

  std::vector<LabelGrid> grids;
  const LabelExample example =
      loadLabelFrames(options.examples, options.reading, grids, terminal.progress());
  terminal.stopIfInterrupted();
  terminal.say("example", options.examples.front() + ": " + example.description);
  const bool moves = options.frames.has_value();
  ModelOptions model = modelOptions(options, example);
  model.frames = options.frames.value_or(1);
  if (moves && options.examples.size() < 2) {
    throw InputError("--frames: give the frames of an example, several files");
  }
  if (!moves && (model.loop || lowerExtension(options.output) == ".gif")) {
    throw InputError((model.loop ? "--loop" : options.output) +
                     ": only what changes over time does; say how many --frames");
  }
  if (moves && !options.report.empty()) {
    throw InputError("--report: a page shows one frame; leave out --frames or --report");
  }
  if (lowerExtension(options.output) == ".png" && model.size.z != 1) {
    throw InputError(options.output + ": a picture has one layer, and the result " +
                     std::to_string(model.size.z) + "; write a .txt, .vox, .vdb or a mesh");
  }
  AdjacencyOptions pairs = adjacencyOptions(options);
  pairs.frames = moves;
  const Adjacency adjacency = findAdjacency(example, grids, pairs);
  const double readSeconds = total.seconds();

  const Stopwatch synthesis;
  const ModelResult result = synthesizeModel(grids, adjacency, model, terminal.progress());
  const double synthesisSeconds = synthesis.seconds();
  if (result.status == ModelStatus::Cancelled) throw Interrupted();
  if (result.status == ModelStatus::Impossible) {
    throw Unfinished("impossible: " + result.conflict.text);
  }
  if (result.status == ModelStatus::Unfinished) {
    throw Unfinished(
        "no result within the budget, and none is proved impossible; try another "
        "--seed, a smaller --size, or a larger --budget");
  }
  const LabelGrid& grid = result.grid();
  terminal.say("result", readableCells(grid.size()) + " in " + readableSeconds(synthesisSeconds) +
                             ", seed " + std::to_string(model.seed) +
                             (result.statistics.whole ? ", in one pass" : ", in blocks"));

  Image8 image;
  if (!options.preview.empty()) {
    terminal.step("preview");
    image = render(labelsToMesh(grid, example), picture, terminal.progress());
    terminal.stopIfInterrupted();
  }
  terminal.step("writing " + options.output);
  if (moves) {
    writeFrames(options, result.frames, example, picture, terminal);
  } else {
    terminal.say("written", writeLabelResult(options.output, grid, example, options.instances,
                                             options.reading.mesh));
  }
  if (!options.preview.empty()) {
    writePng(options.preview, image);
    terminal.say("picture", options.preview);
  }
  if (!options.report.empty()) {
    writeReport(options, example, grid, synthesisSeconds, picture, terminal);
  }
  if (!options.stats.empty()) {
    const ModelStatistics& s = result.statistics;
    const Json stats = {
        {"example", options.examples.front()},
        {"output", options.output},
        {"engine", "model"},
        {"method", s.whole ? "whole" : "blocks"},
        {"seed", model.seed},
        {"labels", example.grid.labelCount()},
        {"example_cells", toJson(example.grid.size())},
        {"result_cells", toJson(grid.size())},
        {"frames", result.frames.size()},
        {"contradictions", s.contradictions},
        {"repairs", s.repairs},
        {"blocks", s.blocks},
        {"blocks_kept", s.blocksKept},
        {"exact_solver_calls", s.exact},
        {"seconds",
         {{"read", readSeconds}, {"synthesis", synthesisSeconds}, {"total", total.seconds()}}},
        {"peak_rss_bytes", peakResidentBytes()}};
    writeFile(options.stats, stats.dump(2) + "\n");
    terminal.say("stats", options.stats);
  }
  terminal.say("done", readableSeconds(total.seconds()) + ", " +
                           readableBytes(static_cast<double>(peakResidentBytes())) +
                           " of memory at its peak");
}

void addRequestOptions(CLI::App& command, Options& options) {
  command
      .add_option(
          "--side", options.sides,
          "what may stand at a side of the result: SIDE=example (the default), SIDE=free "
          "(that of pictures) or SIDE=LABEL,...; left, right, front, back, bottom, top or all")
      ->allow_extra_args(false);
  command.add_option("--periodic", options.periodic,
                     "axes along which the result repeats: x, xy, ...");
  command
      .add_option("--pin", options.pins,
                  "cells that must have one of some labels: "
                  "X,Y,Z=LABEL,...")
      ->allow_extra_args(false);
  command.add_option(
      "--mask", options.mask,
      "a .png seen from above: black cells are holes, left empty; or a .txt, .vox or "
      ".vdb of the result's size, whose cells with 0 are");
  command
      .add_option("--weight", options.weights,
                  "make labels more or less frequent: LABEL,...=NUMBER (1); 0 forbids them")
      ->allow_extra_args(false);
  command
      .add_option("--weight-map", options.weightMaps,
                  "make labels frequent where a picture seen from above is white: "
                  "LABEL,...=PICTURE.png; or as often as the numbers in a .txt, .vox or .vdb of "
                  "the result's size say")
      ->allow_extra_args(false);
  command
      .add_option("--count", options.counts,
                  "how many cells have some labels: LABEL,...=LEAST..MOST")
      ->allow_extra_args(false);
  command
      .add_option("--connect", options.connected,
                  "labels whose cells must form one connected piece: LABEL,...")
      ->allow_extra_args(false);
  command.add_option("--mirror", options.mirror,
                     "make the result its own mirror image across x, y or both (xy)");
  command.add_option("--turns", options.turns, "alike after a half (2) or quarter (4) turn")
      ->check(CLI::IsMember({1, 2, 4}));
  command
      .add_option("--mirrored-x", options.mirroredX,
                  "labels that are mirror images of each other across x: LABEL=LABEL (known of "
                  "model pieces; others are their own)")
      ->allow_extra_args(false);
  command.add_option("--mirrored-y", options.mirroredY, "the same across y")
      ->allow_extra_args(false);
  command
      .add_option("--turned", options.turned,
                  "what a label becomes by a quarter turn anticlockwise: LABEL=LABEL")
      ->allow_extra_args(false);
  command
      .add_option("--offset", options.offsets,
                  "keep the example's pairs at a further offset, too: X,Y,Z, as 1,1,0")
      ->allow_extra_args(false);
}

}  // namespace

CommandRun addModelSynthCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("synth", "Synthesize more of an example by its labels (model synthesis)");
  command
      ->add_option(
          "EXAMPLE", options->examples,
          "a label grid (.txt .vox .vdb), a picture, a mesh with --cell, or a scene; "
          "several label grids or pictures are examples of one kind, or, with --frames, the "
          "frames of one that changes over time")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   std::string("what to write; its ending chooses the format: ") +
                       kLabelOutputEndings + "; frames become NAME_000.txt, ... or one .gif")
      ->required();
  command->add_option("--size", options->size, "the result's size in cells: X,Y,Z");
  command->add_option("--scale", options->scale,
                      "its size as a multiple of the example's, in place of --size: X,Y,Z or one "
                      "number (2,2,1; 2 for grids of labels)");
  command->add_option("--seed", options->model.seed, "another seed, another result")
      ->capture_default_str();
  command->add_option("--engine", options->engine, "model (this) or geometry (distance fields)")
      ->check(CLI::IsMember({"model"}))
      ->capture_default_str();
  command
      ->add_option("--method", options->model.method,
                   "whole (in one pass), blocks (modified block by block), or auto (whole, and "
                   "blocks where that comes to no end)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, ModelMethod>{{"auto", ModelMethod::Auto},
                                             {"whole", ModelMethod::Whole},
                                             {"blocks", ModelMethod::Blocks}}))
      ->option_text("auto|whole|blocks");
  command
      ->add_option("--choice", options->model.choice,
                   "how probable labels are: as frequent as in the example beside what stands "
                   "around (neighbors, the default), in like surroundings of 3 x 3 x 3 cells "
                   "(resemblance), or all over (frequency); or all alike (uniform)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, LabelChoice>{{"neighbors", LabelChoice::Neighbors},
                                             {"frequency", LabelChoice::Frequency},
                                             {"uniform", LabelChoice::Uniform},
                                             {"resemblance", LabelChoice::Resemblance}}))
      ->option_text("neighbors|resemblance|frequency|uniform");
  command->add_option("--block", options->block, "blocks: their size in cells, X,Y,Z (10)");
  command->add_option("--rounds", options->model.rounds, "blocks: rounds over all of them")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--budget", options->model.budget,
                   "conflicts that the exact solver may meet in one region")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000000}))
      ->capture_default_str();
  addRequestOptions(*command, *options);
  command
      ->add_option("--frames", options->frames,
                   "the examples are the frames of one that changes over time; make so many of the "
                   "result")
      ->check(CLI::Range(1, 10000));
  command->add_flag("--loop", options->model.loop, "the last frame is followed by the first");
  command->add_flag("--instances", options->instances,
                    "a .glb of model pieces: write each piece once and place it");
  command->add_option("--preview", options->preview, "also write a picture of the result (.png)");
  command->add_option("--report", options->report,
                      "also write a page with surfaces that turn, figures and what shows (.html)");
  command->add_option("--view", options->picture.view, "the picture's view, as in exemplar render")
      ->capture_default_str();
  command->add_option("--picture-size", options->picture.size, "its WIDTHxHEIGHT in pixels")
      ->capture_default_str();
  command->add_option("--samples", options->picture.samples, "its rays a pixel")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  command->add_option("--stats", options->stats, "also write figures of the run (.json)");
  addLabelReadingOptions(*command, options->reading);
  addCommonOptions(*command, options->common);
  return [options] { synth(*options); };
}

bool wantsModelEngine(int argc, const char* const* argv) {
  if (argc < 2 || std::string(argv[1]) != "synth") return false;
  for (int n = 2; n < argc; ++n) {
    const std::string word = argv[n];
    if (word == "--engine" && n + 1 < argc) return std::string(argv[n + 1]) == "model";
    if (word.rfind("--engine=", 0) == 0) return word == "--engine=model";
  }
  // What follows an option is its value, but for those that have none.
  for (int n = 2; n < argc; ++n) {
    const std::string word = argv[n], before = argv[n - 1];
    if (word.empty() || word[0] == '-') continue;
    const bool isValue = before[0] == '-' && before.find('=') == std::string::npos &&
                         before != "-q" && before != "--quiet";
    if (!isValue) return isLabelExample(word);
  }
  return false;
}

}  // namespace exemplar
