// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar info: what an example holds, and what model synthesis learns from it.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/command.h"
#include "apps/help.h"
#include "core/file.h"
#include "core/json_text.h"
#include "engine/described.h"
#include "engine/json.h"
#include "engine/model_request.h"
#include "engine/output.h"
#include "engine/realize.h"
#include "engine/words.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "synth/model/infallible.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, json;
  bool list = false;
  Settings settings;
};

/// Regions that are looked at in search of a proof.
constexpr std::int64_t kMostRegions = 200'000;

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, share < 0.01 ? "%.2g %%" : "%.1f %%", 100 * share);
  return text;
}

/// What the example is as distances, or as cells that are not empty.
Json natureInfo(const Example& example, Terminal& terminal) {
  const DescribedExample described = describe(example);
  for (const auto& [label, text] : readable(described, example.form())) terminal.say(label, text);
  const ExampleNature& nature = described.nature;
  Json json{{"size", toJson(nature.size)},          {"cell", described.cell},
            {"solid_share", nature.solidShare},     {"solid_from", toJson(nature.solid.begin)},
            {"solid_to", toJson(nature.solid.end)}, {"free_standing", nature.freeStanding()}};
  const char* names[] = {"-x", "+x", "-y", "+y", "-z", "+z"};
  for (std::size_t side = 0; side < 6; ++side) {
    const BoxSide kind = nature.sides[side];
    json["sides"][names[side]] = {{"kind", kind == BoxSide::Air   ? "air"
                                           : kind == BoxSide::Cut ? "cut"
                                                                  : "solid"},
                                  {"solid_share", nature.atSides[side]}};
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Json& along = json["axes"][std::string(1, "xyz"[axis])];
    along["quarters"] = nature.quarters[axis];
    along["fills_evenly"] = nature.fillsEvenly[static_cast<int>(axis)];
    if (example.form() != Form::Field) continue;
    along["stationary"] = described.stationary[static_cast<int>(axis)];
    along["why"] = described.why[axis];
  }
  return json;
}

/// The same of what is read as distances.
Json fieldInfo(const Options& options, Terminal& terminal) {
  const Example example = readExample(options.example, readingOf(options.settings, Form::Field),
                                      terminal.progress().part(0, 0.5));
  for (const std::string& warning : example.warnings) terminal.warn(warning);
  terminal.say("example", options.example + ": " + example.description);
  return natureInfo(example, terminal);
}

/// A mesh without cells to cut it along: what is sound about it.
Json meshInfo(const Options& options, Terminal& terminal) {
  const TriangleMesh mesh =
      readMesh(options.example, readingOf(options.settings, Form::Labels).mesh);
  const MeshHealth health = meshHealth(mesh);
  const Vec3d size = boundingBox(mesh).size();
  char box[96];
  std::snprintf(box, sizeof box, "%.6g x %.6g x %.6g", size.x, size.y, size.z);
  terminal.say("mesh", options.example + ": " + readableHealth(health));
  terminal.say("box", box);
  terminal.say("materials", withThousands(static_cast<long long>(mesh.materials.size())));
  terminal.say("pieces", "give --cell S to see the model pieces that a grid cuts it into");
  return {{"triangles", health.triangles},      {"closed", health.closed()},
          {"manifold", health.manifold()},      {"size", {size.x, size.y, size.z}},
          {"materials", mesh.materials.size()}, {"distances", fieldInfo(options, terminal)}};
}

/// Whether plain propagation can fail on the example's rules, as far as that can be proved.
void reportProof(const Adjacency& adjacency, Terminal& terminal, Json& json) {
  terminal.progress().report("looking for a proof that propagation cannot fail", 0.5);
  const RuleSummary rules =
      summarizeRules(adjacency, kMostRegions, terminal.progress().part(0.5, 1));
  const Vec3i r = rules.proof.region;
  const std::string region = std::to_string(r.x) + " x " + std::to_string(r.y) + " x " +
                             std::to_string(r.z) + " cells (" + withThousands(rules.proof.regions) +
                             " looked at)";
  std::string text = "not proved infallible";
  if (rules.statement311) {
    text = "infallible: statement 3.11 holds, so plain propagation in column order never fails";
  } else if (rules.infallible()) {
    text = "infallible, proved by Algorithm 3.6 with regions of " + region;
  } else if (rules.proof.verdict == InfallibleProof::Verdict::TooMany) {
    text += ": there are too many regions of " + region;
  } else {
    text += ": statement 3.11 does not hold, nor do regions of " + region + " prove it";
  }
  terminal.say("propagation", text);
  json["statement_3_11"] = rules.statement311;
  json["infallible"] = rules.infallible();
  json["proof_regions"] = rules.proof.regions;
}

