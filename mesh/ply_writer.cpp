// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <bit>

#include "mesh/face_outlines.h"
#include "mesh/mesh_formats.h"
#include "mesh/split_vertices.h"

namespace exemplar {
namespace {

template <class T>
void appendLittle(std::string& out, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  out.append(raw.data(), raw.size());
}

std::string headerOf(const TriangleMesh& mesh, const SplitVertices& split, std::size_t faces,
                     bool asDouble) {
  const std::string vertices = std::to_string(split.source.size());
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment written by exemplar\n";
  if (mesh.hasMaterials()) {
    for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
      std::string name = mesh.materials[m].name;
      for (char& c : name) c = static_cast<unsigned char>(c) < ' ' ? '_' : c;
      out += "comment material " + std::to_string(m) + " " + name + "\n";
    }
  }
  out += "element vertex " + vertices + "\n";
  for (const char* axis : {"x", "y", "z"}) {
    out += std::string("property ") + (asDouble ? "double " : "float ") + axis + "\n";
  }
  if (!split.normals.empty()) out += "property float nx\nproperty float ny\nproperty float nz\n";
  const char* colors =
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
  if (mesh.hasColors()) out += colors;
  out += "element face " + std::to_string(faces) + "\n";
  // Signed indices are what more readers know.
  out += split.source.size() <= 0x7fffffff ? "property list uchar int vertex_indices\n"
                                           : "property list uchar uint vertex_indices\n";
  if (mesh.hasUvs()) out += "property list uchar float texcoord\n";
  if (mesh.hasMaterials()) {
    out += colors;
    out += "property int material_index\nelement material " +
           std::to_string(mesh.materials.size()) + "\n";
    for (const char* name : {"linear_red", "linear_green", "linear_blue", "opacity", "metallic",
                             "roughness", "emission_red", "emission_green", "emission_blue"}) {
      out += std::string("property float ") + name + "\n";
    }
  }
  if (split.source.size() > split.originals) {
    out += "element copy " + std::to_string(split.source.size() - split.originals) +
           "\nproperty uint vertex\n";
  }
  return out + "end_header\n";
}

}  // namespace

std::string formatPly(const TriangleMesh& mesh, bool yUp, MeshNormals normals,
                      const Progress& progress, FaceNumbers numbers) {
  constexpr std::size_t kMostCornersOfFace = 127;  // two texture coordinates each, in a byte
  const auto faces = faceOutlines(mesh, numbers, kMostCornersOfFace);
  const Progress vertices = progress.part(0.3, 0.5), triangles = progress.part(0.5, 1);
  const SplitVertices split =
      splitVertices(mesh, shadingNormals(mesh, normals, progress.part(0, 0.3)), {},
                    {.uvs = false, .keepUnused = true}, progress);
  const auto isFloat = [](double c) { return static_cast<double>(static_cast<float>(c)) == c; };
  const bool asDouble =
      !std::all_of(mesh.positions.begin(), mesh.positions.end(),
                   [&](const Vec3d& p) { return isFloat(p.x) && isFloat(p.y) && isFloat(p.z); });
  std::string out = headerOf(mesh, split, faces.size(), asDouble);
  out.reserve(out.size() + split.source.size() * 40 +
              mesh.triangles.size() * (mesh.hasUvs() ? 46 : 21));
  const auto appendColor = [&](const std::array<float, 4>& color) {
    for (const std::uint8_t sample : toRgba8(color)) out += static_cast<char>(sample);
  };
  for (std::size_t i = 0; i < split.source.size(); ++i) {
    reportNowAndThen(vertices, "writing vertices", i, split.source.size());
    const std::uint32_t v = split.source[i];
    const Vec3d p = toFileAxes(mesh.positions[v], yUp);
    for (const double c : {p.x, p.y, p.z}) {
      if (asDouble) {
        appendLittle(out, c);
      } else {
        appendLittle(out, static_cast<float>(c));
      }
    }
    if (!split.normals.empty()) {
      const Vec3d n = toFileAxes(cast<double>(split.normals[i]), yUp);
      for (const double c : {n.x, n.y, n.z}) appendLittle(out, static_cast<float>(c));
    }
    if (mesh.hasColors()) appendColor(mesh.colors[v]);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    reportNowAndThen(triangles, "writing triangles", f, faces.size());
    out += static_cast<char>(faces[f].size());
    for (const auto& [t, c] : faces[f]) appendLittle(out, split.triangles[t][c]);
    if (mesh.hasUvs()) {
      out += static_cast<char>(2 * faces[f].size());
      for (const auto& [t, c] : faces[f]) {
        appendLittle(out, mesh.uvs[t][c].x);
        appendLittle(out, mesh.uvs[t][c].y);
      }
    }
    if (mesh.hasMaterials()) {
      const std::uint32_t material = mesh.triangleMaterials[faces[f][0].triangle];
      appendColor(mesh.materials[material].baseColor);
      appendLittle(out, material);
    }
  }
  if (mesh.hasMaterials()) {
    for (const Material& m : mesh.materials) {
      for (const float f : {m.baseColor[0], m.baseColor[1], m.baseColor[2], m.baseColor[3],
                            m.metallic, m.roughness, m.emission.x, m.emission.y, m.emission.z}) {
        appendLittle(out, f);
      }
    }
  }
  for (std::size_t i = split.originals; i < split.source.size(); ++i)
    appendLittle(out, split.source[i]);
  return out;
}

}  // namespace exemplar
