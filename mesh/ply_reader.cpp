// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "mesh/face_outlines.h"
#include "mesh/mesh_formats.h"
#include "mesh/ply_rows.h"
#include "mesh/polygon.h"
#include "mesh/unplaced_vertices.h"

namespace exemplar {
namespace {

using namespace ply;

/// The colors of an element's rows. Numbers of one byte count to 255. Others count to 1, 255 or
/// 65535, whatever their type: the largest one in the whole file decides; alpha by itself.
class Colors {
 public:
  Colors() = default;
  explicit Colors(const Element& e)
      : index_{e.find({"red", "r", "diffuse_red"}), e.find({"green", "g", "diffuse_green"}),
               e.find({"blue", "b", "diffuse_blue"}), e.find({"alpha", "a"})} {
    for (int c = 0; c < 4; ++c) {
      if (index_[c] < 0) continue;
      const Type type = e.properties[index_[c]].type;
      isReal_[c] = type >= Type::Float;
      isShort_[c] = type == Type::Uint16 || type == Type::Int16;
    }
  }
  bool present() const { return index_[0] >= 0 && index_[1] >= 0 && index_[2] >= 0; }
  bool empty() const { return colors_.empty(); }
  /// Whether a row had a color that is no number; it counts as a row without one.
  bool hasNan() const { return hasNan_; }

  /// Adds the color of the body's row, `times` times.
  void add(const Body& body, std::size_t times = 1) {
    std::array<float, 4> color{-1, -1, -1, -1};
    for (int c = 0; c < 4; ++c) {
      if (index_[c] < 0) continue;
      const double value = body.scalar(index_[c]);
      if (std::isnan(value)) {
        color.fill(-1);
        hasNan_ = true;
        break;
      }
      if (!(value >= -0.5 && value < 65535.5)) body.fail("a color is out of range");
      color[c] = static_cast<float>(std::max(0.0, value));
      most_[c] = std::max(most_[c], value);
    }
    colors_.insert(colors_.end(), times, color);
  }

  /// The colors as bytes, sRGB and opacity.
  std::vector<std::array<std::uint8_t, 4>> bytes(const Body& body) const {
    std::array<double, 4> scale{};
    const double mostRgb = std::max({most_[0], most_[1], most_[2]});
    for (int c = 0; c < 4; ++c) scale[c] = scaleOf(c, c < 3 ? mostRgb : most_[3]);
    std::vector<std::array<std::uint8_t, 4>> result;
    result.reserve(colors_.size());
    for (const auto& color : colors_) {
      auto& bytes = result.emplace_back();
      for (int c = 0; c < 4; ++c) {
        const double value = color[c] < 0 ? 255 : static_cast<double>(color[c]) * scale[c];
        if (!isReal_[c] && !(value < 255.5)) body.fail("a color is out of range");
        bytes[c] = static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
      }
    }
    return result;
  }

 private:
  /// What makes a component one of 0..255.
  double scaleOf(int c, double most) const {
    if (isReal_[c] && most <= 2) return 255;
    return (isReal_[c] || isShort_[c]) && most > 255 ? 1 / 257.0 : 1;
  }

  std::array<int, 4> index_{-1, -1, -1, -1};
  std::array<bool, 4> isReal_{}, isShort_{};
  std::array<double, 4> most_{};
  bool hasNan_ = false;
  std::vector<std::array<float, 4>> colors_;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const MeshSource& source)
      : in_(bytes, source.name), source_(source) {}

