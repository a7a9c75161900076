// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <cstring>
#include <unordered_map>

#include "core/error.h"
#include "core/text_scanner.h"
#include "mesh/mesh_formats.h"

namespace exemplar {
namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;

/// Gives each different position one vertex, in the order in which they come.
class Joiner {
 public:
  explicit Joiner(TriangleMesh& mesh) : mesh_(mesh) {}

  void reserve(std::size_t triangles) {
    mesh_.triangles.reserve(triangles);
    // Closed meshes have about half as many vertices as triangles.
    mesh_.positions.reserve(triangles / 2);
    indexOf_.reserve(triangles / 2);
  }

  std::uint32_t add(Vec3d p) {
    p += Vec3d{0, 0, 0};  // makes -0 and 0 one position
    const auto [found, added] =
        indexOf_.try_emplace(p, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (added) mesh_.positions.push_back(p);
    return found->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const Vec3d& p) const {
      std::uint64_t h = 0;
      for (const double c : {p.x, p.y, p.z}) {
        h = (h ^ std::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
      }
      return h;
    }
  };

  TriangleMesh& mesh_;
  std::unordered_map<Vec3d, std::uint32_t, Hash> indexOf_;
};

std::uint32_t littleUint(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

void appendLittle(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 255);
}

TriangleMesh parseBinary(std::string_view bytes, const MeshSource& source) {
  const std::string& name = source.name;
  const std::uint64_t count = littleUint(bytes.data() + 80);
  const std::uint64_t needed = kHeaderBytes + count * kTriangleBytes;
  if (needed > bytes.size()) {
    throw InputError(name + ": the file is truncated: its header promises " +
                     std::to_string(count) + " triangles, which take " + std::to_string(needed) +
                     " bytes, and it has " + std::to_string(bytes.size()));
  }
  TriangleMesh mesh;
  Joiner joiner(mesh);
  joiner.reserve(count);
  for (std::uint64_t t = 0; t < count; ++t) {
    reportNowAndThen(source.progress, "reading", t, count);
    // A normal, which follows from the corners, the corners, and two bytes without a meaning.
    const char* at = bytes.data() + kHeaderBytes + t * kTriangleBytes + 12;
    std::array<std::uint32_t, 3> triangle{};
    for (std::uint32_t& v : triangle) {
      Vec3d p;
      for (int axis = 0; axis < 3; ++axis, at += 4) p[axis] = std::bit_cast<float>(littleUint(at));
      if (const char* problem = coordinateProblem(p)) {
        throw InputError(name + ": triangle " + std::to_string(t) + " " + problem);
      }
      v = joiner.add(p);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TriangleMesh parseText(std::string_view bytes, const MeshSource& source) {
  TriangleMesh mesh;
  Joiner joiner(mesh);
  TextScanner in(bytes, source.name);
  in.nextLine();
  std::array<std::uint32_t, 3> triangle{};
  int corners = -1;  // in the facet so far; -1 outside of facets
  bool ended = false;
  for (std::size_t line = 0; in.nextLine(); ++line) {
    if (line % 16384 == 0) source.progress.report("reading", in.fraction());
    const std::string_view key = in.word();
    if (key == "facet") {
      if (corners >= 0) in.fail("a facet begins inside a facet");
      corners = 0;
      ended = false;
    } else if (key == "vertex") {
      if (corners < 0) in.fail("a vertex is outside of a facet");
      if (corners == 3) in.fail("a facet has more than three vertices");
      const double x = in.number("x"), y = in.number("y"), z = in.number("z");
      const Vec3d p{x, y, z};
      if (const char* problem = coordinateProblem(p)) in.fail(std::string("the vertex ") + problem);
      triangle[corners++] = joiner.add(p);
    } else if (key == "endfacet") {
      if (corners != 3) in.fail("a facet should have three vertices");
      mesh.triangles.push_back(triangle);
      corners = -1;
    } else if (key == "endsolid") {
      if (corners >= 0) in.fail("the solid ends inside a facet");
      ended = true;
    } else if (key == "solid") {
      ended = false;
    } else if (key != "outer" && key != "endloop" && !key.empty()) {
      in.fail("'" + TextScanner::shown(key) + "' is not a word of an STL file");
    }
  }
  if (!ended) in.fail("the file is truncated: it ends before 'endsolid'");
  return mesh;
}

}  // namespace

TriangleMesh parseStl(std::string_view bytes, const MeshSource& source) {
  // Many binary files begin with "solid" too; their size gives them away.
  const bool solid = bytes.starts_with("solid");
  if (bytes.size() >= kHeaderBytes) {
    const std::uint64_t needed =
        kHeaderBytes + std::uint64_t{littleUint(bytes.data() + 80)} * kTriangleBytes;
    if (!solid || bytes.size() == needed) return parseBinary(bytes, source);
  }
  if (solid) return parseText(bytes, source);
  throw InputError(source.name +
                   ": not an STL file: it should begin with 'solid' or have 84 bytes or more");
}

std::string formatStl(const TriangleMesh& mesh, bool yUp, const Progress& progress) {
  if (mesh.triangles.size() > 0xffffffff) {
    throw InputError("an STL file holds at most 4294967295 triangles; write a .ply");
  }
  std::string out = "written by exemplar";
  out.reserve(kHeaderBytes + mesh.triangles.size() * kTriangleBytes);
  out.resize(80, ' ');
  appendLittle(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  const auto appendVector = [&](const Vec3d& v) {
    for (const double c : {v.x, v.y, v.z}) {
      appendLittle(out, std::bit_cast<std::uint32_t>(static_cast<float>(c)));
    }
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    reportNowAndThen(progress, "writing triangles", t, mesh.triangles.size());
    appendVector(toFileAxes(normalized(areaNormal(mesh, t)), yUp));
    for (const std::uint32_t v : mesh.triangles[t])
      appendVector(toFileAxes(mesh.positions[v], yUp));
    out.append(2, '\0');
  }
  return out;
}

}  // namespace exemplar
