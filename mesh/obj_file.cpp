// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "core/error.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "mesh/across_formats.h"
#include "mesh/color.h"
#include "mesh/face_outlines.h"
#include "mesh/mesh_formats.h"
#include "mesh/mtl.h"
#include "mesh/object_names.h"
#include "mesh/polygon.h"
#include "mesh/unplaced_vertices.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;
/// A texture coordinate that a corner names and that cannot be; so far past the last one that no
/// file gets there.
constexpr std::uint32_t kMissing = kNone - 1;
/// The color of a vertex without one; no color in a file has such numbers.
constexpr std::array<double, 4> kUncolored{-1e9, -1e9, -1e9, -1e9};

/// Reads an `.obj`. Materials are collected by name while reading and looked up at the end, since
/// libraries may be named anywhere.
class ObjReader {
 public:
  ObjReader(std::string_view bytes, const MeshSource& source)
      : in_(bytes, source.name, {.continued = true, .comments = true}), source_(source) {}

  TriangleMesh read() {
    for (std::size_t line = 0; in_.nextLine(); ++line) {
      if (line % 16384 == 0) source_.progress.report("reading", in_.fraction());
      const std::string_view key = in_.word();
      if (key == "v") {
        readVertex();
      } else if (key == "vt") {
        readUv();
      } else if (key == "f" || key == "fo") {  // "fo" until 1991
        readFace();
      } else if (key == "o") {
        nameObject(std::string(in_.rest()));
      } else if (key == "usemtl") {
        useMaterial(std::string(in_.rest()));
      } else if (key == "mtllib") {
        readLibrary(std::string(unquoted(in_.rest())));
      } else if (key == "surf" || key == "curv") {
        source_.warn("free-form curves and surfaces are left out");
      }
    }
    addPendingFaces();
    if (const auto* vertex = unplaced_.firstUsed(mesh_, source_))
      in_.fail(vertex->line, std::string("the vertex ") + vertex->problem);
    resolveColors();
    if (hasUvs_) resolveUvs();
    resolveMaterials();
    if (objects_ != 1) mesh_.name.clear();
    objectIndex_.moveTo(mesh_);
    if (shortFaces_ > 0) {
      source_.warn("leaving out " + counted(shortFaces_, "face") +
                   " with fewer than three corners");
    }
    return std::move(mesh_);
  }

 private:
  struct Corner {
    std::uint32_t position, uv;
  };
  /// A face that names vertices which come after it in the file.
  struct PendingFace {
    std::size_t begin, end;  ///< its corners in `pendingCorners_`
    std::uint32_t object;
    std::uint32_t material;
    std::int64_t line;
  };

  void readVertex() {
    Vec3d p;
    p.x = in_.number("x");
    p.y = in_.number("y");
    p.z = in_.number("z");
    if (const char* problem = coordinateProblem(p)) {
      unplaced_.add({mesh_.positions.size(), problem, in_.line()});
      p = {};
    }
    double more[4];
    int count = 0;
    while (count < 4 && !in_.atLineEnd()) more[count++] = in_.number("a vertex's number");
    mesh_.positions.push_back(p);
    // x y z [w] or x y z r g b [a].
    if (count >= 3) {
      colors_.resize(mesh_.positions.size() - 1, kUncolored);
      colors_.push_back({more[0], more[1], more[2], count == 4 ? more[3] : 1});
      if (std::ranges::any_of(colors_.back(), [](double c) { return std::isnan(c); })) {
        colors_.back() = kUncolored;
        source_.warn(kNanColors);
      } else if (std::ranges::any_of(colors_.back(),
                                     [](double c) { return !(std::abs(c) < 1e6); })) {
        in_.fail("a vertex color should be between 0 and 1, or 255");
      }
    } else if (!colors_.empty()) {
      colors_.push_back(kUncolored);
    }
    if (mesh_.positions.size() == kNone) in_.fail("more than 4294967294 vertices");
  }

