// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

#include "core/error.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "mesh/face_outlines.h"
#include "mesh/mesh_formats.h"
#include "mesh/polygon.h"

namespace exemplar {
namespace {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct Property {
  std::string name;
  Type type = Type::Float;
  bool isList = false;
  Type countType = Type::Uint8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  /// The property with one of these names, or -1.
  int find(std::initializer_list<std::string_view> names, bool list = false) const {
    for (const std::string_view wanted : names) {
      for (std::size_t i = 0; i < properties.size(); ++i) {
        if (properties[i].name == wanted && properties[i].isList == list)
          return static_cast<int>(i);
      }
    }
    return -1;
  }
};

enum class Encoding { Ascii, Little, Big };

struct Header {
  Encoding encoding = Encoding::Ascii;
  std::vector<Element> elements;
  std::map<std::size_t, std::string> materialNames;
  std::vector<std::string> textureFiles;  ///< as MeshLab and scanners name them
};

Type typeOf(std::string_view word, TextScanner& in) {
  constexpr std::string_view kNames[] = {"char", "uchar", "short", "ushort",
                                         "int",  "uint",  "float", "double"};
  constexpr std::string_view kSizedNames[] = {"int8",  "uint8",  "int16",   "uint16",
                                              "int32", "uint32", "float32", "float64"};
  for (int i = 0; i < 8; ++i) {
    if (word == kNames[i] || word == kSizedNames[i]) return static_cast<Type>(i);
  }
  in.fail("'" + TextScanner::shown(word) + "' is not a PLY type");
}

Header readHeader(TextScanner& in) {
  Header header;
  if (!in.nextLine() || in.rest() != "ply") in.fail("not a PLY file: it should begin with 'ply'");
  bool hasFormat = false;
  while (in.nextLine()) {
    const std::string_view key = in.word();
    if (key == "end_header") {
      if (!hasFormat) in.fail("the header has no 'format' line");
      return header;
    }
    if (key == "format") {
      const std::string_view encoding = in.word();
      if (encoding == "ascii") {
        header.encoding = Encoding::Ascii;
      } else if (encoding == "binary_little_endian") {
        header.encoding = Encoding::Little;
      } else if (encoding == "binary_big_endian") {
        header.encoding = Encoding::Big;
      } else {
        in.fail(
            "'" + TextScanner::shown(encoding) +
            "' is not a PLY format; it should be ascii, binary_little_endian or binary_big_endian");
      }
      hasFormat = true;
    } else if (key == "element") {
      Element& element = header.elements.emplace_back();
      element.name = in.word();
      const std::int64_t count = in.integer("an element's count");
      if (count < 0) in.fail("an element's count should not be negative");
      element.count = static_cast<std::uint64_t>(count);
    } else if (key == "property") {
      if (header.elements.empty()) in.fail("a property comes before the first element");
      Property property;
      std::string_view type = in.word();
      if (type == "list") {
        property.isList = true;
        property.countType = typeOf(in.word(), in);
        if (property.countType >= Type::Float) in.fail("a list's count should be a whole number");
        type = in.word();
      }
      property.type = typeOf(type, in);
      property.name = in.word();
      if (property.name.empty()) in.fail("a property has no name");
      header.elements.back().properties.push_back(std::move(property));
    } else if (key == "comment") {
      const std::string_view kind = in.word();
      // "comment material 3 NAME": how `formatPly` keeps the names of materials.
      if (lowerCase(kind) == "texturefile") {
        header.textureFiles.emplace_back(unquoted(in.rest()));
      } else if (kind == "material" && in.peek() >= '0' && in.peek() <= '9') {
        const std::int64_t index = in.integerPrefix("a material's index");
        if (index >= 0) header.materialNames[static_cast<std::size_t>(index)] = in.rest();
      }
    }
  }
  in.fail("the header has no 'end_header' line");
}

/// Reads the body's elements one after another; each element as one number for each property, and
/// lists on the side.
class Body {
 public:
  Body(TextScanner& in, Encoding encoding, const Progress& progress)
      : in_(in), encoding_(encoding), bytes_(in.afterLine()), progress_(progress) {
    const bool nativeIsBig = std::endian::native == std::endian::big;
    swap_ = (encoding == Encoding::Big) != nativeIsBig;
  }

  /// Prepares for an element's rows; refuses a count that the rest of the file cannot hold.
  void begin(const Element& element) {
    element_ = &element;
    scalars_.assign(element.properties.size(), 0);
    words_.assign(element.properties.size(), {});
    hasWords_ = false;
    lists_.resize(element.properties.size());
    std::uint64_t least = 0;
    for (const Property& p : element.properties) {
      least += encoding_ == Encoding::Ascii
                   ? 2
                   : kBytes[static_cast<int>(p.isList ? p.countType : p.type)];
    }
    const std::uint64_t left =
        encoding_ == Encoding::Ascii ? in_.bytesLeft() + 1 : bytes_.size() - position_;
    if (element.count > 0 && least > 0 && element.count > left / least) {
      fail("the file is truncated: its header promises " + std::to_string(element.count) + " of '" +
           TextScanner::shown(element.name) + "' and " + std::to_string(left) + " bytes are left");
    }
  }

  void readRow() {
    if (rows_++ % 16384 == 0) report();
    if (encoding_ == Encoding::Ascii) {
      readTextRow();
    } else {
      readBinaryRow();
    }
  }

