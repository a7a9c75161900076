// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

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
    ".txt .vox .vdb .png .obj .ply .stl .off .glb .gltf";

/// Refuses an output whose ending is none of `endings` (".obj .ply"), or whose folder does not
/// exist or cannot be written, before any work is done.
void requireOutput(const std::filesystem::path& path, const std::string& endings);
/// Refuses an output that cannot hold a result of `size` (a picture has one layer) and of so many
/// frames, 0 for one that does not change over time.
void requireOutputFits(const std::filesystem::path& path, Form form, const Vec3i& size, int frames,
                       bool instances);

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

/// Writes a grid of an example's labels in the format of the path's ending.
Written writeLabels(const std::filesystem::path& path, const LabelGrid& grid,
                    const Example& example, const OutputOptions& options = {},
                    const Progress& progress = {});

}  // namespace exemplar
