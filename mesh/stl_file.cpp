// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <cstring>
#include <unordered_map>

#include "core/error.h"
#include "core/text.h"
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

/// Skips a solid's name, which lasts to the line's end or to the first facet on it; it may hold the
/// word itself.
void skipName(TextScanner& in) {
  const auto facetFollows = [&] {
    const std::string rest = lowerCase(in.peekRest().substr(0, 64));
    if (!rest.starts_with("facet")) return false;
    const std::size_t next = rest.find_first_not_of(" \t", 5);
    return next != std::string::npos && next > 5 &&
           (rest.compare(next, 6, "normal") == 0 || rest.compare(next, 5, "outer") == 0);
  };
  while (!in.atLineEnd() && !facetFollows()) in.word();
}

void appendLittle(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 255);
}

/// The colors that some programs put into the two bytes behind each triangle, 5 bits a channel:
/// Magics, whose header says "COLOR=" and a color for triangles without one (highest bit set), red
/// in the lowest bits; and VisCAM and SolidView, blue in the lowest bits of those with the highest
/// bit set. Both count sRGB, as their pictures do.
class FaceColors {
 public:
  explicit FaceColors(std::string_view header) {
    const std::size_t at = header.find("COLOR=");
    if (at == std::string_view::npos || at + 10 > header.size()) return;
    magics_ = true;
    for (std::size_t c = 0; c < 4; ++c) whole_[c] = static_cast<std::uint8_t>(header[at + 6 + c]);
  }

  void add(std::uint32_t bits) {
    bits_.push_back(static_cast<std::uint16_t>(bits));
    any_ = any_ || (magics_ ? bits != 0 : (bits & kFlag) != 0);
  }

  void apply(TriangleMesh& mesh) const {
    // Zeros everywhere in a Magics file come from programs that know only the header's color.
    if (!any_ && !magics_) return;
    std::vector<std::array<std::uint8_t, 4>> colors;
    colors.reserve(bits_.size());
    for (const std::uint32_t bits : bits_) colors.push_back(any_ ? colorOf(bits) : whole_);
    setFaceColors(mesh, colors);
  }

 private:
  static constexpr std::uint32_t kFlag = 0x8000;

  std::array<std::uint8_t, 4> colorOf(std::uint32_t bits) const {
    const bool own = ((bits & kFlag) != 0) != magics_;
    if (!own) return whole_;
    const auto channel = [&](int shift) {
      return static_cast<std::uint8_t>(((bits >> shift & 31) * 255 + 15) / 31);
    };
    const std::array<std::uint8_t, 3> c{channel(0), channel(5), channel(10)};
    return {magics_ ? c[0] : c[2], c[1], magics_ ? c[2] : c[0], 255};
  }

  bool magics_ = false, any_ = false;
  std::array<std::uint8_t, 4> whole_ = toRgba8(Material{}.baseColor);
  std::vector<std::uint16_t> bits_;
};

TriangleMesh parseBinary(std::string_view bytes, const MeshSource& source) {
  const std::string& name = source.name;
  std::uint64_t count = littleUint(bytes.data() + 80);
  const std::uint64_t held = (bytes.size() - kHeaderBytes) / kTriangleBytes;
  // What a program puts there that writes triangles before it knows how many will come.
  constexpr std::uint64_t kUnknown = 0xffffffff;
  if ((count == 0 || count == kUnknown) && held > 0 &&
      bytes.size() == kHeaderBytes + held * kTriangleBytes) {
    source.warn("its header does not say how many triangles it has; all " + std::to_string(held) +
                " are read");
    count = held;
  }
  const std::uint64_t needed = kHeaderBytes + count * kTriangleBytes;
  if (needed > bytes.size()) {
    throw InputError(name + ": the file is truncated: its header promises " +
                     std::to_string(count) + " triangles, which take " + std::to_string(needed) +
                     " bytes, and it has " + std::to_string(bytes.size()));
  }
  TriangleMesh mesh;
  Joiner joiner(mesh);
  joiner.reserve(count);
  FaceColors colors(bytes.substr(0, 80));
  for (std::uint64_t t = 0; t < count; ++t) {
    reportNowAndThen(source.progress, "reading", t, count);
    // A normal, which follows from the corners, the corners, and two bytes for a color.
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
    colors.add(std::uint32_t{static_cast<unsigned char>(at[0])} |
               std::uint32_t{static_cast<unsigned char>(at[1])} << 8);
  }
  colors.apply(mesh);
  return mesh;
}

/// Reads words rather than lines: some writers put a facet on one line.
TriangleMesh parseText(std::string_view bytes, const MeshSource& source) {
  TriangleMesh mesh;
  Joiner joiner(mesh);
  TextScanner in(bytes, source.name);
  std::array<std::uint32_t, 3> triangle{};
  int corners = -1;  // in the facet so far; -1 outside of facets
  bool ended = false;
  std::size_t words = 0;
  in.nextLine();
  for (;;) {
    if (words++ % 65536 == 0) source.progress.report("reading", in.fraction());
    const std::string_view written = in.wordAhead();
    if (written.empty()) break;
    const std::string lower = lowerCase(written);
    const std::string_view key = lower;
    if (key == "facet") {
      if (corners >= 0) in.fail("a facet begins inside a facet");
      corners = 0;
      ended = false;
      // "normal" and three numbers, which follow from the corners and are often wrong.
      if (lowerCase(in.peekWord()) == "normal") {
        for (int i = 0; i < 4; ++i) in.word();
      }
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
      skipName(in);
    } else if (key == "solid") {
      ended = false;
      skipName(in);
    } else if (key == "color") {
      while (in.tryNumber()) {
      }
      source.warn("colors of facets in text are left out");
    } else if (key != "outer" && key != "loop" && key != "endloop") {
      in.fail("'" + TextScanner::shown(written) + "' is not a word of an STL file");
    }
  }
  if (!ended) in.fail("the file is truncated: it ends before 'endsolid'");
  return mesh;
}

/// What a file is: its first word says it only for text, and not even then.
bool isText(std::string_view bytes) {
  std::string decoded;
  std::string_view text = asUtf8(bytes.substr(0, 4096), decoded);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const std::string begin = lowerCase(text.substr(0, 1024));
  if (!begin.starts_with("solid") && !begin.starts_with("facet")) return false;
  if (bytes.size() < kHeaderBytes) return true;
  const std::uint64_t needed =
      kHeaderBytes + std::uint64_t{littleUint(bytes.data() + 80)} * kTriangleBytes;
  if (bytes.size() == needed) return false;
  // Many binary files begin with "solid" too. Text goes on with words and holds no zero bytes,
  // which a binary file's normals, flags and count are full of.
  const bool hasWords =
      begin.find("facet") != std::string::npos || begin.find("endsolid") != std::string::npos;
  const bool hasZeros = text.substr(0, 1024).find('\0') != std::string_view::npos;
  return bytes.size() < needed ? hasWords || !hasZeros : hasWords && !hasZeros;
}

}  // namespace

TriangleMesh parseStl(std::string_view bytes, const MeshSource& source) {
  if (isText(bytes)) return parseText(bytes, source);
  if (bytes.size() >= kHeaderBytes) return parseBinary(bytes, source);
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
