// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <span>

#include "core/progress.h"
#include "mesh/mesh_file.h"

namespace exemplar {

/// Writes a part of a larger mesh as `.glb` or `.gltf`, with the unit normal of each vertex (n):
/// those that `writeMesh` finds know nothing of the faces beyond the part's border. Materials and
/// all else are written as there. Throws `InputError` for other endings.
void writeMeshWithNormals(const std::filesystem::path& path, const TriangleMesh& mesh,
                          std::span<const Vec3f> normals, const MeshFileOptions& options = {},
                          const Progress& progress = {});

}  // namespace exemplar