Json labelInfo(const Options& options, Terminal& terminal) {
  const Example example = readExample(options.example, readingOf(options.settings, Form::Labels),
                                      terminal.progress().part(0, 0.5));
  for (const std::string& warning : example.warnings) terminal.warn(warning);
  const LabelGrid& grid = example.labels();
  const Adjacency adjacency = adjacencyOf({&example, 1});
  terminal.say("example", options.example + ": " + example.description);

  const auto cells = static_cast<double>(grid.cells.count());
  std::int64_t empty = 0, used = 0, single = 0;
  for (int label = 0; label < grid.labelCount(); ++label) {
    const std::int64_t n = adjacency.frequency[label];
    if (isEmpty(grid.labels[label])) empty += n;
    used += n > 0;
    single += n == 1;
  }
  terminal.say("labels", withThousands(used) + " that cells have, " + withThousands(single) +
                             " of them once; " + percent(static_cast<double>(empty) / cells) +
                             " of the cells are empty");
  Json json{{"size", toJson(grid.size())},
            {"labels", grid.labelCount()},
            {"labels_used", used},
            {"labels_used_once", single},
            {"empty_share", static_cast<double>(empty) / cells}};

  if (grid.size().z > 1) json["cells"] = natureInfo(example, terminal);

  // How many of all ordered pairs of labels the example allows: the fewer, the more is decided.
  const char* axes[] = {"x", "y", "z"};
  Json density;
  std::string text;
  const double pairs = static_cast<double>(used) * static_cast<double>(used);
  for (int axis = 0; axis < 3; ++axis) {
    const double share = static_cast<double>(adjacency.rules[axis].pairs.size()) / pairs;
    density[axes[axis]] = share;
    text += std::string(axis ? ", " : "") + axes[axis] + " " + percent(share) + " (" +
            withThousands(static_cast<long long>(adjacency.rules[axis].pairs.size())) + " pairs)";
  }
  terminal.say("adjacency", text);
  json["adjacency_density"] = density;
  reportProof(adjacency, terminal, json);
  if (const auto* pieces = std::get_if<ModelPieces>(&example.content)) {
    const ModelPieces& p = *pieces;
    const auto images = [&](const std::vector<Label>& of) {
      return std::count_if(of.begin(), of.end(), [](Label l) { return l != ModelPieces::kNone; });
    };
    terminal.say("mirrors", withThousands(images(p.mirroredX)) +
                                " labels have a mirror image in x, " +
                                withThousands(images(p.mirroredY)) + " in y, " +
                                withThousands(images(p.turned)) + " are there a quarter turned");
    json["mirrored_x"] = images(p.mirroredX);
    json["mirrored_y"] = images(p.mirroredY);
    json["turned"] = images(p.turned);
    json["piece_triangles"] = p.mesh.triangles.size();
  }
  if (options.list) {
    for (int label = 0; label < grid.labelCount(); ++label) {
      terminal.say("label " + std::to_string(label),
                   withThousands(adjacency.frequency[label]) + " cells" +
                       (grid.labels[label].name.empty() ? "" : ", " + grid.labels[label].name));
    }
  }
  Json labels = Json::array();
  for (int label = 0; label < grid.labelCount(); ++label) {
    labels.push_back({{"name", grid.labels[label].name}, {"cells", adjacency.frequency[label]}});
  }
  json["label_list"] = std::move(labels);
  return json;
}

void info(const Options& options, Terminal& terminal) {
  const bool print = options.json == "-";
  if (print) terminal.beQuiet();
  if (!options.json.empty() && !print) requireOutput(options.json, ".json");
  const SourceKind kind = sourceKind(options.example);
  const bool cut = options.settings.has("cell") || options.settings.has("field-block");
  Json json;
  if (kind == SourceKind::Mesh && !cut) {
    json = meshInfo(options, terminal);
  } else {
    // What synthesis takes as distances is described as such first.
    const bool distances =
        kind == SourceKind::Scene || kind == SourceKind::Volume || kind == SourceKind::HeightMap;
    if (distances) json["distances"] = fieldInfo(options, terminal);
    json.update(labelInfo(options, terminal));
  }
  const std::string text = jsonText(json, 2) + "\n";
  if (print) {
    std::fputs(text.c_str(), stdout);
  } else if (!options.json.empty()) {
    writeFile(options.json, text);
    terminal.noteFile(options.json, "info");
  }
}

}  // namespace

Command addInfoCommand(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("info",
                         "Report what an example is: its box, solid, sides, along which "
                         "axes its parts may move, its labels and their neighbors");
  command
      ->add_option("EXAMPLE", options->example,
                   "any example: a mesh, a volume, a height map, a scene, a label grid, a picture")
      ->required();
  command->add_flag("--list", options->list, "list every label with its number of cells");
  command->add_option("--json", options->json, "write it to this .json; - prints it");
  addReadingOptions(*command, Form::Labels, options->settings);
  command->footer(examplesFooter({"info wall.obj", "info castle --list", "info map.tmx"}));
  return {command, addCommonOptions(*command),
          [options](Terminal& terminal) { info(*options, terminal); }};
}

}  // namespace exemplar