  /// Vertex colors to linear ones. Whole files count either to 1 or to 255 (or 65535), and only a
  /// component above 1 decides which; a few writers count only the alpha to 1.
  void resolveColors() {
    if (colors_.empty()) return;
    double most = 0, mostAlpha = 0;
    bool whole = true;
    for (const auto& c : colors_) {
      if (c == kUncolored) continue;
      for (int i = 0; i < 3; ++i) {
        most = std::max(most, c[i]);
        whole = whole && c[i] == std::floor(c[i]);
      }
      mostAlpha = std::max(mostAlpha, c[3]);
    }
    const auto rangeOf = [&](double largest) {
      return largest <= 1 || !(whole || largest > 2) ? 1.0 : largest <= 255 ? 255.0 : 65535.0;
    };
    const double range = rangeOf(most), alphaRange = rangeOf(mostAlpha);
    mesh_.colors.reserve(colors_.size());
    for (const auto& c : colors_) {
      if (c == kUncolored) {
        mesh_.colors.push_back({1, 1, 1, 1});
        continue;
      }
      const auto linear = [&](double s) { return static_cast<float>(srgbToLinear(s / range)); };
      mesh_.colors.push_back(
          {linear(c[0]), linear(c[1]), linear(c[2]), static_cast<float>(c[3] / alphaRange)});
    }
  }

