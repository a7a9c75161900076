// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.h"

namespace exemplar {

/// A picture that materials refer to, kept as the file's own bytes so that it leaves as it came.
struct Texture {
  std::string name;      ///< file name or a name of its own; unique within a mesh
  std::string mimeType;  ///< "image/png" or "image/jpeg"
  std::string bytes;     ///< the encoded file; decode with `decodeImage`
};

/// How a surface looks: the core of glTF 2.0's metallic-roughness model.
struct Material {
  std::string name;
  std::array<float, 4> baseColor{0.8f, 0.8f, 0.8f, 1.0f};  ///< linear RGB and opacity, 0..1
  float metallic = 0.0f;                                   ///< 0 dielectric .. 1 metal
  float roughness = 0.8f;                                  ///< 0 mirror .. 1 chalk
  Vec3f emission{};                                        ///< linear RGB, 0..
  std::optional<std::uint32_t> baseColorTexture;           ///< index into `TriangleMesh::textures`

  bool operator==(const Material&) const = default;
};

/// Indexed triangles with materials, colors and texture coordinates: any soup a file can hold,
/// manifold or not. World units, right-handed, z up; triangles wind counterclockwise seen from
/// outside.
///
/// Attributes are there for every element or not at all (an empty vector). `validate` checks it.
struct TriangleMesh {
  std::vector<Vec3d> positions;                         ///< n vertices
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< m triangles, indices into positions

  std::vector<std::array<float, 4>> colors;      ///< n or 0: linear RGBA a vertex, 0..1
  std::vector<std::array<Vec2f, 3>> uvs;         ///< m or 0: a corner's texture coordinates, v up
  std::vector<std::uint32_t> triangleMaterials;  ///< m or 0: indices into materials

  std::vector<Material> materials;
  std::vector<Texture> textures;

  bool hasColors() const { return !colors.empty(); }
  bool hasUvs() const { return !uvs.empty(); }
  bool hasMaterials() const { return !triangleMaterials.empty(); }
};

/// Throws `InputError` ("NAME: ...") unless the mesh has a triangle, every coordinate is finite and
/// below 1e15 in size, every index names something, and every attribute is there for all or none.
void validate(const TriangleMesh& mesh, const std::string& name);

/// The box around the vertices that triangles use.
Box3d boundingBox(const TriangleMesh& mesh);

/// Twice the area of triangle `t` times its unit normal: the cross product of two of its edges.
Vec3d areaNormal(const TriangleMesh& mesh, std::size_t t);

/// Adds `other` to `mesh`: vertices, triangles, materials (equal ones merged) and textures. Missing
/// attributes are filled in (white, (0, 0), a default material) where the other side has them.
void append(TriangleMesh& mesh, const TriangleMesh& other);

}  // namespace exemplar
