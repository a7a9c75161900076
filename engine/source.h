// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "core/axes.h"
#include "core/progress.h"
#include "core/warnings.h"
#include "maps/height_map_file.h"
#include "mesh/mesh_file.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"
#include "sdf/vdb_file.h"
#include "synth/continuous/solid_scene.h"
#include "voxelize/label_grid.h"
#include "voxelize/tiled_map.h"

namespace exemplar {

/// Where an example, a solid or a guide comes from: a file, the bytes of one, or what is in memory.
/// Copies share what they hold.
class Source {
 public:
  using Content =
      std::variant<std::monostate, std::string, TriangleMesh, DistanceField, LabelGrid, HeightMap>;

  Source() = default;
  /// A file, or a bundled scene: "chainmail", which counts as "chainmail.toml" where no file
  /// (a folder is none) is called so.
  Source(const std::filesystem::path& path);
  Source(const char* path) : Source(std::filesystem::path(path)) {}
  Source(const std::string& path) : Source(std::filesystem::path(path)) {}
  /// What a file of this name would hold; the ending says the format, any but .vdb.
  static Source ofBytes(std::string bytes, std::filesystem::path name) {
    return Source(std::move(name), Content(std::move(bytes)));
  }
  /// Triangles, distances, labels or heights; `name` is for messages.
  static Source of(TriangleMesh mesh, std::filesystem::path name = "mesh") {
    return Source(std::move(name), Content(std::move(mesh)));
  }
  static Source of(DistanceField field, std::filesystem::path name = "field") {
    return Source(std::move(name), Content(std::move(field)));
  }
  static Source of(LabelGrid grid, std::filesystem::path name = "labels") {
    return Source(std::move(name), Content(std::move(grid)));
  }
  static Source of(HeightMap map, std::filesystem::path name = "heights") {
    return Source(std::move(name), Content(std::move(map)));
  }

  const std::filesystem::path& path() const { return path_; }
  std::string name() const { return path_.string(); }
  /// What is in memory, or null where it is a file or of another type.
  template <class T>
  const T* inMemory() const {
    return content_ ? std::get_if<T>(content_.get()) : nullptr;
  }

 private:
  Source(std::filesystem::path path, Content content)
      : path_(std::move(path)), content_(std::make_shared<const Content>(std::move(content))) {}

  std::filesystem::path path_;
  std::shared_ptr<const Content> content_;
};

/// What a source holds.
enum class SourceKind {
  Mesh,       ///< .obj .ply .stl .off .glb .gltf
  Scene,      ///< .toml: a process that makes a mesh
  Pieces,     ///< .toml: a scene made of model pieces on a grid
  Solids,     ///< .toml: a scene of solids between planes; .svg: a drawing
  Volume,     ///< .vdb of signed distances
  HeightMap,  ///< .asc .tif .exr .png .pgm .r16 .raw
  Labels,     ///< .txt .vox .tmx .csv, .vdb of labels
  Picture,    ///< .jpg; a .png, too, where labels are asked for
};

/// What the source holds, by its ending; scenes and .vdb files are looked into. Throws `InputError`
/// where it is no kind of example, or cannot be read.
SourceKind sourceKind(const Source& source);

/// Throws `InputError` where the source is a file that is not there, or is a folder.
void requireThere(const Source& source);

/// The endings of examples, for help and errors.
inline constexpr const char* kExampleEndings =
    ".obj .ply .stl .off .glb .gltf .vdb .png .pgm .asc .tif .exr .r16 .raw .txt .vox .tmx .csv "
    ".jpg "
    ".svg or .toml";

/// Read what a source holds. Throw `InputError` naming it, and `Cancelled`.
TriangleMesh readTriangles(const Source& source, const MeshFileOptions& options,
                           const Progress& progress = {});
/// A scene, or a drawing, whose grid may be given.
continuous::SolidScene readSolids(const Source& source, std::optional<double> unit = {},
                                  Warnings* warnings = nullptr);
DistanceField readDistances(const Source& source, const ReadVdbOptions& options = {},
                            Axes* wraps = nullptr, const Progress& progress = {});
LabelGrid readLabelGrid(const Source& source, const Progress& progress = {});
/// A .tmx or .csv, with what a map is written from.
TiledMap readTiles(const Source& source, const Progress& progress = {});
HeightMap readHeights(const Source& source, const HeightMapFileOptions& options,
                      const Progress& progress = {});
/// The bytes of a file.
std::string readBytes(const Source& source);

}  // namespace exemplar
