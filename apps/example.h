// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "core/progress.h"
#include "mesh/mesh_file.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"
#include "sdf/height_map.h"

namespace exemplar {

/// What `exemplar` takes as an example, by the ending of its file.
enum class ExampleKind { Mesh, Volume, HeightMap, Scene };

/// How an example is read and sampled. Left out, the kind of example decides.
struct ExampleOptions {
  std::optional<int> resolution;           ///< samples along the longest side, 4..4096
  std::optional<int> padding;              ///< voxels of air around a mesh, 0..1024
  std::optional<std::uint64_t> sceneSeed;  ///< another sample of a scene's process
  MeshFileOptions mesh;
  std::optional<double> cellSize;     ///< world distance of a height map's points, > 0
  std::optional<double> heightScale;  ///< world height of one step of its integers, > 0
};

/// An example, read and sampled: the beginning of the main path.
struct Example {
  std::filesystem::path path;
  ExampleKind kind = ExampleKind::Mesh;
  std::string description;           ///< for people: "mesh of 23,952 triangles"
  DistanceField field;               ///< truncated at `kExampleHalfWidth` voxels
  std::optional<TriangleMesh> mesh;  ///< where materials and colours come from
  Vec3d scale{2, 2, 1};              ///< a good size of a result, in boxes of the example
  int block = 16;                    ///< a good block size at the finest level, samples
  std::array<bool, 3> wraps{};       ///< along which axes a volume goes round and tiles
  HeightMapFileOptions heights;      ///< the units that a height map had, to write one alike
};

/// How far from the surface an example's distances are exact, in voxels. Matching truncates
/// further.
inline constexpr double kExampleHalfWidth = 16;

/// Whether the path's ending names something that `loadExample` reads.
bool isExampleFile(const std::filesystem::path& path);

/// Reads `.obj .ply .stl .off .glb`, `.vdb`, `.png .pgm .asc` or a scene `.toml`, and samples it as
/// a signed distance field. A mesh gets a margin of air, because an object ends at its box; a scene
/// and a volume are windows into something larger, and get none. Throws `InputError`.
Example loadExample(const std::filesystem::path& path, const ExampleOptions& options,
                    const Progress& progress);

}  // namespace exemplar
