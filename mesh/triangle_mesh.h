// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vec.h"
#include "mesh/material.h"

namespace exemplar {

/// The place of an example that a corner of a result came from.
struct SourcePoint {
  std::uint32_t triangle = 0;      ///< of the example, from 0 in the order of its file's faces
  std::uint32_t example = 0;       ///< which of the examples, from 0
  std::array<float, 2> weights{};  ///< of the triangle's first two corners; the third has the rest

  bool operator==(const SourcePoint&) const = default;
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
  std::vector<std::uint32_t> triangleObjects;    ///< m or 0: indices into objects
  /// m or 0: where each corner came from. Steps that change triangles drop it.
  std::vector<std::array<SourcePoint, 3>> sources;

  std::vector<Material> materials;
  std::vector<Texture> textures;

  /// Names of the objects that a file holds, each once, where there are several; may be empty.
  /// Steps that change triangles drop them.
  std::vector<std::string> objects;
  std::string name;      ///< of the one object that a file holds; empty for none or several
  std::string dataName;  ///< of that object's mesh, where a file names it apart (glTF)

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
