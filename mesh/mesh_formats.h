// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/warnings.h"
#include "mesh/shading_normals.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

/// The content of a file that lies beside the one being read, or nothing when there is none.
using SiblingFile = std::function<std::optional<std::string>(const std::string& name)>;

/// What a parser is given beside a file's bytes.
struct MeshSource {
  std::string name;              ///< what errors and warnings call the file
  SiblingFile sibling = {};      ///< finds the files that it names; empty where none can be found
  Warnings* warnings = nullptr;  ///< receives what is left out; null drops the lines
  Progress progress = {};

  std::optional<std::string> siblingBytes(const std::string& file) const {
    return sibling ? sibling(file) : std::nullopt;
  }
  /// Warns with the file's name in front.
  void warn(const std::string& what) const { exemplar::warn(warnings, name + ": " + what); }
};

/// Which triangles are parts of one flat polygon (`faceOutlines`); none: each is a face.
using FaceNumbers = std::span<const std::uint32_t>;

// Each format in memory. Every parser throws `InputError` for what is malformed and never reads
// outside of `bytes`; what is only unusual, or cannot be kept, is a warning. Parsers leave
// coordinates as they are in the file; formatters turn z up into y up where `yUp` says so. What a
// parser returns has finite coordinates below 1e15 and valid indices, but may lack triangles. A
// formatter's mesh is valid. All report and throw `Cancelled`.

TriangleMesh parseObj(std::string_view bytes, const MeshSource& source);
TriangleMesh parsePly(std::string_view bytes, const MeshSource& source);
TriangleMesh parseStl(std::string_view bytes, const MeshSource& source);
TriangleMesh parseOff(std::string_view bytes, const MeshSource& source);
/// glTF 2.0, binary (`.glb`) or as plain JSON (`.gltf`).
TriangleMesh parseGltf(std::string_view bytes, const MeshSource& source);

/// A file to be written beside another one.
struct NamedBytes {
  std::string name;
  std::string bytes;
};

/// The `.obj` of a mesh, and what it refers to: `STEM.mtl` and `STEM_` before each texture's name.
struct ObjFiles {
  std::string obj;
  std::vector<NamedBytes> siblings;
};
ObjFiles formatObj(const TriangleMesh& mesh, const std::string& stem, bool yUp,
                   MeshNormals normals = MeshNormals::Crease, const Progress& progress = {},
                   FaceNumbers faces = {});
std::string formatPly(const TriangleMesh& mesh, bool yUp, MeshNormals normals = MeshNormals::Crease,
                      const Progress& progress = {}, FaceNumbers faces = {});
std::string formatStl(const TriangleMesh& mesh, bool yUp, const Progress& progress = {});
std::string formatOff(const TriangleMesh& mesh, bool yUp, const Progress& progress = {},
                      FaceNumbers faces = {});
/// `given` (n or 0) are vertices' normals, in place of those of `normals`.
std::string formatGlb(const TriangleMesh& mesh, bool yUp, MeshNormals normals = MeshNormals::Crease,
                      const Progress& progress = {}, std::span<const Vec3f> given = {});
/// A plain `.gltf`, its buffer embedded.
std::string formatGltf(const TriangleMesh& mesh, bool yUp,
                       MeshNormals normals = MeshNormals::Crease, const Progress& progress = {},
                       std::span<const Vec3f> given = {});

/// Parts of a mesh, each placed any number of times.
struct MeshInstances {
  struct Placement {
    std::uint32_t part = 0;
    Vec3d translation;
  };
  std::vector<std::uint32_t> first;  ///< each part's first triangle, and the number of triangles
  std::vector<Placement> placements;
  /// Of each part, for its mesh and its nodes; none: meshes are numbered and nodes have no name.
  std::vector<std::string> names;
};
/// A `.glb` with a mesh for each part that has triangles and is placed, and a node for each place.
std::string formatGlb(const TriangleMesh& mesh, const MeshInstances& instances, bool yUp,
                      MeshNormals normals = MeshNormals::Crease, const Progress& progress = {});

/// World to file, for a file with y up, and back. Subtracting from 0 makes no negative zeros.
inline Vec3d toFileAxes(const Vec3d& p, bool yUp) { return yUp ? Vec3d{p.x, p.z, 0 - p.y} : p; }
inline Vec3d fromFileAxes(const Vec3d& p, bool yUp) { return yUp ? Vec3d{p.x, 0 - p.z, p.y} : p; }

/// How far floats move a mesh's vertices, as a share of its longest side: about 1e-7 for a mesh at
/// the origin, 1 where coordinates are ten million times its size.
double floatRounding(const TriangleMesh& mesh);

/// What readers say of colors that are no numbers, whose vertices and faces have none then.
inline constexpr const char* kNanColors = "colors that are NaN are left out";

/// Why a coordinate cannot be taken ("is NaN or infinite"), or null.
const char* coordinateProblem(const Vec3d& p);

/// What a picture's first bytes say it is: "image/png", "image/jpeg", or empty.
std::string imageMimeType(std::string_view bytes);
/// The same for pictures of other kinds, too, which are kept and not decoded; a `.tga` by its name.
std::string pictureMimeType(std::string_view bytes, std::string_view name = {});
/// The ending that files of a kind of picture have: ".png".
std::string pictureEnding(std::string_view mimeType);

/// Materials of triangles that come with an sRGB color each, as faces do in `.ply` and `.off`: one
/// material for each color, in the order in which they come. `colors` has one for each triangle.
void setFaceColors(TriangleMesh& mesh, const std::vector<std::array<std::uint8_t, 4>>& colors);

/// A linear RGBA color as four 8-bit samples: sRGB, and opacity as it is.
std::array<std::uint8_t, 4> toRgba8(const std::array<float, 4>& color);
std::array<float, 4> fromRgba8(const std::array<std::uint8_t, 4>& color);

/// Reports step `done` of `all` to `progress` every 16,384 steps: quick enough for inner loops.
inline void reportNowAndThen(const Progress& progress, const char* stage, std::size_t done,
                             std::size_t all) {
  if (done % 16384 == 0)
    progress.report(stage, static_cast<double>(done) / static_cast<double>(all));
}

/// Appends the shortest text that reads back as the same number.
void appendNumber(std::string& text, double value);
void appendNumber(std::string& text, float value);
void appendNumber(std::string& text, std::uint32_t value);

}  // namespace exemplar
