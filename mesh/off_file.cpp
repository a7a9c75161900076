// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text_scanner.h"
#include "mesh/face_outlines.h"
#include "mesh/mesh_formats.h"
#include "mesh/polygon.h"
#include "mesh/unplaced_vertices.h"

namespace exemplar {
namespace {

/// Whether the rows of a CNOFF file have the normal first, as Geomview defined it, or the color, as
/// MeshLab writes it: normals have length 1, and colors no negative numbers.
class NormalOrder {
 public:
  /// Takes a vertex's first `count` numbers: three of a normal and three or four of a color.
  void add(const std::vector<double>& row, std::size_t count) {
    look(row[0], row[1], row[2], front_);
    look(row[count - 3], row[count - 2], row[count - 1], back_);
  }
  bool colorComesFirst() const {
    if (front_.negative != back_.negative) return back_.negative;
    return back_.units > front_.units;
  }

 private:
  struct Seen {
    bool negative = false;
    std::size_t units = 0;
  };
  static void look(double x, double y, double z, Seen& seen) {
    seen.negative = seen.negative || x < 0 || y < 0 || z < 0;
    seen.units += std::abs(x * x + y * y + z * z - 1) < 0.02;
  }
  Seen front_, back_;
};

/// Reads Geomview's OFF: `[ST][C][N]OFF`, the counts, a line for each vertex and face.
class OffReader {
 public:
  OffReader(std::string_view bytes, const MeshSource& source)
      : in_(bytes, source.name), source_(source) {}

  TriangleMesh read() {
    readKind();
    const std::uint64_t vertices = readCount("the number of vertices");
    const std::uint64_t faces = readCount("the number of faces");
    if (!in_.atLineEnd()) in_.integer("the number of edges");
    // "0 0 0" and a line's end are the least that a vertex takes; "1 0" that a face takes.
    if (vertices > in_.bytesLeft() / 6 + 1 || faces > in_.bytesLeft() / 4 + 1) {
      in_.fail("the file is truncated: it promises " + std::to_string(vertices) + " vertices and " +
               std::to_string(faces) + " faces, and " + std::to_string(in_.bytesLeft()) +
               " bytes are left");
    }
    mesh_.positions.reserve(vertices);
    for (std::uint64_t i = 0; i < vertices; ++i) {
      if (i % 16384 == 0) source_.progress.report("reading", in_.fraction());
      readVertex();
    }
    for (std::uint64_t i = 0; i < faces; ++i) {
      if (i % 16384 == 0) source_.progress.report("reading", in_.fraction());
      readFace();
    }
    finish();
    return std::move(mesh_);
  }

 private:
  void readKind() {
    if (!in_.nextFilledLine()) in_.fail("not an OFF file: it should begin with 'OFF'");
    // Without its first word, which some writers leave out, a file begins with the counts.
    const std::string_view first = in_.peekWord();
    if (first.find_first_not_of("0123456789") == std::string_view::npos) return;
    // Others leave no blank between "OFF" and the first count.
    const std::string whole(in_.letters());
    const std::string upper = upperCase(whole);
    std::string_view kind = upper;
    const auto drop = [&](std::string_view prefix, bool& found) {
      if (!kind.starts_with(prefix) || kind == "OFF" || found) return false;
      kind.remove_prefix(prefix.size());
      return found = true;
    };
    while (drop("ST", hasUvs_) || drop("C", hasColors_) || drop("N", hasNormals_)) {
    }
    if (kind != "OFF") {
      in_.fail(
          "not an OFF file that can be read: it should begin with OFF, with ST, C and N in front "
          "where vertices have texture coordinates, colors and normals, not '" +
          TextScanner::shown(whole.empty() ? first : whole) + "'");
    }
    if (in_.peek() == 'B') in_.fail("a binary OFF file; save it as text, or as .ply");
    if (in_.atLineEnd() || in_.peek() == '#') {
      if (!in_.nextFilledLine()) in_.fail("the file is truncated: it ends before the counts");
    }
  }

  static std::string upperCase(std::string text) {
    for (char& c : text) {
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    }
    return text;
  }

  std::uint64_t readCount(const char* what) {
    const std::int64_t count = in_.integer(what);
    if (count < 0) in_.fail(std::string(what) + " should not be negative");
    return static_cast<std::uint64_t>(count);
  }

  void nextRow(const char* what) {
    if (!in_.nextFilledLine())
      in_.fail(std::string("the file is truncated: a ") + what + " is missing");
  }

