// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/mesh_formats.h"

namespace exemplar {

/// A folder of a test's own, empty at first and gone at its end.
class TestFolder {
 public:
  explicit TestFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("exemplar_mesh_test_" + name + "_" + std::to_string(getProcessId()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  ~TestFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  static long getProcessId();
  std::filesystem::path path_;
};

/// The bytes that hexadecimal digits encode.
std::string fromHex(std::string_view digits);

/// A PNG of one red pixel.
const std::string& tinyPng();
/// A gray JPEG of 8 x 8 pixels with value 200.
const std::string& tinyJpeg();

/// A box, each face cut into two triangles, with everything a mesh can have: two materials, one of
/// them with a texture, colors that 8-bit sRGB can hold, and texture coordinates that differ
/// between the faces at a vertex. Its triangles are sorted by material, as `.glb` keeps them.
TriangleMesh fullMesh();

/// A closed torus around the z axis without attributes, `2 * ring * tube` triangles; coordinates
/// that float cannot hold.
TriangleMesh plainTorus(int ring = 16, int tube = 8);

/// Reads bytes as a file with this ending and checks what comes out, as `readMesh` does. Files
/// beside it: "m.mtl" and "t.png" where `withSiblings`.
TriangleMesh parse(const std::string& ending, std::string_view bytes, bool withSiblings = true,
                   Warnings* warnings = nullptr);

/// `mesh` as the bytes of a file with this ending.
std::string format(const std::string& ending, const TriangleMesh& mesh);

/// A binary glTF file around this JSON and binary chunk, padded as the standard wants it.
std::string makeGlb(std::string json, std::string binary);

/// A `.glb` with what `formatGlb` does not write: a tree of nodes, sparse and normalized accessors,
/// strips, a texture transform, data in a URI.
std::string richGlb();

/// A `.glb` of a square of two triangles with two materials, whose JSON members are given, and the
/// pictures, samplers and textures that they may name; more members at the top, and further
/// attributes, with a comma in front.
std::string squareGlb(const std::string& first, const std::string& second,
                      const std::string& more = "", const std::string& attributes = "");
/// The members of a material with all maps, a transform and extensions, known and unknown.
extern const std::string kRichMaterial;

}  // namespace exemplar
