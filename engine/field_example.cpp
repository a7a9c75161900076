// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as signed distances.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "engine/example_forms.h"
#include "engine/mesh_field.h"
#include "engine/words.h"
#include "mesh/scene.h"
#include "sdf/height_map.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/vdb_file.h"
#include "synth/geometry/detail.h"

namespace exemplar {
namespace {

constexpr int kDefaultResolution = 64;

std::string triangleCount(const TriangleMesh& mesh) {
  return withThousands(static_cast<long long>(mesh.triangles.size())) + " triangles";
}

/// Samples along a scene's longest side, with the same voxels however large a sample of it is: a
/// whole number to each of its cells, where it has any, so that what is equal in the scene is equal
/// in the field.
int usualResolution(const Scene& scene, const Vec3d& extent) {
  const Vec3d size = scene.box.size();
  int longest = 0;
  double base = 0;  // the longest side of one box
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] > size[longest]) longest = axis;
    base = std::max(base, size[axis] / extent[axis]);
  }
  if (!scene.cell) return static_cast<int>(std::lround(scene.resolution * size[longest] / base));
  const int cells =
      std::max(1, static_cast<int>(std::lround(size[longest] / (*scene.cell)[longest])));
  const double wanted = scene.resolution * size[longest] / base;
  return cells * std::max(1, static_cast<int>(std::lround(wanted / cells)));
}

void sampleScene(Example& example, const Progress& progress) {
  const ReadOptions& options = example.reading;
  Scene scene = readSceneOf(example.source, options, progress.part(0, 0.2));
  const Vec3d extent = options.sceneExtent.value_or(Vec3d{1, 1, 1});
  example.data =
      meshToSdf(scene.mesh,
                {.resolution = options.resolution.value_or(usualResolution(scene, extent)),
                 .box = scene.box,
                 .padding = options.padding.value_or(0),
                 .halfWidth = kExampleHalfWidth},
                progress.part(0.2, 1));
  example.description = "scene " + scene.name + ", " + triangleCount(scene.mesh);
  example.hints = {scene.scale, scene.block};
  example.mesh = std::move(scene.mesh);
}

void readMeshField(Example& example, const Progress& progress) {
  sampleMesh(readTriangles(example.source, meshReading(example), progress.part(0, 0.2)), example,
             progress.part(0.2, 1));
}

void sampleHeights(Example& example, const Progress& progress) {
  const ReadOptions& options = example.reading;
  HeightMap map = readHeights(example.source,
                              {.cellSize = options.cellSize,
                               .heightScale = options.heightScale,
                               .warnings = &example.warnings},
                              progress.part(0, 0.3));
  if (const std::size_t holes = fillHoles(map.heights); holes > 0) {
    example.warnings.push_back(example.name() + ": filling " + counted(holes, "cell") +
                               " without data from their neighbors");
  }
  example.heightSteps = map.steps;
  example.data = heightMapToSdf(map,
                                {.resolution = options.resolution.value_or(kDefaultResolution),
                                 .halfWidth = kExampleHalfWidth},
                                progress.part(0.3, 1));
  example.description = "height map of " + withThousands(map.width()) + " x " +
                        withThousands(map.height()) + " points";
}

void takeVolume(Example& example, const Progress& progress) {
  example.data = readDistances(example.source,
                               {.grid = example.reading.grid,
                                .warnings = &example.warnings,
                                .turn = &example.turn,
                                .yUp = example.reading.mesh.up == UpAxis::Y},
                               &example.continues, progress);
  example.hints.scale = {2, 2, 2};
  example.description = "volume";
  if (example.continues.any())
    example.description += " that tiles along " + readableAxes(example.continues);
}

}  // namespace

void readAsField(Example& example, const Progress& progress) {
  switch (example.kind) {
    case SourceKind::Mesh:
    case SourceKind::Solids:
      readMeshField(example, progress);
      break;
    case SourceKind::HeightMap:
      sampleHeights(example, progress);
      break;
    case SourceKind::Scene:
    case SourceKind::Pieces:
      sampleScene(example, progress);
      break;
    case SourceKind::Volume:
      takeVolume(example, progress);
      break;
    case SourceKind::Labels:
    case SourceKind::Picture:
      throw InputError(example.name() +
                       ": a grid of labels, where distances are needed (of a mesh, a volume or a "
                       "height map); the engine "
                       "model takes labels");
  }
  example.description += " at " + readableSize(example.field().size(), "samples");
}

void sampleAlike(Example& example, const Example& first, const Progress& progress) {
  const double voxel = first.field().voxelSize;
  if (example.mesh) {
    const bool window = example.kind != SourceKind::Mesh;
    const Box3d box = window ? example.field().box() : boundingBox(*example.mesh);
    Padding padding = window ? example.reading.padding.value_or(0) : example.padding;
    // Beside a window into something larger, it is one, too.
    if (!window && first.kind != SourceKind::Mesh && !example.reading.padding) padding = 0;
    example.data = sampledMesh(example, voxel, box, padding, progress);
  } else if (std::abs(example.field().voxelSize / voxel - 1) > 1e-3) {
    throw InputError(example.name() + " has voxels of " + numberText(example.field().voxelSize) +
                     ", not of " + numberText(voxel) + " as " + first.name() +
                     "; sample them alike");
  }
}

std::vector<Example> refined(std::span<const Example> examples, int factor,
                             const Progress& progress) {
  std::vector<Example> finer(examples.begin(), examples.end());
  for (Example& example : finer) {
    const DistanceField& coarse = example.field();
    DistanceField fine;
    if (example.mesh) {
      fine = sampledMesh(example, coarse.voxelSize / factor, coarse.box(), 0, progress);
    } else if (example.kind == SourceKind::HeightMap) {
      ReadOptions options = example.reading;
      const Vec3i n = coarse.size();
      options.resolution = factor * std::max({n.x, n.y, n.z});
      fine = readExample(example.source, options, progress).field();
    } else {
      throw InputError("`detail`: " + example.name() +
                       " is a volume, which has no finer samples; give the mesh that it was made "
                       "of");
    }
    example.data = fine.size() == coarse.size() * factor ? std::move(fine)
                                                         : sampledFinely(fine, coarse, factor);
  }
  return finer;
}

}  // namespace exemplar
