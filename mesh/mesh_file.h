// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>

#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Which axis points up in a file. In memory z is up, always.
enum class UpAxis {
  Default,  ///< y for .glb (by its standard) and .obj (as Blender, Maya and Houdini write it), else z
  Y,        ///< file (x, y, z) is world (x, -z, y)
  Z,        ///< file and world agree
};

struct MeshFileOptions {
  UpAxis up = UpAxis::Default;
};

/// Whether the path ends in one of the endings that `readMesh` and `writeMesh` know:
/// `.obj .ply .stl .off .glb`, in any case.
bool isMeshFile(const std::filesystem::path& path);

/// Reads a triangle mesh; polygons are cut into triangles. The result passes `validate`.
///
/// `.obj`: materials and base-colour textures from its `.mtl` (a missing `.mtl` is no error: the
/// materials keep their names), vertex colours after the coordinates, UVs. `.ply`: ASCII and binary of
/// both byte orders, vertex colours, per-vertex `s,t`/`u,v`. `.stl`: ASCII and binary, equal vertices joined.
/// `.off`, `COFF`. `.glb` (glTF 2.0 binary): every mesh of the scene with its node's transform,
/// materials, `COLOR_0`, `TEXCOORD_0`, embedded textures.
///
/// Throws `InputError` naming the file, and the line in text formats, for anything malformed:
/// truncated, indices of vertices that do not exist, NaN or infinite coordinates, no triangle.
TriangleMesh readMesh(const std::filesystem::path& path, const MeshFileOptions& options = {});

/// Writes a mesh in the format of the path's ending, with what that format can hold (`.stl` and `.off`
/// hold no materials); `.obj` writes its `.mtl` and textures beside it. The file is whole or not
/// there, and the same mesh gives the same bytes. Throws `InputError` when it cannot be written.
void writeMesh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const MeshFileOptions& options = {});

}  // namespace exemplar
