// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/example.h"
#include "core/vec.h"
#include "mesh/image.h"
#include "mesh/mesh_health.h"
#include "preview/render.h"

namespace CLI {
class App;
}

namespace exemplar {

/// Runs a command whose options have been parsed. Errors leave it as exceptions.
using CommandRun = std::function<void()>;

/// Each adds one subcommand to the parser and returns what runs it.
CommandRun addSynthCommand(CLI::App& app);
/// `synth` with the options of model synthesis, in place of `addSynthCommand` where the arguments
/// ask for it: by --engine model, or by an example that holds labels.
CommandRun addModelSynthCommand(CLI::App& app);
bool wantsModelEngine(int argc, const char* const* argv);
CommandRun addSdfCommand(CLI::App& app);
CommandRun addMeshCommand(CLI::App& app);
CommandRun addMeasureCommand(CLI::App& app);
CommandRun addRenderCommand(CLI::App& app);
CommandRun addSceneCommand(CLI::App& app);
CommandRun addVoxelizeCommand(CLI::App& app);
CommandRun addInfoCommand(CLI::App& app);
CommandRun addCompareCommand(CLI::App& app);

/// Synthesis that could not be completed: the command answers it with exit status 3.
class Unfinished : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What every command has: `--threads` and `--quiet`.
struct CommonOptions {
  int threads = 0;  ///< 0: all cores
  bool quiet = false;
};
void addCommonOptions(CLI::App& command, CommonOptions& options);

/// Options of reading and sampling an example: `--resolution`, `--padding`, `--up`, ...
void addExampleOptions(CLI::App& command, ExampleOptions& options);
/// `--cell-size` and `--height-scale`: the units of height maps that do not say them.
void addHeightMapOptions(CLI::App& command, std::optional<double>& cellSize,
                         std::optional<double>& heightScale);
/// `--up` alone, for commands that only read or write meshes.
void addUpOption(CLI::App& command, MeshFileOptions& options);

/// Picture options: `--view`, `--size`, `--samples`.
struct PictureOptions {
  std::string view = "iso";
  std::string size = "960x720";
  int samples = 64;
};
void addPictureOptions(CLI::App& command, PictureOptions& options);
RenderOptions renderOptions(const PictureOptions& options);

/// "2,2,1", or "2" for all three; throws `InputError` naming `option` unless each is a positive
/// number.
Vec3d parseTriple(const std::string& text, const std::string& option);

/// The size of an example in `unit`s ("samples"), scaled. Throws `InputError` unless each side has
/// 1 to 32,767 of them.
Vec3i scaledSize(const Vec3i& size, const Vec3d& scale, const std::string& unit);

/// Refuses an output whose ending is none of `endings` (".obj .ply"), or whose folder is not there
/// or not writable, before any work is done.
void requireOutput(const std::filesystem::path& path, const std::string& endings);

/// A mesh to show: a mesh file as it is; any other example contoured, a scene cut to its box.
TriangleMesh loadForPicture(const std::filesystem::path& path, const ExampleOptions& options,
                            const Progress& progress);
/// One picture of several meshes in a row, at one scale, of the size that `options` says for each.
Image8 renderSideBySide(const std::vector<TriangleMesh>& meshes, const RenderOptions& options,
                        const Progress& progress);

/// The endings that `writeMesh` knows, for help and errors.
inline constexpr const char* kMeshEndings = ".obj .ply .stl .off .glb";

/// "128 x 128 x 64 samples".
std::string readableSize(const Vec3i& size);
/// "12,345 triangles, closed, manifold, oriented", with the counts of what is not so.
std::string readableHealth(const MeshHealth& health);

/// Limits the cores that work uses while it lives; 0 for all.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  Control* control_;
};

}  // namespace exemplar
