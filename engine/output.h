// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/axes.h"
#include "core/progress.h"
#include "core/warnings.h"
#include "engine/example.h"
#include "engine/realize.h"
#include "engine/result.h"
#include "mesh/mesh_file.h"
#include "preview/render.h"

/// Results as files, by the ending of their name.
namespace exemplar {

/// The endings that a result of a form is written to: ".obj .ply ...".
const char* outputEndings(Form form);
/// The endings that `writeMesh` knows.
inline constexpr const char* kMeshEndings = ".obj .ply .stl .off .glb .gltf";
/// The endings that grids of labels are written to.
inline constexpr const char* kLabelOutputEndings =
    ".txt .vox .vdb .png .tmx .csv .json .obj .ply .stl .off .glb .gltf";

/// Refuses an output whose ending is none of `endings` (".obj .ply"), or whose folder does not
/// exist or cannot be written, before any work is done.
void requireOutput(const std::filesystem::path& path, const std::string& endings);
/// Where a further channel of a map goes beside its first picture: `rust_normal.png`.
std::filesystem::path channelPath(const std::filesystem::path& path, const std::string& channel);
/// Where the nth coarser copy of a mesh goes, from 1: `wall.glb` becomes `wall_lod1.glb`.
std::filesystem::path lodPath(const std::filesystem::path& path, int n);
/// All files with names of their own that writing to the paths may give: with `lods` coarser copies
/// of the meshes, the material library of an `.obj`, and what is beside heights.
std::vector<std::filesystem::path> filesOf(std::span<const std::string> outputs, int lods);
/// Refuses files that would overwrite one another, or one of the `inputs`; each of `files` is one
/// that will be written.
void requireDistinct(std::span<const std::filesystem::path> files,
                     std::span<const std::filesystem::path> inputs);

/// Refuses outputs that would overwrite what a file of the examples names: its library of
/// materials, its pictures. The pictures beside an `.obj` are named after it, and so may be any
/// that begin so.
void requireKept(std::span<const std::string> outputs, int lods, std::span<const Example> examples);

/// Refuses an output that cannot hold instances, or that needs frames where the result has none.
void requireOutputKind(const std::filesystem::path& path, bool hasFrames, bool instances);
/// Refuses an output that cannot hold a result of `size` of an example: a picture has one layer.
void requireOutputFits(const std::filesystem::path& path, const Example& example,
                       const Vec3i& size);

struct OutputOptions {
  MeshFileOptions mesh;
  bool instances = false;  ///< a .glb of model pieces: write each piece once and place it
  RenderOptions picture;   ///< of the frames of a .gif that is not flat
  /// Axes along which a grid tiles: pictures are then the period. `writeResult` takes the result's.
  Axes periodic;
  /// Hears of each file of a sequence of frames, once it is written.
  std::function<void(const std::filesystem::path&)> wrote;
};

/// Whether writing to the path takes the result's surface.
bool needsSurface(const std::filesystem::path& path, const Result& result,
                  const OutputOptions& options);

/// A line for people about what was written.
struct Written {
  std::filesystem::path path;
  std::string label;  ///< "mesh", "field", "heights", "written"
  std::string text;   ///< "out.glb: 12,345 triangles, closed, ..."
  Warnings warnings;  ///< what the format cannot hold
};

/// Writes a complete result in the format of the path's ending, whole or not at all. `surface` is
/// needed where `needsSurface` says so. Frames become NAME_000.txt, ... or one .gif. Throws
/// `InputError` and `Cancelled`.
Written writeResult(const std::filesystem::path& path, const Result& result,
                    std::span<const Example> examples, const Surface* surface,
                    const OutputOptions& options = {}, const Progress& progress = {});

/// Writes the coarser copies of a surface beside a mesh at `path`.
std::vector<Written> writeLods(const std::filesystem::path& path, const Surface& surface,
                               const OutputOptions& options = {}, const Progress& progress = {});

/// Writes the model pieces of an example as a library, a `.glb` of one mesh for each of
/// `pieceForms`, beside a result's cells in `.json` or `.csv`. Throws `InputError` where the
/// example is not made of pieces.
Written writePieceLibrary(const std::filesystem::path& path, const Example& example,
                          const Progress& progress = {});

/// Writes a grid of an example's labels in the format of the path's ending: `.json`, and `.csv`
/// where the example is cut into model pieces, hold what an engine of games places (docs/hosts.md).
Written writeLabels(const std::filesystem::path& path, const LabelGrid& grid,
                    const Example& example, const OutputOptions& options = {},
                    const Progress& progress = {});

}  // namespace exemplar