  void readUv() {
    Vec2f uv{static_cast<float>(in_.number("u")),
             in_.atLineEnd() ? 0.0f : static_cast<float>(in_.number("v"))};
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
      source_.warn("texture coordinates that are NaN or infinite are taken as 0");
      uv = {};
    }
    uvs_.push_back(uv);
  }

  /// An index from the file, from 1 or backwards from -1, as an index from 0; `kNone` where it
  /// points before the first. It may point behind what has been read.
  std::uint32_t index(std::int64_t number, std::size_t count) const {
    const std::int64_t i = number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
    return number == 0 || i < 0 || i >= kNone ? kNone : static_cast<std::uint32_t>(i);
  }

  [[noreturn]] void failAtVertex(std::int64_t line, std::int64_t number) const {
    in_.fail(line, "vertex " + std::to_string(number) + " does not exist: the file has " +
                       std::to_string(mesh_.positions.size()));
  }

  void readFace() {
    corners_.clear();
    bool pending = !pending_.empty();
    const std::size_t vertices = mesh_.positions.size();
    while (!in_.atLineEnd()) {
      const std::int64_t number = in_.integerPrefix("vertex");
      Corner corner{index(number, vertices), kNone};
      if (corner.position == kNone) failAtVertex(in_.line(), number);
      pending = pending || corner.position >= vertices;
      if (in_.take('/')) {
        if (in_.peekHere() != '/' && !in_.atWordEnd()) {
          corner.uv = index(in_.integerPrefix("texture coordinate"), uvs_.size());
          if (corner.uv == kNone) corner.uv = kMissing;
        }
        // The normal's index is not needed; that it is a number is checked.
        if (in_.take('/') && !in_.atWordEnd()) in_.integerPrefix("the normal's index");
      }
      if (!in_.atWordEnd()) in_.fail("a face's corner should be V, V/T, V//N or V/T/N");
      corners_.push_back(corner);
    }
    if (corners_.size() < 3) {
      ++shortFaces_;
    } else if (pending) {
      const std::size_t begin = pendingCorners_.size();
      pendingCorners_.insert(pendingCorners_.end(), corners_.begin(), corners_.end());
      pending_.push_back({begin, pendingCorners_.size(), object_, material_, in_.line()});
    } else {
      addFace(in_.line());
    }
  }

  /// Adds the faces from the first on that named a vertex before it came, in the file's order.
  void addPendingFaces() {
    for (const PendingFace& face : pending_) {
      corners_.assign(pendingCorners_.begin() + static_cast<std::ptrdiff_t>(face.begin),
                      pendingCorners_.begin() + static_cast<std::ptrdiff_t>(face.end));
      for (const Corner& c : corners_) {
        if (c.position >= mesh_.positions.size())
          failAtVertex(face.line, std::int64_t{c.position} + 1);
      }
      object_ = face.object;
      material_ = face.material;
      addFace(face.line);
    }
  }

  void addFace(std::int64_t line) {
    if (corners_.size() == 3) {
      addTriangle(corners_[0], corners_[1], corners_[2]);
      return;
    }
    points_.clear();
    pieces_.clear();
    for (const Corner& c : corners_) points_.push_back(mesh_.positions[c.position]);
    if (!triangulate(points_, pieces_)) {
      in_.fail(line, "a concave face has " + std::to_string(corners_.size()) +
                         " corners; at most " + std::to_string(kMostCorners) +
                         " can be cut into triangles");
    }
    for (const auto& [a, b, c] : pieces_) addTriangle(corners_[a], corners_[b], corners_[c]);
  }

  void addTriangle(const Corner& a, const Corner& b, const Corner& c) {
    mesh_.triangles.push_back({a.position, b.position, c.position});
    uvIndices_.push_back({a.uv, b.uv, c.uv});
    hasUvs_ = hasUvs_ || a.uv != kNone || b.uv != kNone || c.uv != kNone;
    mesh_.triangleMaterials.push_back(material_);
    mesh_.triangleObjects.push_back(object_);
  }

  /// Corners may name no texture coordinate, or one that no `vt` line defines.
  void resolveUvs() {
    std::size_t missing = 0, found = 0;
    const auto at = [&](std::uint32_t i) {
      if (i == kNone) return Vec2f{};
      if (i >= uvs_.size()) {
        ++missing;
        return Vec2f{};
      }
      ++found;
      return uvs_[i];
    };
    mesh_.uvs.reserve(uvIndices_.size());
    for (const auto& [a, b, c] : uvIndices_) {
      const Vec2f uvA = at(a), uvB = at(b), uvC = at(c);
      mesh_.uvs.push_back({uvA, uvB, uvC});
    }
    if (missing > 0) {
      source_.warn("corners name texture coordinates that the file does not have; " +
                   std::string(found > 0 ? "they are taken as 0" : "none are read"));
    }
    if (found == 0) mesh_.uvs.clear();
  }

  void nameObject(const std::string& name) {
    ++objects_;
    mesh_.name = name;
    object_ = objectIndex_.numberOf(name);
  }

  void useMaterial(const std::string& name) {
    const auto [found, added] =
        nameIndex_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (added) names_.push_back(name);
    material_ = found->second;
  }

  void readLibrary(const std::string& file) {
    // One name that may hold blanks, or several names, and a comment.
    if (addLibrary(file)) return;
    bool any = false;
    for (std::size_t begin = 0; begin < file.size() && file[begin] != '#';) {
      const std::size_t end = std::min(file.find_first_of(" \t", begin), file.size());
      if (end != begin && end - begin != file.size()) {
        any = addLibrary(file.substr(begin, end - begin)) || any;
      }
      begin = end + 1;
    }
    if (!any) {
      source_.warn("its material library " + TextScanner::shown(file) +
                   " is not found; materials keep their names only");
    }
  }

  bool addLibrary(const std::string& file) {
    if (!libraries_.insert(file).second) return true;
    const std::optional<std::string> bytes = source_.siblingBytes(file);
    if (!bytes) return false;
    const std::string name = in_.name() + ": " + TextScanner::shown(file);
    for (MtlMaterial& m : parseMtl(*bytes, name, source_.warnings)) {
      library_.push_back(std::move(m));
    }
    return true;
  }

  /// Names with a comment behind them, which only the libraries can distinguish from names with
  /// blanks.
  void dropComments() {
    std::set<std::string> known;
    for (const MtlMaterial& m : library_) known.insert(m.material.name);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      std::string name = names_[i].substr(0, names_[i].find(" #"));
      while (name.ends_with(' ') || name.ends_with('\t')) name.pop_back();
      if (name.size() == names_[i].size() || known.contains(names_[i]) || !known.contains(name))
        continue;
      // The same material under its own name and with a comment is one.
      const auto [found, added] = nameIndex_.try_emplace(name, static_cast<std::uint32_t>(i));
      if (!added) {
        for (std::uint32_t& m : mesh_.triangleMaterials) m = m == i ? found->second : m;
      }
    }
  }

  /// Materials that faces use, in the order of the libraries, then those that no library has in the
  /// order of the faces, then a default one for faces without any.
  void resolveMaterials() {
    dropComments();
    std::vector<bool> isUsed(names_.size() + 1, false);
    for (const std::uint32_t m : mesh_.triangleMaterials)
      isUsed[m == kNone ? names_.size() : m] = true;
    if (std::find(isUsed.begin(), isUsed.end() - 1, true) == isUsed.end() - 1) {
      mesh_.triangleMaterials.clear();
      return;
    }
    std::vector<std::uint32_t> materialOf(names_.size() + 1, kNone);
    for (MtlMaterial& m : library_) {
      const auto found = nameIndex_.find(m.material.name);
      if (found == nameIndex_.end() || !isUsed[found->second]) continue;
      if (materialOf[found->second] != kNone) continue;  // defined twice: the first one holds
      materialOf[found->second] = static_cast<std::uint32_t>(mesh_.materials.size());
      loadPictures(m);
      mesh_.materials.push_back(std::move(m.material));
    }
    for (std::size_t i = 0; i <= names_.size(); ++i) {
      if (!isUsed[i] || materialOf[i] != kNone) continue;
      materialOf[i] = static_cast<std::uint32_t>(mesh_.materials.size());
      mesh_.materials.push_back(i < names_.size() ? Material{.name = names_[i]} : Material{});
    }
    for (std::uint32_t& m : mesh_.triangleMaterials) m = materialOf[m == kNone ? names_.size() : m];
    warnOfPictures("is not found and is left out", "are not found and are left out", missing_);
    warnOfPictures("is no picture and is left out", "are no pictures and are left out",
                   noPictures_);
    warnOfPictures("is neither PNG nor JPEG: it is copied with its material, and not shown",
                   "are neither PNG nor JPEG: they are copied with their materials, and not shown",
                   notShown_);
  }

  /// Gives a material its pictures, and its lines as its source.
  void loadPictures(MtlMaterial& m) {
    std::vector<std::string> numbers;
    for (const MtlMap& map : m.maps) {
      const auto picture = loadPicture(map.file);
      numbers.emplace_back();
      if (!picture) continue;
      const bool shown = isShown(mesh_.textures[*picture]);
      if (map.key == "map_kd" && shown) m.material.baseColorTexture = *picture;
      if (map.key == "map_kd" && !shown) notShown_.push_back(map.file);
      std::vector<std::uint32_t>& pictures = m.material.pictures;
      const auto same = std::find(pictures.begin(), pictures.end(), *picture);
      numbers.back() = std::to_string(same - pictures.begin());
      if (same == pictures.end()) pictures.push_back(*picture);
    }
    if (!m.material.baseColorTexture) m.material.baseColorTransform = {};
    std::string lines = withPictureNumbers(m.lines, numbers);
    if (lines == plainMtlLines(m.material)) {
      m.material.pictures.clear();
      return;
    }
    m.material.source = std::make_shared<MaterialSource>(
        MaterialSource{MaterialSource::Format::Mtl, std::move(lines)});
  }

  static bool isShown(const Texture& texture) {
    return texture.mimeType == "image/png" || texture.mimeType == "image/jpeg";
  }

  /// The picture in a file; none where it is not there or is no picture.
  std::optional<std::uint32_t> loadPicture(const std::string& file) {
    if (file.empty()) return std::nullopt;
    const auto [found, added] = textureOf_.try_emplace(file);
    if (!added) return found->second;
    std::optional<std::string> bytes = source_.siblingBytes(file);
    const std::string mimeType = bytes ? pictureMimeType(*bytes, file) : "";
    if (mimeType.empty()) {
      (bytes ? noPictures_ : missing_).push_back(file);
      return std::nullopt;
    }
    found->second = static_cast<std::uint32_t>(mesh_.textures.size());
    mesh_.textures.push_back({textureName(file), mimeType, std::move(*bytes)});
    return found->second;
  }

  /// One line, however many there are.
  void warnOfPictures(const char* one, const char* several, const std::vector<std::string>& files) {
    if (files.empty()) return;
    if (files.size() == 1) {
      source_.warn("the texture " + TextScanner::shown(files[0]) + " " + one);
      return;
    }
    constexpr std::size_t kMost = 5;
    std::string names;
    for (std::size_t i = 0; i < std::min(files.size(), kMost); ++i)
      names += (i == 0 ? "" : ", ") + TextScanner::shown(files[i]);
    if (files.size() > kMost) names += " and " + std::to_string(files.size() - kMost) + " more";
    source_.warn("the textures " + names + " " + several);
  }

  /// A texture's own name: without folders and without the "STEM_" that `formatObj` puts in front.
  std::string textureName(const std::string& file) {
    const auto baseName = [](const std::string& path) {
      return path.substr(path.find_last_of("/\\") + 1);
    };
    std::string base = baseName(file);
    std::string stem = baseName(in_.name());
    stem = stem.substr(0, stem.rfind('.')) + "_";
    if (base.size() > stem.size() && base.starts_with(stem)) base = base.substr(stem.size());
    std::string unique = base;
    for (int n = 2; !textureNames_.insert(unique).second; ++n)
      unique = std::to_string(n) + "_" + base;
    return unique;
  }

  TextScanner in_;
  const MeshSource& source_;
  TriangleMesh mesh_;
  UnplacedVertices unplaced_;
  std::vector<std::array<double, 4>> colors_;  // as in the file; as many as positions, or none
  std::vector<Vec2f> uvs_;
  std::vector<std::array<std::uint32_t, 3>> uvIndices_;
  bool hasUvs_ = false;
  std::size_t shortFaces_ = 0;

  std::uint32_t material_ = kNone;
  ObjectNames objectIndex_;
  std::uint32_t object_ = 0;  // what comes before any object has no name
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> nameIndex_;
  std::vector<MtlMaterial> library_;
  std::set<std::string> libraries_;
  std::unordered_map<std::string, std::optional<std::uint32_t>> textureOf_;
  std::set<std::string> textureNames_;
  std::vector<std::string> missing_, noPictures_, notShown_;
  std::size_t objects_ = 0;

  std::vector<Corner> corners_;
  std::vector<Corner> pendingCorners_;
  std::vector<PendingFace> pending_;
  std::vector<Vec3d> points_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

