// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/source.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "mesh/mesh_file.h"
#include "mesh/scene.h"
#include "mesh/svg_file.h"
#include "sdf/vdb_file.h"
#include "synth/continuous/flat.h"
#include "synth/continuous/synthesize.h"
#include "voxelize/label_file.h"
#include "voxelize/volume_scene.h"

namespace exemplar {
namespace {

/// A source's content as one type, or what it should have been.
template <class T>
const T& held(const Source& source, const char* what) {
  if (const T* content = source.inMemory<T>()) return *content;
  throw InputError(source.name() + ": expected " + what);
}

bool isFile(const Source& source) {
  return !source.inMemory<TriangleMesh>() && !source.inMemory<DistanceField>() &&
         !source.inMemory<LabelGrid>() && !source.inMemory<HeightMap>();
}

/// The text of a scene, which may be a bundled one.
std::string sceneText(const Source& source) {
  if (const std::string* bytes = source.inMemory<std::string>()) return *bytes;
  return readFile(findScene(source.name()));
}

/// Whether a .toml is a scene of solids; where it cannot be read, reading it as another one says
/// so.
bool isSolids(const Source& source) {
  try {
    return continuous::isSolidScene(sceneText(source));
  } catch (const InputError&) {
    return false;
  }
}

/// Whether a .toml is a scene of a volume of labels; the same.
bool isVolume(const Source& source) {
  try {
    return isVolumeScene(sceneText(source));
  } catch (const InputError&) {
    return false;
  }
}

/// Whether a .vdb holds labels; where it is neither, reading it as distances says what is wrong.
bool holdsLabels(const std::filesystem::path& path) {
  try {
    readLabelsVdb(path);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

Source::Source(const std::filesystem::path& path) : path_(path) {
  // A folder of that name hides no scene; worlds are called after what they are made of.
  std::error_code error;
  if (path.empty() || path.has_extension() || path.has_parent_path() ||
      (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error)))
    return;
  const std::vector<std::string> scenes = bundledScenes();
  if (std::ranges::find(scenes, path.string()) != scenes.end()) path_ += ".toml";
}

SourceKind sourceKind(const Source& source) {
  if (source.inMemory<TriangleMesh>()) return SourceKind::Mesh;
  if (source.inMemory<DistanceField>()) return SourceKind::Volume;
  if (source.inMemory<LabelGrid>()) return SourceKind::Labels;
  if (source.inMemory<HeightMap>()) return SourceKind::HeightMap;
  const std::filesystem::path& path = source.path();
  const std::string ending = lowerExtension(path);
  if (isMeshFile(path)) return SourceKind::Mesh;
  if (isHeightMapFile(path)) return SourceKind::HeightMap;
  if (isLabelFile(path)) return SourceKind::Labels;
  if (ending == ".jpg" || ending == ".jpeg") return SourceKind::Picture;
  if (isDrawingFile(path)) return SourceKind::Solids;
  if (source.inMemory<std::string>() && ending == ".vdb")
    throw InputError(source.name() + ": a .vdb is read from a file, not from bytes");
  if (ending == ".toml" && isSolids(source)) return SourceKind::Solids;
  if (ending == ".toml" && isVolume(source)) return SourceKind::Labels;
  if (source.inMemory<std::string>() && ending == ".toml") {
    const Scene scene = readScene(*source.inMemory<std::string>(), source.name(), {});
    return scene.cell ? SourceKind::Pieces : SourceKind::Scene;
  }
  if (ending == ".toml") return isPieceScene(path) ? SourceKind::Pieces : SourceKind::Scene;
  if (ending == ".vdb") return holdsLabels(path) ? SourceKind::Labels : SourceKind::Volume;
  const std::string scene = ending.empty() ? nearestName(source.name(), bundledScenes()) : "";
  throw InputError(source.name() + ": not a kind of example; use " + kExampleEndings +
                   (scene.empty() ? "" : ", or the scene " + scene));
}

void requireThere(const Source& source) {
  if (!isFile(source) || source.inMemory<std::string>()) return;
  std::error_code error;
  if (std::filesystem::is_directory(source.path(), error))
    throw InputError(source.name() + ": is a folder, not a file");
  // Bundled scenes are found by their names.
  if (lowerExtension(source.path()) == ".toml") {
    findScene(source.name());
  } else if (!std::filesystem::exists(source.path(), error)) {
    throw InputError(source.name() + ": no such file");
  }
}

TriangleMesh readTriangles(const Source& source, const MeshFileOptions& options,
                           const Progress& progress) {
  if (!isFile(source)) return held<TriangleMesh>(source, "triangles");
  if (sourceKind(source) == SourceKind::Solids) {
    const continuous::SolidScene scene = readSolids(source);
    return continuous::triangulate(continuous::polygonsOf(scene.solids, scene.looks, progress));
  }
  if (const std::string* bytes = source.inMemory<std::string>())
    return readMesh(*bytes, source.name(), options, progress);
  return readMesh(source.path(), options, progress);
}

continuous::SolidScene readSolids(const Source& source, std::optional<double> unit,
                                  Warnings* warnings) {
  if (isDrawingFile(source.path())) {
    return continuous::solidsOfDrawing(readDrawing(readBytes(source), source.name(), warnings),
                                       source.name(), unit, warnings);
  }
  return continuous::readSolidScene(sceneText(source), source.name());
}

DistanceField readDistances(const Source& source, const ReadVdbOptions& options, Axes* wraps,
                            const Progress& progress) {
  if (!isFile(source)) return held<DistanceField>(source, "distances");
  return readVdb(source.path(), options, wraps, progress);
}

LabelGrid readLabelGrid(const Source& source, const Progress& progress) {
  if (!isFile(source)) return held<LabelGrid>(source, "labels");
  if (lowerExtension(source.path()) == ".toml")
    return readVolumeScene(sceneText(source), source.path().stem().string(), progress);
  if (isTiledFile(source.path())) return readTiles(source, progress).grid;
  if (const std::string* bytes = source.inMemory<std::string>()) {
    return lowerExtension(source.path()) == ".vox"
               ? parseVox(*bytes, source.name())
               : parseLabelText(*bytes, source.name(), progress);
  }
  return readLabels(source.path(), progress);
}

TiledMap readTiles(const Source& source, const Progress& progress) {
  const std::string* bytes = source.inMemory<std::string>();
  if (!bytes) return readTiledMap(source.path(), progress);
  return lowerExtension(source.path()) == ".csv" ? parseTileRows(*bytes, source.name(), progress)
                                                 : parseTiledMap(*bytes, source.name(), progress);
}

HeightMap readHeights(const Source& source, const HeightMapFileOptions& options,
                      const Progress& progress) {
  if (!isFile(source)) return held<HeightMap>(source, "heights");
  if (const std::string* bytes = source.inMemory<std::string>())
    return readHeightMap(*bytes, source.name(), options, progress);
  return readHeightMap(source.path(), options, progress);
}

std::string readBytes(const Source& source) {
  if (const std::string* bytes = source.inMemory<std::string>()) return *bytes;
  return readFile(source.path());
}

}  // namespace exemplar