  /// The numbers up to the line's end or a comment; NaN for a word that is none ("-1.#IND").
  void readNumbers() {
    numbers_.clear();
    while (!in_.atLineEnd() && in_.peek() != '#') {
      const std::optional<double> value = in_.tryNumber();
      numbers_.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
      if (!value) in_.word();
    }
  }

  void readVertex() {
    nextRow("vertex");
    Vec3d p;
    p.x = in_.number("x");
    p.y = in_.number("y");
    p.z = in_.number("z");
    if (const char* problem = coordinateProblem(p)) {
      unplaced_.add({mesh_.positions.size(), problem, in_.line()});
      p = {};
    }
    mesh_.positions.push_back(p);
    if (!hasUvs_ && !hasColors_) {
      if (!hasNormals_ && !in_.atLineEnd() && in_.peek() != '#') {
        source_.warn(
            "numbers after a vertex's coordinates are left out: the first word would say "
            "what they are (COFF: colors)");
      }
      return;
    }
    readNumbers();
    // Normal, color, texture coordinates: in this order, or with the color before the normal.
    std::size_t end = numbers_.size();
    if (hasUvs_) {
      if (end < 2) in_.fail("a vertex's texture coordinates are missing");
      end -= 2;
      Vec2f uv{static_cast<float>(numbers_[end]), static_cast<float>(numbers_[end + 1])};
      if (!(std::abs(uv.x) < 1e15f && std::abs(uv.y) < 1e15f)) {
        source_.warn("texture coordinates that are NaN or too large are taken as 0");
        uv = {};
      }
      vertexUvs_.push_back(uv);
    }
    if (!hasColors_) return;
    const std::size_t normal = hasNormals_ ? 3 : 0;
    if (end != normal + 3 && end != normal + 4)
      in_.fail("a vertex's color should have three or four numbers");
    if (hasNormals_) order_.add(numbers_, end);
    // What the color is shows only when all vertices have been read.
    std::array<double, 7>& row = rows_.emplace_back();
    row.fill(-1);
    std::copy_n(numbers_.begin(), end, row.begin());
    rowNumbers_.push_back(static_cast<std::uint8_t>(end));
  }

  /// Takes the colors out of the vertices' rows.
  void finishColors() {
    const std::size_t begin = hasNormals_ && !order_.colorComesFirst() ? 3 : 0;
    for (std::size_t v = 0; v < rows_.size(); ++v) {
      const auto& row = rows_[v];
      const bool hasAlpha = rowNumbers_[v] == (hasNormals_ ? 7 : 4);
      colors_.push_back(
          {row[begin], row[begin + 1], row[begin + 2], hasAlpha ? row[begin + 3] : -1});
      dropNan(colors_.back());
      checkColor(colors_.back());
    }
  }

  void dropNan(std::array<double, 4>& color) const {
    if (std::ranges::none_of(color, [](double c) { return std::isnan(c); })) return;
    color.fill(-1);
    source_.warn(kNanColors);
  }

  void checkColor(const std::array<double, 4>& color) {
    for (const double c : color) {
      if (!(c >= -1 && c <= 255)) in_.fail("a color should be in 0..1 or 0..255");
    }
  }

  void readFace() {
    nextRow("face");
    const std::int64_t count = in_.integer("a face's number of corners");
    if (count < 0) in_.fail("a face's number of corners should not be negative");
    corners_.clear();
    points_.clear();
    pieces_.clear();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t v = in_.integer("a face's vertex");
      if (v < 0 || v >= static_cast<std::int64_t>(mesh_.positions.size())) {
        in_.fail("a face names vertex " + std::to_string(v) + " of " +
                 std::to_string(mesh_.positions.size()));
      }
      corners_.push_back(static_cast<std::uint32_t>(v));
      points_.push_back(mesh_.positions[corners_.back()]);
    }
    readNumbers();
    if (count < 3) {
      source_.warn("faces with fewer than three corners are left out");
      return;
    }
    if (!triangulate(points_, pieces_)) {
      in_.fail("a concave face has " + std::to_string(count) + " corners; at most " +
               std::to_string(kMostCorners) + " can be cut into triangles");
    }
    std::array<double, 4> color{-1, -1, -1, -1};
    if (numbers_.size() == 1)
      source_.warn("colors of faces that are numbers of a table's rows are left out");
    if (numbers_.size() == 3 || numbers_.size() == 4) {
      std::copy(numbers_.begin(), numbers_.end(), color.begin());
      dropNan(color);
      checkColor(color);
    }
    for (const auto& [a, b, c] : pieces_) {
      mesh_.triangles.push_back({corners_[a], corners_[b], corners_[c]});
      faceColors_.push_back(color);
    }
  }