/// Text made fit for a line of its own.
std::string lineText(const std::string& wanted) {
  std::string text;
  for (const char c : wanted)
    text += static_cast<unsigned char>(c) < ' ' || c == '\\' || c == 0x7f ? '_' : c;
  while (text.ends_with(' ')) text.pop_back();
  text.erase(0, text.find_first_not_of(' '));
  if (text.starts_with('#')) text[0] = '_';  // else it would be a comment
  return text;
}

/// Names of materials or files, each once.
class UniqueNames {
 public:
  /// `base` + `ending`, with a number between them where that is taken.
  std::string add(const std::string& base, const std::string& ending = "") {
    std::string name = base + ending;
    if (taken_.insert(name).second) return name;
    int& n = next_.try_emplace(name, 2).first->second;
    std::string numbered;
    do numbered = base + "_" + std::to_string(n++) + ending;
    while (!taken_.insert(numbered).second);
    return numbered;
  }

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> next_;
};

/// A file name for a texture, without its ending: its own, with anything but letters, digits, '-',
/// '_' and '.' made '_'.
std::string textureStem(const Texture& texture, std::size_t index) {
  std::string base = texture.name;
  const std::vector<std::string> endings{
      ".png", ".jpg", ".jpeg", ".PNG", ".JPG", ".JPEG", pictureEnding(texture.mimeType)};
  for (const std::string& ending : endings) {
    if (!ending.empty() && base.ends_with(ending)) base.resize(base.size() - ending.size());
  }
  for (char& c : base) {
    const bool kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                      c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
    if (!kept) c = '_';
  }
  return base.empty() ? "texture" + std::to_string(index) : base;
}