  TriangleMesh read() {
    header_ = readHeader(in_);
    Body body(in_, header_.encoding, source_.progress);
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) continue;
      body.begin(element);
      if (element.name == "vertex") {
        if (hasVertices_) body.fail("the file has two 'vertex' elements");
        readVertices(element, body);
        hasVertices_ = true;
      } else if (element.name == "face") {
        readFaces(element, body);
      } else if (element.name == "tristrips") {
        readStrips(element, body);
      } else if (element.name == "material" && element.find({"linear_red"}) >= 0) {
        readMaterials(element, header_, body);
      } else if (element.name == "copy" && element.find({"vertex"}) >= 0) {
        readCopies(element, body);
      } else {
        for (std::uint64_t i = 0; i < element.count; ++i) body.readRow();
      }
    }
    finish(body);
    joinCopies();
    return std::move(mesh_);
  }

 private:
  void readVertices(const Element& element, Body& body) {
    const int x = element.find({"x"}), y = element.find({"y"}), z = element.find({"z"});
    const int u = element.find({"s", "u", "texture_u", "texture_s"});
    const int v = element.find({"t", "v", "texture_v", "texture_t"});
    vertexColors_ = Colors(element);
    if (x < 0 || y < 0 || z < 0) body.fail("the 'vertex' element has no x, y and z");
    mesh_.positions.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.readRow();
      Vec3d p{body.scalar(x), body.scalar(y), body.scalar(z)};
      if (const char* problem = coordinateProblem(p)) {
        unplaced_.add({mesh_.positions.size(), problem, in_.line()});
        p = {};
      }
      mesh_.positions.push_back(p);
      if (vertexColors_.present()) vertexColors_.add(body);
      if (u >= 0 && v >= 0) vertexUvs_.push_back(uv(body.scalar(u), body.scalar(v)));
    }
  }

  /// The last vertices may be copies that `formatPly` made for their normals.
  void readCopies(const Element& element, Body& body) {
    const int vertex = element.find({"vertex"});
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.readRow();
      copies_.push_back(body.scalar(vertex));
    }
  }

  /// Joins copies with their vertices; none where a program between us has changed the vertices.
  void joinCopies() {
    if (copies_.empty() || copies_.size() >= mesh_.positions.size()) return;
    const std::size_t originals = mesh_.positions.size() - copies_.size();
    for (std::size_t i = 0; i < copies_.size(); ++i) {
      const double v = copies_[i];
      if (!(v >= 0 && v < static_cast<double>(originals)) || v != std::floor(v)) return;
      const std::size_t original = static_cast<std::size_t>(v), copy = originals + i;
      if (mesh_.positions[original] != mesh_.positions[copy]) return;
      if (mesh_.hasColors() && mesh_.colors[original] != mesh_.colors[copy]) return;
    }
    for (auto& triangle : mesh_.triangles) {
      for (std::uint32_t& v : triangle)
        if (v >= originals) v = static_cast<std::uint32_t>(copies_[v - originals]);
    }
    mesh_.positions.resize(originals);
    if (mesh_.hasColors()) mesh_.colors.resize(originals);
  }

  Vec2f uv(double u, double v) const {
    if (!(std::abs(u) < 1e15 && std::abs(v) < 1e15)) {
      source_.warn("texture coordinates that are NaN or too large are taken as 0");
      return {};
    }
    return {static_cast<float>(u), static_cast<float>(v)};
  }

  std::uint32_t vertexIndex(double value, const Body& body) const {
    if (!(value >= 0 && value < static_cast<double>(mesh_.positions.size())) ||
        value != std::floor(value)) {
      body.fail("a face names vertex " +
                (std::abs(value) < 1e15 ? std::to_string(static_cast<std::int64_t>(value)) : "?") +
                " of " + std::to_string(mesh_.positions.size()));
    }
    return static_cast<std::uint32_t>(value);
  }

  /// A face as the file has it: its vertices, and what else it says.
  struct Face {
    std::vector<double> corners, uvs;
    double material = 0, texture = 0;
  };

  void readFaces(const Element& element, Body& body) {
    const int indices = element.find({"vertex_indices", "vertex_index"}, true);
    const int texcoord = element.find({"texcoord"}, true);
    const int material = element.find({"material_index"});
    const int texture = element.find({"texnumber", "texture_index"});
    faceColors_ = Colors(element);
    if (indices < 0) body.fail("the 'face' element has no vertex_indices");
    hasFaceUvs_ = texcoord >= 0;
    hasMaterialIndices_ = material >= 0;
    hasTextureIndices_ = texture >= 0;
    const std::vector<double> none;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.readRow();
      const std::vector<double>& uvs = texcoord >= 0 ? body.list(texcoord) : none;
      const double ofMaterial = material >= 0 ? body.scalar(material) : 0;
      const double ofTexture = texture >= 0 ? body.scalar(texture) : 0;
      if (hasVertices_) {
        const std::size_t before = mesh_.triangles.size();
        addFace(body.list(indices), uvs, ofMaterial, ofTexture, body);
        if (faceColors_.present()) faceColors_.add(body, mesh_.triangles.size() - before);
      } else {
        // The vertices come later.
        if (faceColors_.present()) faceColors_.add(body);
        pendingFaces_.push_back({body.list(indices), uvs, ofMaterial, ofTexture});
      }
    }
  }

  /// Adds a face's triangles.
  void addFace(const std::vector<double>& corners, const std::vector<double>& uvs, double material,
               double texture, const Body& body) {
    if (!pendingFaces_.empty()) triangleCounts_.push_back(0);
    if (corners.size() < 3) {
      ++shortFaces_;
      return;
    }
    points_.clear();
    pieces_.clear();
    for (const double c : corners) points_.push_back(mesh_.positions[vertexIndex(c, body)]);
    if (!triangulate(points_, pieces_)) {
      body.fail("a concave face has " + std::to_string(corners.size()) + " corners; at most " +
                std::to_string(kMostCorners) + " can be cut into triangles");
    }
    const bool hasUvs = hasFaceUvs_ && uvs.size() == 2 * corners.size();
    const auto cornerUv = [&](std::uint32_t c) {
      return hasUvs ? uv(uvs[2 * c], uvs[2 * c + 1]) : Vec2f{};
    };
    for (const auto& [a, b, c] : pieces_) {
      mesh_.triangles.push_back({static_cast<std::uint32_t>(corners[a]),
                                 static_cast<std::uint32_t>(corners[b]),
                                 static_cast<std::uint32_t>(corners[c])});
      if (hasFaceUvs_) mesh_.uvs.push_back({cornerUv(a), cornerUv(b), cornerUv(c)});
      if (hasMaterialIndices_) materialIndices_.push_back(material);
      if (hasTextureIndices_) textureIndices_.push_back(texture);
    }
    if (!pendingFaces_.empty()) triangleCounts_.back() = static_cast<std::uint32_t>(pieces_.size());
  }

  /// Triangle strips, as the Stanford scans have them: -1 ends a strip.
  void readStrips(const Element& element, Body& body) {
    const int indices = element.find({"vertex_indices", "vertex_index"}, true);
    if (indices < 0) body.fail("the 'tristrips' element has no vertex_indices");
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.readRow();
      const std::vector<double>& strip = body.list(indices);
      std::size_t begin = 0;
      for (std::size_t k = 0; k < strip.size(); ++k) {
        if (strip[k] == -1) {
          begin = k + 1;
          continue;
        }
        const std::uint32_t c = vertexIndex(strip[k], body);
        if (k < begin + 2) continue;
        const std::uint32_t a = static_cast<std::uint32_t>(strip[k - 2]);
        const std::uint32_t b = static_cast<std::uint32_t>(strip[k - 1]);
        if (a == b || b == c || c == a) continue;  // how strips are joined
        if ((k - begin) % 2 == 0) {
          mesh_.triangles.push_back({a, b, c});
        } else {
          mesh_.triangles.push_back({b, a, c});
        }
      }
    }
  }

  void readMaterials(const Element& element, const Header& header, Body& body) {
    const char* names[] = {"linear_red",   "linear_green",   "linear_blue",
                           "opacity",      "metallic",       "roughness",
                           "emission_red", "emission_green", "emission_blue"};
    std::array<int, 9> at{};
    for (int i = 0; i < 9; ++i) at[i] = element.find({names[i]});
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.readRow();
      Material m;
      float* numbers[] = {&m.baseColor[0], &m.baseColor[1], &m.baseColor[2],
                          &m.baseColor[3], &m.metallic,     &m.roughness,
                          &m.emission.x,   &m.emission.y,   &m.emission.z};
      for (int k = 0; k < 9; ++k) {
        if (at[k] < 0) continue;
        const double value = body.scalar(at[k]);
        if (!(std::abs(value) < 1e15)) body.fail("a material's number is NaN or too large");
        *numbers[k] = static_cast<float>(value);
      }
      const auto name = header.materialNames.find(i);
      if (name != header.materialNames.end()) m.name = name->second;
      fileMaterials_.push_back(std::move(m));
    }
  }

  /// The colors of triangles, one for each.
  std::vector<std::array<std::uint8_t, 4>> triangleColors(const Body& body) const {
    const auto colors = faceColors_.bytes(body);
    if (pendingFaces_.empty()) return colors;
    // Of faces that came before their vertices there is a color for each face.
    std::vector<std::array<std::uint8_t, 4>> spread;
    for (std::size_t f = 0; f < colors.size(); ++f) {
      spread.insert(spread.end(), triangleCounts_[f], colors[f]);
    }
    return spread;
  }

  void finish(const Body& body) {
    for (const Face& f : pendingFaces_) addFace(f.corners, f.uvs, f.material, f.texture, body);
    if (const auto* vertex = unplaced_.firstUsed(mesh_, source_)) {
      const std::string what = "vertex " + std::to_string(vertex->index) + " " + vertex->problem;
      if (header_.encoding == Encoding::Ascii) in_.fail(vertex->line, what);
      body.fail(what);
    }
    if (shortFaces_ > 0) {
      source_.warn("leaving out " + counted(shortFaces_, "face") +
                   " with fewer than three corners");
    }
    if (vertexColors_.hasNan() || faceColors_.hasNan()) source_.warn(kNanColors);
    for (const auto& color : vertexColors_.bytes(body)) mesh_.colors.push_back(fromRgba8(color));
    const std::size_t triangles = mesh_.triangles.size();
    if (mesh_.uvs.size() != triangles) mesh_.uvs.clear();
    if (mesh_.uvs.empty() && !vertexUvs_.empty()) {
      for (const auto& [a, b, c] : mesh_.triangles) {
        mesh_.uvs.push_back({vertexUvs_[a], vertexUvs_[b], vertexUvs_[c]});
      }
    }
    if (!fileMaterials_.empty() && materialIndices_.size() == triangles) {
      mesh_.materials = std::move(fileMaterials_);
      for (const double m : materialIndices_) {
        if (!(m >= 0 && m < static_cast<double>(mesh_.materials.size())) || m != std::floor(m)) {
          body.fail("a face names a material that does not exist: the file has " +
                    std::to_string(mesh_.materials.size()));
        }
        mesh_.triangleMaterials.push_back(static_cast<std::uint32_t>(m));
      }
    } else if (loadTextures()) {
      if (!faceColors_.empty()) source_.warn("face colors are left out where a texture is");
    } else if (!faceColors_.empty()) {
      const auto colors = triangleColors(body);
      if (colors.size() == triangles) setFaceColors(mesh_, colors);
    }
  }

  /// A material for each picture that the header names; false where there is none to show.
  bool loadTextures() {
    if (header_.textureFiles.empty()) return false;
    if (!mesh_.hasUvs()) {
      source_.warn("a texture is named, but no texture coordinates; it is left out");
      return false;
    }
    bool any = false;
    for (const std::string& file : header_.textureFiles) {
      const std::string shown = TextScanner::shown(file);
      Material material{.name = file.substr(file.find_last_of("/\\") + 1),
                        .baseColor = {1, 1, 1, 1}};
      std::optional<std::string> bytes = source_.siblingBytes(file);
      const std::string mimeType = bytes ? imageMimeType(*bytes) : "";
      if (mimeType.empty()) {
        source_.warn("the texture " + shown +
                     (bytes ? " is neither PNG nor JPEG" : " is not found") + " and is left out");
        material.baseColor = Material{}.baseColor;
      } else {
        any = true;
        material.baseColorTexture = static_cast<std::uint32_t>(mesh_.textures.size());
        std::string name = material.name;
        const auto isTaken = [&](const std::string& n) {
          return std::any_of(mesh_.textures.begin(), mesh_.textures.end(),
                             [&](const Texture& t) { return t.name == n; });
        };
        for (int n = 2; isTaken(name); ++n) name = std::to_string(n) + "_" + material.name;
        mesh_.textures.push_back({name, mimeType, std::move(*bytes)});
      }
      mesh_.materials.push_back(std::move(material));
    }
    if (!any) {
      mesh_.materials.clear();
      return false;
    }
    textureIndices_.resize(mesh_.triangles.size(), 0);
    for (const double t : textureIndices_) {
      const bool exists = t >= 0 && t < static_cast<double>(mesh_.materials.size());
      mesh_.triangleMaterials.push_back(exists ? static_cast<std::uint32_t>(t) : 0);
    }
    return true;
  }

  TextScanner in_;
  const MeshSource& source_;
  Header header_;
  TriangleMesh mesh_;
  UnplacedVertices unplaced_;
  bool hasVertices_ = false;
  Colors vertexColors_, faceColors_;
  std::vector<Vec2f> vertexUvs_;
  std::vector<Face> pendingFaces_;  // that came before the vertices
  std::vector<std::uint32_t> triangleCounts_;
  std::vector<double> materialIndices_, textureIndices_, copies_;
  std::vector<Material> fileMaterials_;
  bool hasFaceUvs_ = false, hasMaterialIndices_ = false, hasTextureIndices_ = false;
  std::size_t shortFaces_ = 0;
  std::vector<Vec3d> points_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

}  // namespace

TriangleMesh parsePly(std::string_view bytes, const MeshSource& source) {
  return PlyReader(bytes, source).read();
}

}  // namespace exemplar
