// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// exemplar world: an example without end, tile by tile.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "apps/command.h"
#include "apps/help.h"
#include "apps/terminal.h"
#include "apps/world_server.h"
#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "core/memory.h"
#include "core/text.h"
#include "engine/json.h"
#include "engine/output.h"
#include "engine/words.h"
#include "engine/world_levels.h"
#include "engine/world_tiles.h"
#include "engine/world_tileset.h"

namespace exemplar {
namespace {

struct Options {
  std::string example, engine, world, tile, region, tilesFile, output, as = "json";
  std::string formats;
  Settings settings;
  int job = 4, lod = 0;
  std::optional<int> side, window, height;
  bool cached = false;
  double remake = 1;
  WorldServerOptions server;
};

World openWorld(const Options& options, Terminal& terminal) {
  return World(options.world, options.cached, terminal.progress().part(0, 0.02));
}

std::string describe(const World& world) {
  const WorldFile& file = world.file();
  const bool heights = world.examples().front().form() == Form::Heights;
  return file.example + ", engine " + file.engine + ", seed " + std::to_string(file.seed) +
         ", tiles of " + std::to_string(file.tile) + " x " + std::to_string(file.tile) +
         (heights ? std::string(" points, and those that they share with the next")
                  : " x " + std::to_string(file.height) + " cells");
}

void init(const Options& options, Terminal& terminal) {
  WorldRequest request{Source(options.example), options.engine, options.settings, options.side,
                       options.window,          options.height};
  if (request.engine == "auto") request.engine.clear();
  const World::Created created = World::create(options.output, request, terminal.progress());
  if (created.outcome != Outcome::Complete) throw Unfinished(created.why);
  for (const std::string& warning : created.warnings) terminal.warn(warning);
  const World& world = *created.world;
  terminal.say("world", options.output + ": " + describe(world));
  if (created.wasThere) {
    terminal.say("there", "it was made before");
    return;
  }
  for (const auto& [label, text] : created.notes) terminal.say(label, text);
  const double cold = created.costs.coldSeconds, warm = created.costs.warmSeconds;
  terminal.say("tiles", readableSeconds(cold) + " for one alone, " + readableSeconds(warm) +
                            " for the next one; a region of 100 x 100 tiles takes about " +
                            readableSeconds(10'000 * warm) + " here");
  terminal.noteFile(worldFilePath(options.output), "world");
}

void tile(const Options& options, Terminal& terminal) {
  const PlanePoint at = parseTile(options.tile);
  const World world = openWorld(options, terminal);
  std::filesystem::path path = options.output;
  if (path.empty()) {
    path = world.tilePath(at, tileEndings(world, options.formats).front());
    std::filesystem::create_directories(path.parent_path());
  } else {
    requireOutput(path, tileEndings(world));
    tileEndings(world, lowerExtension(path));
  }
  world.requireSameBytes(terminal.progress().part(0.02, 0.1));
  const Stopwatch watch;
  const Result made = world.tile(at, terminal.progress().part(0.1, 0.8));
  for (const std::string& warning :
       writeTile(world, at, made, path, terminal.progress().part(0.8, 1)))
    terminal.warn(warning);
  terminal.wrote("tile", path,
                 path.string() + ": " + readableExtent(made) + ", content " +
                     hashText(World::hashOf(made)) + ", in " + readableSeconds(watch.seconds()));
}

/// The tiles of a file: one a line, "I,J", or a range, "I0:I1,J0:J1".
std::vector<PlaneBox> rangesOf(const Options& options) {
  if (options.region.empty() == options.tilesFile.empty())
    throw InputError("say which tiles: --region I0:I1,J0:J1 or --tiles FILE");
  if (!options.region.empty()) return {parseTileRange(options.region)};
  std::vector<PlaneBox> ranges;
  for (const std::string& line : split(readFile(options.tilesFile), '\n')) {
    if (line.empty() || line.front() == '#') continue;
    if (line.find(':') != line.npos) {
      ranges.push_back(parseTileRange(line));
    } else {
      const PlanePoint one = parseTile(line);
      ranges.push_back({one, {one.x + 1, one.y + 1}});
    }
  }
  if (ranges.empty()) throw InputError(options.tilesFile + ": names no tile");
  return ranges;
}

/// Tiles made in the last while, and what that says of those that are left.
class Pace {
 public:
  void made(std::int64_t count) {
    last_.emplace_back(watch_.seconds(), count);
    if (last_.size() > 50) last_.pop_front();
  }
  std::optional<double> perSecond() const {
    if (last_.size() < 2 || last_.back().first <= last_.front().first) return std::nullopt;
    return static_cast<double>(last_.back().second - last_.front().second) /
           (last_.back().first - last_.front().first);
  }

 private:
  Stopwatch watch_;
  std::deque<std::pair<double, std::int64_t>> last_;
};

void make(const Options& options, Terminal& terminal) {
  const std::vector<PlaneBox> ranges = rangesOf(options);
  const World world = openWorld(options, terminal);
  const MakeOptions making{tileEndings(world, options.formats), options.job};
  if (options.lod > 0 && std::ranges::find(making.endings, ".glb") == making.endings.end())
    throw InputError("`lod`: coarser tiles are .glb; add glb to `formats`");
  if (options.lod > 0 && world.examples().front().form() != Form::Heights)
    throw InputError("`lod`: worlds of labels have one level of detail; leave it out");
  Stopwatch watch;
  Pace pace;
  MadeTiles sum;
  const auto count = static_cast<double>(ranges.size());
  for (std::size_t n = 0; n < ranges.size(); ++n) {
    const Progress part =
        terminal.progress().part(0.02 + 0.98 * static_cast<double>(n) / count,
                                 0.02 + 0.98 * static_cast<double>(n + 1) / count);
    const MadeTiles made = makeTiles(
        world, ranges[n], making, [&](const MadeTiles& state) { pace.made(sum.made + state.made); },
        part);
    sum.all += made.all;
    sum.there += made.there;
    sum.made += made.made;
    sum.failed.insert(sum.failed.end(), made.failed.begin(), made.failed.end());
    if (sum.warnings.empty()) sum.warnings = made.warnings;
  }
  std::string text = counted(static_cast<std::size_t>(sum.made), "tile") + " made";
  if (sum.there > 0) text += ", " + withThousands(sum.there) + " were there";
  text += ", in " + readableSeconds(watch.seconds());
  if (const auto speed = pace.perSecond()) {
    char rate[48];
    std::snprintf(rate, sizeof rate, " (%.3g tiles a minute)", 60 * *speed);
    text += rate;
  }
  terminal.say("tiles", text);
  if (options.lod > 0) {
    MadeLevels levels;
    for (const PlaneBox& range : ranges) {
      const MadeLevels made = makeLevels(world, range, options.lod, terminal.progress());
      levels.made += made.made;
      levels.there += made.there;
    }
    terminal.say("levels", counted(static_cast<std::size_t>(levels.made), "coarser tile") +
                               " made, " + withThousands(levels.there) + " were there");
  }
  for (const std::string& warning : sum.warnings) terminal.warn(warning);
  terminal.say("memory", readableBytes(static_cast<double>(peakResidentBytes())) + " at its peak");
  if (sum.failed.empty()) return;
  std::string which;
  for (std::size_t n = 0; n < sum.failed.size() && n < 8; ++n)
    which += (n ? " " : "") + tileText(sum.failed[n].first);
  throw Unfinished(counted(sum.failed.size(), "tile") + " could not be written (" + which +
                   (sum.failed.size() > 8 ? " ..." : "") + "): " + sum.failed.front().second);
}

/// A shell's word.
std::string quoted(const std::string& text) {
  if (text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                             "_-./:,=+") == text.npos &&
      !text.empty())
    return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

void plan(const Options& options, Terminal& terminal) {
  terminal.beQuiet();
  const PlaneBox region = parseTileRange(options.region);
  const World world = openWorld(options, terminal);
  tileEndings(world, options.formats);
  const std::vector<PlaneBox> jobs = jobsOf(region, options.job);
  const auto rest = [&](const std::string& range) {
    return "world make " + quoted(options.world) + " --region " + range + " --formats " +
           quoted(options.formats.empty() ? usualFormat(world) : options.formats) + " --job " +
           std::to_string(options.job) + (options.cached ? " --cache" : "") +
           " --quiet --progress none";
  };
  std::string text;
  if (options.as == "json") {
    Json list = Json::array();
    for (const PlaneBox& job : jobs) {
      const std::string range = tileRangeText(job);
      list.push_back(
          {{"id", range}, {"tiles", job.columns()}, {"command", "exemplar " + rest(range)}});
    }
    text = jsonText(Json{{"world", options.world}, {"region", options.region}, {"jobs", list}}, 1) +
           "\n";
  } else if (options.as == "parallel") {
    for (const PlaneBox& job : jobs) text += "exemplar " + rest(tileRangeText(job)) + "\n";
  } else {
    text = "#!/bin/sh\n#SBATCH --job-name=exemplar-world\n#SBATCH --array=0-" +
           std::to_string(jobs.size() - 1) +
           "\n#SBATCH --requeue\n"
           "# One job a task; a cluster's MaxArraySize (by default 1001) limits the array: plan\n"
           "# larger jobs (--job), or parts of the region.\n"
           "job=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" <<'END'\n";
    for (const PlaneBox& job : jobs) text += tileRangeText(job) + "\n";
    text += "END\n)\nexec exemplar " + rest("\"$job\"") + "\n";
  }
  if (options.output.empty()) {
    terminal.print(text);
  } else {
    writeFile(options.output, text);
    terminal.noteFile(options.output, "plan");
  }
}

void check(const Options& options, Terminal& terminal) {
  const PlaneBox region = parseTileRange(options.region);
  const World world = openWorld(options, terminal);
  const CheckedTiles found =
      checkTiles(world, region, {options.remake}, terminal.progress().part(0.02, 1));
  terminal.say("content", withThousands(found.tiles) + " tiles, " + hashText(found.hash));
  const bool heights = world.examples().front().form() == Form::Heights;
  if (heights) {
    terminal.say("shared", withThousands(found.pairs) + " points of two tiles, " +
                               withThousands(found.violations) + " not at one height");
  } else {
    terminal.say("pairs", withThousands(found.pairs) + " of neighbors, " +
                              withThousands(found.violations) + " that the example does not show");
  }
  terminal.say("files", withThousands(found.files) + ", " + withThousands(found.remade) +
                            " of them made again, " + withThousands(std::ssize(found.different)) +
                            " not the same bytes");
  terminal.say("rims", withThousands(found.rimEdges) + " edges of meshes between tiles, " +
                           withThousands(found.unmatched) + " unmatched");
  if (found.sound()) return;
  throw Unfinished(options.world + ": " +
                   (!found.different.empty()
                        ? found.different.front() + " is not what this machine makes"
                    : found.violations > 0 ? "tiles do not fit each other"
                                           : "meshes of neighboring tiles do not meet"));
}

void exportRegion(const Options& options, Terminal& terminal) {
  const PlaneBox region = parseTileRange(options.region);
  const World world = openWorld(options, terminal);
  requireOutput(options.output, tileEndings(world));
  tileEndings(world, lowerExtension(options.output));
  world.requireSameBytes(terminal.progress().part(0.02, 0.1));
  const Result result = world.tiles(region, terminal.progress().part(0.1, 0.7));
  std::optional<Surface> surface;
  OutputOptions writing{world.examples().front().reading.mesh, false, {}, {}, {}};
  if (needsSurface(options.output, result, writing))
    surface = realize(result, world.examples(), {}, terminal.progress().part(0.7, 0.9));
  const Written written =
      writeResult(options.output, result, world.examples(), surface ? &*surface : nullptr, writing,
                  terminal.progress().part(0.9, 1));
  terminal.wrote(written.label, written.path, written.text);
  for (const std::string& warning : written.warnings) terminal.warn(warning);
}

void index(const Options& options, Terminal& terminal) {
  const World world = openWorld(options, terminal);
  const std::vector<ListedTile> tiles = listTiles(world);
  Json list = Json::array();
  for (const ListedTile& tile : tiles)
    list.push_back({{"tile", {tile.tile.x, tile.tile.y}}, {"endings", tile.endings}});
  const std::filesystem::path path = world.folder() / "index.json";
  const Vec3d size = world.tileSize();
  writeFile(path, jsonText(Json{{"id", hashText(world.file().id())},
                                {"tile_size", {size.x, size.y, size.z}},
                                {"tiles", list}},
                           1) +
                      "\n");
  terminal.wrote("index", path, path.string() + ": " + counted(tiles.size(), "tile"));
  const WrittenTileset tileset = writeTileset(world, tiles);
  if (tileset.tiles == 0) return;
  const std::filesystem::path root = world.folder() / "tileset.json";
  terminal.wrote("tileset", root,
                 root.string() + ": " + withThousands(tileset.tiles) + " tiles in " +
                     counted(static_cast<std::size_t>(tileset.files), "file") + ", 3D Tiles 1.1");
}

void serve(const Options& options, Terminal& terminal) {
  if (!canServe()) serveWorld(World(options.world), {}, {}, {});
  const World world = openWorld(options, terminal);
  serveWorld(
      world, options.server,
      [&](const std::string& address) {
        terminal.wipe();
        terminal.say("serving", options.world + " at " + address + "; Ctrl-C ends it");
        std::fflush(stdout);
      },
      terminal.progress().part(0.02, 1));
}

void addWorld(CLI::App& command, Options& options) {
  command.add_option("WORLD", options.world, "the world's folder")->required();
}
void addRegion(CLI::App& command, Options& options, bool required) {
  CLI::Option* option =
      command
          .add_option("--region", options.region,
                      "the first tile and the one after the last along x and y: 0:16,-4:4")
          ->option_text("I0:I1,J0:J1");
  if (required) option->required();
}
void addFormats(CLI::App& command, Options& options) {
  command
      .add_option("--formats", options.formats,
                  "what tiles are written to: glb,txt,vox,vdb,... (glb; of heights tif)")
      ->option_text("LIST");
}
void addCache(CLI::App& command, Options& options) {
  command.add_flag("--cache", options.cached,
                   "keep windows in the world's folder, for processes that share it");
}
void addJob(CLI::App& command, Options& options) {
  command.add_option("--job", options.job, "tiles along each side that are made together (4)")
      ->check(CLI::Range(1, 64))
      ->option_text("N");
}

void addInit(CLI::App& command, Options& o) {
  command
      .add_option("EXAMPLE", o.example,
                  "a grid of labels, a scene of pieces, a picture, a mesh with a `cell`, or a "
                  "height map")
      ->required();
  command.add_option("-o,--output", o.output, "the world's folder, which is made")->required();
  command
      .add_option("--engine", o.engine, "what makes it (auto: terrain of a height map, else model)")
      ->option_text("auto|model|terrain");
  command.add_option("--tile", o.side, "columns along each side of a tile (72; of heights 256)")
      ->check(CLI::Range(8, kMostTileSide));
  command
      .add_option("--window", o.window, "columns from one window to the next (36; of heights 384)")
      ->check(CLI::Range(12, 1024));
  command.add_option("--height", o.height, "cells (as many as the example has)")
      ->check(CLI::Range(1, 1024));
  SettingOptions settings;
  std::vector<Setting> seed;
  for (const Setting& setting : requestSettings())
    if (setting.key == "seed") seed.push_back(setting);
  settings.add("Request", "", seed);
  settings.add("Reading labels, or a mesh or picture cut into labels", "",
               readingSettings(Form::Labels).settings());
  settings.add("Reading a height map", "", readingSettings(Form::Heights).settings());
  settings.add("Engine model", "", engineNamed("model").settings());
  settings.add("Engine terrain", "", engineNamed("terrain").settings());
  settings.install(command, o.settings);
}
void addServe(CLI::App& command, Options& o) {
  addWorld(command, o);
  command.add_option("--port", o.server.port, "where to listen; 0: any port that is free (8700)")
      ->check(CLI::Range(0, 65535))
      ->option_text("N");
  command
      .add_option("--host", o.server.host,
                  "the address to listen at; others than this machine's own show the "
                  "world to whoever reaches it (127.0.0.1)")
      ->option_text("ADDRESS");
  command
      .add_option("--waiting", o.server.waiting,
                  "how many requests may wait for a tile that is being made (8)")
      ->check(CLI::Range(0, 1000))
      ->option_text("N");
  command
      .add_option("--most", o.server.most,
                  "how many tiles are made, and kept in the world's folder, at most (4096)")
      ->check(CLI::NonNegativeNumber)
      ->option_text("N");
  addCache(command, o);
}

}  // namespace

std::vector<Command> addWorldCommands(CLI::App& app) {
  CLI::App* world = app.add_subcommand("world", "Make an example without end, tile by tile");
  world->require_subcommand(1);
  world->footer(examplesFooter({"world init city -o town", "world tile town 3,-2 -o t.glb",
                                "world make town --region 0:8,0:8 --formats glb",
                                "world check town --region 0:8,0:8"}));
  std::vector<Command> commands;
  const auto add = [&](const char* name, const char* meaning, auto run, auto fill) {
    auto options = std::make_shared<Options>();
    CLI::App* command = world->add_subcommand(name, meaning);
    fill(*command, *options);
    commands.push_back({command, addCommonOptions(*command),
                        [options, run](Terminal& terminal) { run(*options, terminal); }});
  };
  add("init", "Make a world of an example", init, addInit);
  add("tile", "Make one tile, alone", tile, [](CLI::App& command, Options& o) {
    addWorld(command, o);
    command.add_option("TILE", o.tile, "its number along x and y: 3,-2")->required();
    command.add_option("-o,--output", o.output,
                       "the file to write; left out, the tile's own in the world's folder");
    addFormats(command, o);
    addCache(command, o);
  });
  add("make", "Make the tiles of a region that are not there", make,
      [](CLI::App& command, Options& o) {
        addWorld(command, o);
        addRegion(command, o, false);
        command.add_option("--tiles", o.tilesFile,
                           "a file of tiles, I,J, or regions, one a line, in place of --region");
        addFormats(command, o);
        command
            .add_option("--lod", o.lod,
                        "levels of detail of worlds of heights: coarser tiles for tileset.json, "
                        "each of 2 x 2 of the level before (0)")
            ->check(CLI::Range(0, kMostLevels))
            ->option_text("N");
        addJob(command, o);
        addCache(command, o);
      });
  add("plan", "Print the jobs of a region, for a farm", plan, [](CLI::App& command, Options& o) {
    addWorld(command, o);
    addRegion(command, o, true);
    command
        .add_option("--as", o.as,
                    "a job array for sbatch, lines for GNU parallel, or a list for programs (json)")
        ->check(CLI::IsMember({"slurm", "parallel", "json"}))
        ->option_text("slurm|parallel|json");
    command.add_option("-o,--output", o.output, "the file to write; left out, standard output");
    addFormats(command, o);
    addJob(command, o);
    addCache(command, o);
  });
  add("check", "Check that a region's tiles fit, and are what they should be", check,
      [](CLI::App& command, Options& o) {
        addWorld(command, o);
        addRegion(command, o, true);
        command.add_option("--remake", o.remake, "percent of the files to make again (1)")
            ->check(CLI::Range(0.0, 100.0))
            ->option_text("P");
        addCache(command, o);
      });
  add("export", "Write a region as one file", exportRegion, [](CLI::App& command, Options& o) {
    addWorld(command, o);
    addRegion(command, o, true);
    command.add_option("-o,--output", o.output, "the file to write, one that tiles are written to")
        ->required();
    addCache(command, o);
  });
  add("index",
      "List the tiles that are there, in index.json, and those with a .glb in tileset.json", index,
      [](CLI::App& command, Options& o) { addWorld(command, o); });
  add("serve", "Make tiles when they are asked for, and show a page that flies over them", serve,
      addServe);
  return commands;
}

}  // namespace exemplar