/// `mesh`'s materials under names fit for a file, with the files of their pictures.
std::vector<MtlEntry> namedMaterials(const TriangleMesh& mesh, const std::string& stem,
                                     std::vector<NamedBytes>& files) {
  std::vector<std::string> textureFiles(mesh.textures.size());
  UniqueNames fileNames, names;
  const auto fileOf = [&](std::uint32_t t) {
    if (textureFiles[t].empty()) {
      textureFiles[t] = fileNames.add(stem + "_" + textureStem(mesh.textures[t], t),
                                      pictureEnding(mesh.textures[t].mimeType));
      files.push_back({textureFiles[t], mesh.textures[t].bytes});
    }
    return textureFiles[t];
  };
  std::vector<MtlEntry> materials;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    MtlEntry& entry = materials.emplace_back(MtlEntry{mesh.materials[i], {}, ""});
    Material& m = entry.material;
    m.name = lineText(m.name);
    m.name = names.add(m.name.empty() ? "material_" + std::to_string(i) : m.name);
    if (m.baseColorTexture) entry.baseColorFile = fileOf(*m.baseColorTexture);
    // Of a material that came from glTF, those that a .mtl has a key for.
    std::vector<bool> named(m.pictures.size(),
                            m.source && m.source->format == MaterialSource::Format::Mtl);
    for (const CarriedMap& map : gltfMapsOfMtl(m)) named.at(map.picture) = true;
    for (std::size_t p = 0; p < m.pictures.size(); ++p)
      entry.pictureFiles.push_back(named[p] ? fileOf(m.pictures[p]) : "");
  }
  return materials;
}

