// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// A parametric example: what a scene file (`scenes/NAME.toml`) describes, made.
///
/// The geometry reaches past `box` on the sides where the material goes on, so that what is sampled
/// inside `box` is a window into something larger and the window's faces cut nothing that was not
/// already there.
struct Scene {
  std::string name;
  TriangleMesh mesh;
  Box3d box;             ///< the example: sample here
  int resolution = 64;   ///< samples along the box's longest side
  Vec3d scale{2, 2, 1};  ///< the size of a result, in boxes
  int block = 16;        ///< block size at the finest level, in samples
  /// For a scene made of model pieces: the side of their cells, which fill the box exactly.
  std::optional<Vec3d> cell;
};

struct SceneOptions {
  /// Replaces the file's seed: another sample of the same process.
  std::optional<std::uint64_t> seed;
  /// Multiplies the box: a larger sample of the same process. Components >= 1.
  Vec3d extent{1, 1, 1};
};

/// Makes a scene from its file. Kinds: chainmail, fibers, metal, grid, balls, terrain, grass,
/// bricks, scales, bark, and, made of model pieces, castle, city, canyon, cluster, paths, gears, forest, library (each file
/// states its parameters, all with units and ranges; an unknown key is an error). The same
/// file and options give the same scene, to the byte. Throws `InputError` naming file, line and
/// key, and `Cancelled`.
Scene readScene(const std::filesystem::path& path, const SceneOptions& options = {},
                const Progress& progress = {});

/// The same from the bytes of a scene file; `name` is what errors call it, and names the scene.
Scene readScene(std::string_view bytes, const std::string& name, const SceneOptions& options,
                const Progress& progress = {});

/// Whether a scene file's kind is one that is made of model pieces. False where it cannot be read.
bool isPieceScene(const std::filesystem::path& path);

/// The bundled scene file called `name` ("chainmail", "chainmail.toml" or "scenes/chainmail.toml",
/// where there is no such file), or a path as it is. Looks in the folder that EXEMPLAR_SCENES
/// names, beside the program, in the source tree and in the installed share folder. Throws
/// `InputError` listing the bundled names.
std::filesystem::path findScene(const std::string& name);

/// The names of the bundled scenes, sorted.
std::vector<std::string> bundledScenes();

}  // namespace exemplar