  double scalar(int property) const {
    if (hasWords_) checkNumber(property);
    return scalars_[property];
  }
  const std::vector<double>& list(int property) const { return lists_[property]; }

  [[noreturn]] void fail(const std::string& message) const {
    if (encoding_ == Encoding::Ascii) in_.fail(message);
    throw InputError(in_.name() + ": " + message);
  }

 private:
  [[gnu::noinline]] void checkNumber(int property) const {
    if (words_[property].empty()) return;
    fail(element_->properties[property].name + " should be a number, not '" +
         TextScanner::shown(words_[property]) + "'");
  }

  [[gnu::noinline]] void report() const { progress_.report("reading", fraction()); }

  double fraction() const {
    if (encoding_ == Encoding::Ascii) return in_.fraction();
    return static_cast<double>(position_) / static_cast<double>(bytes_.size() + 1);
  }

  void readTextRow() {
    do {
      if (!in_.nextLine())
        fail("the file is truncated: a '" + TextScanner::shown(element_->name) + "' is missing");
    } while (in_.atLineEnd());
    if (hasWords_) std::fill(words_.begin(), words_.end(), std::string_view());
    hasWords_ = false;
    for (std::size_t i = 0; i < element_->properties.size(); ++i) {
      const Property& p = element_->properties[i];
      if (!p.isList) {
        if (const auto value = in_.tryNumber()) {
          scalars_[i] = *value;
        } else if (in_.atLineEnd()) {
          in_.number(p.name.c_str());
        } else {
          // Not-a-numbers have many spellings ("-1.#IND"); they matter only where they are used.
          words_[i] = in_.word();
          hasWords_ = true;
        }
        continue;
      }
      const std::int64_t count = in_.integer("a list's count");
      if (count < 0 || static_cast<std::uint64_t>(count) > in_.bytesLeft())
        fail("a list's count is wrong");
      lists_[i].clear();
      for (std::int64_t k = 0; k < count; ++k) lists_[i].push_back(in_.number(p.name.c_str()));
    }
  }

  void readBinaryRow() {
    for (std::size_t i = 0; i < element_->properties.size(); ++i) {
      const Property& p = element_->properties[i];
      if (!p.isList) {
        require(kBytes[static_cast<int>(p.type)]);
        scalars_[i] = take(p.type);
        continue;
      }
      require(kBytes[static_cast<int>(p.countType)]);
      const double count = take(p.countType);
      if (count < 0) fail("a list's count is negative");
      require(count * kBytes[static_cast<int>(p.type)]);
      lists_[i].resize(static_cast<std::size_t>(count));
      for (double& value : lists_[i]) value = take(p.type);
    }
  }

  void require(double bytes) const {
    if (bytes > static_cast<double>(bytes_.size() - position_)) {
      fail("the file is truncated: it ends in the middle of a '" +
           TextScanner::shown(element_->name) + "'");
    }
  }

  template <class T>
  double takeAs() {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    if (swap_) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  double take(Type type) {
    switch (type) {
      case Type::Int8:
        return takeAs<std::int8_t>();
      case Type::Uint8:
        return takeAs<std::uint8_t>();
      case Type::Int16:
        return takeAs<std::int16_t>();
      case Type::Uint16:
        return takeAs<std::uint16_t>();
      case Type::Int32:
        return takeAs<std::int32_t>();
      case Type::Uint32:
        return takeAs<std::uint32_t>();
      case Type::Float:
        return takeAs<float>();
      case Type::Double:
        return takeAs<double>();
    }
    return 0;
  }

  TextScanner& in_;
  Encoding encoding_;
  std::string_view bytes_;
  const Progress& progress_;
  std::size_t position_ = 0, rows_ = 0;
  bool swap_ = false;
  const Element* element_ = nullptr;
  std::vector<double> scalars_;
  std::vector<std::string_view> words_;  ///< of the row: what is no number, where `hasWords_`
  bool hasWords_ = false;
  std::vector<std::vector<double>> lists_;
};

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
  std::size_t count() const { return colors_.size(); }

  /// Adds the color of the body's row, `times` times.
  void add(const Body& body, std::size_t times = 1) {
    std::array<float, 4> color{-1, -1, -1, -1};
    for (int c = 0; c < 4; ++c) {
      if (index_[c] < 0) continue;
      const double value = body.scalar(index_[c]);
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
      const Vec3d p{body.scalar(x), body.scalar(y), body.scalar(z)};
      if (const char* problem = coordinateProblem(p)) {
        body.fail("vertex " + std::to_string(i) + " " + problem);
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
    if (shortFaces_ > 0) {
      source_.warn("leaving out " + counted(shortFaces_, "face") +
                   " with fewer than three corners");
    }
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

TriangleMesh parsePly(std::string_view bytes, const MeshSource& source) {
  return PlyReader(bytes, source).read();
}

std::string formatPly(const TriangleMesh& mesh, bool yUp, MeshNormals normals,
                      const Progress& progress, FaceNumbers numbers) {
  constexpr std::size_t kMostCornersOfFace = 127;  // two texture coordinates each, in a byte
  const auto faces = faceOutlines(mesh, numbers, kMostCornersOfFace);
  const Progress vertices = progress.part(0.3, 0.5), triangles = progress.part(0.5, 1);
  const SplitVertices split =
      splitVertices(mesh, shadingNormals(mesh, normals, progress.part(0, 0.3)),
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