void appendColors(std::string& out, const std::array<float, 4>& color, bool withAlpha) {
  char text[32];
  for (int c = 0; c < 3; ++c) {
    // Ten digits: more than a float has, so that the linear float comes back exactly.
    const double srgb = linearToSrgb(color[c]);
    const auto [end, error] =
        std::to_chars(text, text + sizeof text, srgb, std::chars_format::general, 10);
    out += ' ';
    out.append(text, end);
  }
  if (!withAlpha) return;
  out += ' ';
  appendNumber(out, color[3]);
}

void appendVertices(std::string& out, const TriangleMesh& mesh, bool yUp,
                    const Progress& progress) {
  const bool withAlpha =
      std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const auto& c) { return c[3] != 1; });
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    reportNowAndThen(progress, "writing vertices", v, mesh.positions.size());
    const Vec3d p = toFileAxes(mesh.positions[v], yUp);
    out += 'v';
    for (const double c : {p.x, p.y, p.z}) {
      out += ' ';
      appendNumber(out, c);
    }
    if (mesh.hasColors()) appendColors(out, mesh.colors[v], withAlpha);
    out += '\n';
  }
}

/// Writes normals with four decimals, which is 0.003 degrees.
void appendNormals(std::string& out, const ShadingNormals& normals, bool yUp) {
  for (const Vec3f& normal : normals.normals) {
    const Vec3d n = toFileAxes(cast<double>(normal), yUp);
    out += "vn";
    for (const double c : {n.x, n.y, n.z}) {
      out += ' ';
      appendNumber(out, std::round(c * 1e4) / 1e4 + 0.0);  // -0 is 0
    }
    out += '\n';
  }
}