  /// Whether colors are in 0..255: whole files use one or the other, and only a component above 1
  /// says which. A missing component is -1.
  static double scaleOf(const std::vector<std::array<double, 4>>& colors) {
    for (const auto& color : colors) {
      for (const double c : color) {
        if (c > 1) return 1;
      }
    }
    return 255;
  }

  static std::array<std::uint8_t, 4> toBytes(const std::array<double, 4>& color, double scale) {
    std::array<std::uint8_t, 4> bytes{};
    for (int c = 0; c < 4; ++c) {
      const double missing = c == 3 ? 255 : 204;  // opaque, light gray
      bytes[c] = static_cast<std::uint8_t>(
          std::lround(color[c] < 0 ? missing : std::min(color[c] * scale, 255.0)));
    }
    return bytes;
  }

  void finish() {
    if (const auto* vertex = unplaced_.firstUsed(mesh_, source_))
      in_.fail(vertex->line, std::string("the vertex ") + vertex->problem);
    finishColors();
    const double vertexScale = scaleOf(colors_);
    for (const auto& color : colors_)
      mesh_.colors.push_back(fromRgba8(toBytes(color, vertexScale)));
    if (hasUvs_) {
      for (const auto& [a, b, c] : mesh_.triangles) {
        mesh_.uvs.push_back({vertexUvs_[a], vertexUvs_[b], vertexUvs_[c]});
      }
    }
    const auto isColored = [](const std::array<double, 4>& color) { return color[0] >= 0; };
    if (std::none_of(faceColors_.begin(), faceColors_.end(), isColored)) return;
    const double faceScale = scaleOf(faceColors_);
    std::vector<std::array<std::uint8_t, 4>> bytes;
    for (const auto& color : faceColors_) bytes.push_back(toBytes(color, faceScale));
    setFaceColors(mesh_, bytes);
  }

  TextScanner in_;
  const MeshSource& source_;
  TriangleMesh mesh_;
  UnplacedVertices unplaced_;
  bool hasUvs_ = false, hasColors_ = false, hasNormals_ = false;
  NormalOrder order_;
  std::vector<std::array<double, 7>> rows_;  // of vertices with colors: what follows the position
  std::vector<std::uint8_t> rowNumbers_;     // how many numbers each has
  std::vector<std::array<double, 4>> colors_, faceColors_;
  std::vector<Vec2f> vertexUvs_;
  std::vector<double> numbers_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3d> points_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

void appendColor(std::string& out, const std::array<float, 4>& color) {
  for (const std::uint8_t sample : toRgba8(color)) {
    out += ' ';
    appendNumber(out, std::uint32_t{sample});
  }
}

}  // namespace

TriangleMesh parseOff(std::string_view bytes, const MeshSource& source) {
  return OffReader(bytes, source).read();
}

std::string formatOff(const TriangleMesh& mesh, bool yUp, const Progress& progress,
                      FaceNumbers numbers) {
  const auto faces = faceOutlines(mesh, numbers, std::numeric_limits<std::size_t>::max());
  const Progress vertices = progress.part(0, 0.4), triangles = progress.part(0.4, 1);
  std::string out = mesh.hasColors() ? "COFF\n" : "OFF\n";
  out.reserve(out.size() + mesh.positions.size() * 70 + mesh.triangles.size() * 26);
  appendNumber(out, static_cast<std::uint32_t>(mesh.positions.size()));
  out += ' ' + std::to_string(faces.size()) + " 0\n";
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    reportNowAndThen(vertices, "writing vertices", v, mesh.positions.size());
    const Vec3d p = toFileAxes(mesh.positions[v], yUp);
    appendNumber(out, p.x);
    for (const double c : {p.y, p.z}) {
      out += ' ';
      appendNumber(out, c);
    }
    if (mesh.hasColors()) appendColor(out, mesh.colors[v]);
    out += '\n';
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    reportNowAndThen(triangles, "writing triangles", f, faces.size());
    appendNumber(out, static_cast<std::uint32_t>(faces[f].size()));
    for (const TriangleCorner& c : faces[f]) {
      out += ' ';
      appendNumber(out, mesh.triangles[c.triangle][c.corner]);
    }
    if (mesh.hasMaterials()) {
      const std::uint32_t material = mesh.triangleMaterials[faces[f][0].triangle];
      appendColor(out, mesh.materials[material].baseColor);
    }
    out += '\n';
  }
  return out;
}

}  // namespace exemplar
