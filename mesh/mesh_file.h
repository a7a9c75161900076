// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "core/warnings.h"
#include "mesh/shading_normals.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// Which axis points up in a file. In memory z is up, always.
enum class UpAxis {
  Default,  ///< y for .glb (by its standard) and .obj (as Blender, Maya and Houdini write it), else
            ///< z
  Y,        ///< file (x, y, z) is world (x, -z, y)
  Z,        ///< file and world agree
};

struct MeshFileOptions {
  UpAxis up = UpAxis::Default;
  /// What is written to `.glb`, `.gltf`, `.obj` and `.ply`; reading joins what it splits.
  MeshNormals normals = MeshNormals::Crease;
  /// Receives a line for whatever a file holds and the mesh cannot, and the other way round; null
  /// drops the lines.
  Warnings* warnings = nullptr;
  /// Where files are that a mesh names (materials, textures, buffers). By default the folder of the
  /// mesh's own file; none for bytes in memory, whose materials then keep only their names.
  std::optional<std::filesystem::path> folder;
  /// Receives the path of each file of that folder that was read; null drops them.
  std::vector<std::filesystem::path>* beside = nullptr;
};

/// Whether the path ends in one of the endings that `readMesh` and `writeMesh` know:
/// `.obj .ply .stl .off .glb .gltf`, in any case.
bool isMeshFile(const std::filesystem::path& path);

/// Reads a triangle mesh; polygons are cut into triangles, concave ones along diagonals inside
/// them. The result passes `validate`.
///
/// `.obj`: materials and base-color textures from its `.mtl`, vertex colors after the coordinates,
/// UVs. Only materials that faces use are kept. `.ply`: ASCII and binary of both byte orders,
/// vertex colors, face colors (a material for each), per-vertex `s,t`/`u,v`, per-corner `texcoord`
/// with the pictures that `comment TextureFile` names, triangle strips, and the materials that
/// `writeMesh` adds. `.stl`: ASCII and binary, equal vertices joined, the face colors of Magics and
/// VisCAM.
/// `.off`: text, with or without its first word, with colors of vertices (`COFF`) and faces,
/// normals and UVs (`ST`). `.glb` and `.gltf` (glTF 2.0, binary or JSON): every visible mesh of the
/// scene with its node's transform or instances (EXT_mesh_gpu_instancing), skins as their joints
/// are, morph targets by their default weights, materials, `COLOR_0`, the UVs of the base-color
/// texture, embedded textures. Vertices that were split for normals or UVs are joined again, so
/// that closed surfaces are closed; compressed meshes are refused.
///
/// Text may be UTF-8 or UTF-16, with any line ends. Colors are linear in memory and in glTF. The
/// vertex and face colors of `.ply`, `.obj`, `.stl` and `.off` are taken to be sRGB, as Blender and
/// MeshLab write them, and to count to 1 or to 255, whichever a file's largest number says; `Kd`
/// and `Ke` in a `.mtl` are linear.
///
/// Numbers that are NaN matter where they are used: colors and texture coordinates have none then,
/// and a vertex of a `.obj`, `.ply` or `.off` may have such a place while no face names it.
///
/// What is missing or cannot be kept (a material library, a texture or one that is no PNG or JPEG,
/// maps other than the base color, faces with fewer than three corners) is left out and named in
/// `options.warnings`; a factor whose map is left out is left out with it.
///
/// Throws `InputError` naming the file, and the line in text formats, for anything malformed:
/// truncated, indices of vertices that do not exist, NaN or infinite coordinates of vertices that
/// faces use, no triangle; and `Cancelled`. Takes about 0.3 s for a million triangles; memory grows
/// with the file, whatever its header claims.
TriangleMesh readMesh(const std::filesystem::path& path, const MeshFileOptions& options = {},
                      const Progress& progress = {});

/// The same from the bytes of a file. `name` is what errors call it; its ending says the format.
TriangleMesh readMesh(std::string_view bytes, const std::string& name,
                      const MeshFileOptions& options, const Progress& progress = {});

/// Writes a mesh in the format of the path's ending, with what that format can hold:
///
/// | format | coordinates | colors | UVs | materials | textures |
/// |---|---|---|---|---|---|
/// | `.obj` | exact | exact | exact | in `STEM.mtl` | beside it, as `STEM_NAME` |
/// | `.ply` | exact | 8 bits sRGB | exact | exact, and as face colors | - |
/// | `.stl` | float | - | - | - | - |
/// | `.off` | exact | 8 bits sRGB | - | color, 8 bits sRGB | - |
/// | `.glb`, `.gltf` | float | exact, clamped to 0..1 | v to 2^-24 | exact | embedded |
///
/// Floats are those of a mesh that a node moves to its place where it is far from the origin
/// (`.glb`), or lose digits there, which a warning states (`.stl`).
///
/// "Exact" is what comes back from `readMesh`; 8-bit colors that came from a file come back
/// exactly, too. A `.glb` has one primitive for each material, in their order, with the triangles
/// in theirs; its vertices are those that triangles use, split only where normals or UVs differ. In
/// a `.ply`, copies of vertices that have several normals come last, and an element `copy` names
/// the vertex of each. Normals (`.glb`, `.gltf`, `.ply`, `.obj`) are those of `shadingNormals` and
/// take 0.25 s of CPU for a million triangles, in an `.obj` 0.4 s.
///
/// The file is whole or not there, and the same mesh gives the same bytes. Throws `InputError` when
/// the mesh does not pass `validate` or the file cannot be written.
void writeMesh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const MeshFileOptions& options = {}, const Progress& progress = {});

}  // namespace exemplar