/// Writes each different texture coordinate once; returns the index from 0 for each corner.
std::vector<std::array<std::uint32_t, 3>> appendUvs(std::string& out, const TriangleMesh& mesh,
                                                    const Progress& progress) {
  std::unordered_map<std::uint64_t, std::uint32_t> indexOf;
  std::vector<std::array<std::uint32_t, 3>> indices;
  indices.reserve(mesh.uvs.size());
  for (const auto& corners : mesh.uvs) {
    reportNowAndThen(progress, "writing texture coordinates", indices.size(), mesh.uvs.size());
    auto& triangle = indices.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const Vec2f uv = corners[c];
      const std::uint64_t key = (std::uint64_t{std::bit_cast<std::uint32_t>(uv.x)} << 32) |
                                std::bit_cast<std::uint32_t>(uv.y);
      const auto [found, added] =
          indexOf.try_emplace(key, static_cast<std::uint32_t>(indexOf.size()));
      triangle[c] = found->second;
      if (!added) continue;
      out += "vt ";
      appendNumber(out, uv.x);
      out += ' ';
      appendNumber(out, uv.y);
      out += '\n';
    }
  }
  return indices;
}

}  // namespace

TriangleMesh parseObj(std::string_view bytes, const MeshSource& source) {
  return ObjReader(bytes, source).read();
}

ObjFiles formatObj(const TriangleMesh& mesh, const std::string& fileStem, bool yUp,
                   MeshNormals wanted, const Progress& progress, FaceNumbers numbers) {
  // What is named in a line must not break it, and what starts with '-' would be an option.
  std::string stem = fileStem;
  for (char& c : stem) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\\') c = '_';
  }
  if (stem.starts_with('-') || stem.starts_with(' ')) stem[0] = '_';
  ObjFiles files;
  std::string& out = files.obj;
  std::vector<MtlEntry> materials;
  out.reserve(
      mesh.positions.size() * (mesh.hasColors() ? 100 : 60) +
      mesh.triangles.size() * (mesh.hasUvs() ? 60 : 24) +
      (wanted == MeshNormals::None ? 0 : mesh.positions.size() * 24 + mesh.triangles.size() * 24));
  if (mesh.hasMaterials()) {
    materials = namedMaterials(mesh, stem, files.siblings);
    files.siblings.push_back({stem + ".mtl", formatMtl(materials)});
    out += "mtllib " + stem + ".mtl\n";
  }
  if (!lineText(mesh.name).empty()) out += "o " + lineText(mesh.name) + "\n";
  const ShadingNormals normals = shadingNormals(mesh, wanted, progress.part(0, 0.2));
  appendVertices(out, mesh, yUp, progress.part(0.2, 0.4));
  const Progress triangles = progress.part(0.5, 1);
  const auto uvIndices = appendUvs(out, mesh, progress.part(0.4, 0.5));
  appendNormals(out, normals, yUp);
  std::uint32_t material = kNone;
  const auto faces = faceOutlines(mesh, numbers, std::numeric_limits<std::size_t>::max());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    reportNowAndThen(triangles, "writing triangles", f, faces.size());
    const std::uint32_t first = faces[f][0].triangle;
    if (mesh.hasMaterials() && mesh.triangleMaterials[first] != material) {
      material = mesh.triangleMaterials[first];
      out += "usemtl " + materials[material].material.name + "\n";
    }
    out += 'f';
    for (const auto& [t, c] : faces[f]) {
      out += ' ';
      appendNumber(out, mesh.triangles[t][c] + 1);
      if (mesh.hasUvs()) {
        out += '/';
        appendNumber(out, uvIndices[t][c] + 1);
      }
      if (!normals.corners.empty()) {
        out += mesh.hasUvs() ? "/" : "//";
        appendNumber(out, normals.corners[t][c] + 1);
      }
    }
    out += '\n';
  }
  return files;
}

}  // namespace exemplar
