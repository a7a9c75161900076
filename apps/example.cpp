// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/example.h"

#include <algorithm>
#include <cmath>

#include "apps/command.h"
#include "apps/synth_control.h"
#include "apps/terminal.h"
#include "core/error.h"
#include "core/file.h"
#include "mesh/scene.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/vdb_file.h"

namespace exemplar {
namespace {

constexpr int kDefaultResolution = 64;
constexpr int kDefaultPadding = 4;
/// A mesh thinner than this part of its length, seen from above, is a panel: it is not doubled
/// across its thickness.
constexpr double kPanelThinness = 1.0 / 3;

std::string triangleCount(const TriangleMesh& mesh) {
  return withThousands(static_cast<long long>(mesh.triangles.size())) + " triangles";
}

/// Samples along a scene's longest side: a whole number to each of its cells, where it has any, so
/// that what is equal in the scene is equal in the field.
int usualResolution(const Scene& scene) {
  if (!scene.cell) return scene.resolution;
  const Vec3d size = scene.box.size();
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (size[axis] > size[longest]) longest = axis;
  const int cells =
      std::max(1, static_cast<int>(std::lround(size[longest] / (*scene.cell)[longest])));
  return cells * std::max(1, static_cast<int>(std::lround(1.0 * scene.resolution / cells)));
}

Example loadScene(Example example, const ExampleOptions& options, const Progress& progress) {
  Scene scene = readScene(findScene(example.path.string()), {.seed = options.sceneSeed});
  example.field = meshToSdf(scene.mesh,
                            {.resolution = options.resolution.value_or(usualResolution(scene)),
                             .box = scene.box,
                             .padding = options.padding.value_or(0),
                             .halfWidth = kExampleHalfWidth},
                            progress);
  example.description = "scene " + scene.name + ", " + triangleCount(scene.mesh);
  example.scale = scene.scale;
  example.block = scene.block;
  example.mesh = std::move(scene.mesh);
  return example;
}

Example loadMesh(Example example, const ExampleOptions& options, const Progress& progress) {
  TriangleMesh mesh = readMesh(example.path, options.mesh);
  const int resolution = options.resolution.value_or(kDefaultResolution);
  const int padding = options.padding.value_or(kDefaultPadding);
  const Vec3d size = boundingBox(mesh).size();
  // The margin is part of the resolution, so that `--resolution` tells the field's longest side.
  const int inner = std::max(1, resolution - 2 * padding);
  example.field = meshToSdf(mesh,
                            {.voxelSize = std::max({size.x, size.y, size.z}) / inner,
                             .padding = padding,
                             .halfWidth = kExampleHalfWidth},
                            progress);
  if (size.x < kPanelThinness * size.y) example.scale.x = 1;
  if (size.y < kPanelThinness * size.x) example.scale.y = 1;
  example.description = "mesh of " + triangleCount(mesh);
  example.mesh = std::move(mesh);
  return example;
}

Example loadHeightMap(Example example, const ExampleOptions& options, const Progress&) {
  example.heights.cellSize = options.cellSize;
  example.heights.heightScale = options.heightScale.value_or(example.heights.heightScale);
  const HeightMap map = readHeightMap(example.path, example.heights);
  example.field =
      heightMapToSdf(map, {.resolution = options.resolution.value_or(kDefaultResolution),
                           .halfWidth = kExampleHalfWidth});
  example.description =
      "height map of " + withThousands(map.width) + " x " + withThousands(map.height) + " points";
  return example;
}

Example loadVolume(Example example, const ExampleOptions&, const Progress&) {
  example.field = readVdb(example.path, &example.wraps);
  example.scale = {2, 2, 2};
  const auto& [x, y, z] = example.wraps;
  example.description = "volume";
  if (x || y || z) example.description += " that tiles along " + readableAxes(x, y, z);
  return example;
}

}  // namespace

bool isExampleFile(const std::filesystem::path& path) {
  const std::string ending = lowerExtension(path);
  return isMeshFile(path) || isHeightMapFile(path) || ending == ".vdb" || ending == ".toml";
}

Example loadExample(const std::filesystem::path& path, const ExampleOptions& options,
                    const Progress& progress) {
  if (!isExampleFile(path)) {
    throw InputError(path.string() + ": not a kind of example; use " + std::string(kMeshEndings) +
                     " .vdb .png .pgm .asc or .toml");
  }
  progress.report("reading " + path.string(), 0);
  Example example;
  example.path = path;
  if (isMeshFile(path)) {
    example.kind = ExampleKind::Mesh;
    example = loadMesh(std::move(example), options, progress);
  } else if (isHeightMapFile(path)) {
    example.kind = ExampleKind::HeightMap;
    example = loadHeightMap(std::move(example), options, progress);
  } else if (lowerExtension(path) == ".vdb") {
    example.kind = ExampleKind::Volume;
    example = loadVolume(std::move(example), options, progress);
  } else {
    example.kind = ExampleKind::Scene;
    example = loadScene(std::move(example), options, progress);
  }
  example.description += " at " + readableSize(example.field.size());
  return example;
}

}  // namespace exemplar
